"""Lines that run along one another with less room between them than wire needs: they become one."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

from wrapit.fit.mirrored import Mirror, mirror_of
from wrapit.fit.model import Limits
from wrapit.fit.sketch import Sketch
from wrapit.fit.zipping.joining import as_one, folded
from wrapit.fit.zipping.stretches import Stretch, stretches

# So many pairs at most become one: each leaves fewer lines that are near.
_MOST: Final = 60

# A stretch by the origins of its line and of the line beside it.
_Names = tuple[frozenset[int], frozenset[int]]


def zipped(sketch: Sketch, limits: Limits, worth: Mapping[int, float], keep: frozenset[int]) -> Sketch:
    """The sketch with lines that are too near to one another made one, the lesser led into the other.

    Of a mirrored figure both sides are, or neither; two lines that are images of one another become one on
    the axis. `worth` is that of lines; `keep` are segments of the original that stay.
    """
    density = {sketch.lines[n].origin: worth[n] / sketch.lines[n].curve.length for n in worth}
    sketch = folded(sketch, limits)
    failed: set[tuple[object, ...]] = set()
    for _ in range(_MOST):
        found = stretches(sketch, limits, density, keep)
        stretch = next((s for s in found if _name(sketch, s) not in failed), None)
        if stretch is None:
            break
        mirror = mirror_of(sketch)
        image = _image(sketch, stretch, mirror)
        between = mirror.pairs.get(stretch.line) == stretch.other
        result = as_one(sketch, stretch, limits, mirror.axis if between else None)
        if image is not None and result is not None:
            result = _other_side(result, image, limits, density, keep)
        if result is None:
            failed.add(_name(sketch, stretch))
        else:
            sketch = result
    return sketch


def _name(sketch: Sketch, stretch: Stretch) -> tuple[object, ...]:
    """What a stretch is known by while numbers of lines change: the lines' origins, and where they begin."""
    return *_names(sketch, stretch), round(stretch.span_mm[0], 3), round(stretch.beside_mm[0], 3)


def _names(sketch: Sketch, stretch: Stretch) -> _Names:
    return sketch.lines[stretch.line].origin, sketch.lines[stretch.other].origin


def _image(sketch: Sketch, stretch: Stretch, mirror: Mirror) -> _Names | None:
    """The mirror image of a stretch, if it has one other than itself."""
    line, other = mirror.pairs.get(stretch.line), mirror.pairs.get(stretch.other)
    if line is None or other is None or {line, other} == {stretch.line, stretch.other}:
        return None
    return sketch.lines[line].origin, sketch.lines[other].origin


def _other_side(
    sketch: Sketch,
    image: _Names,
    limits: Limits,
    density: Mapping[frozenset[int], float],
    keep: frozenset[int],
) -> Sketch | None:
    """The sketch with the mirror image of a stretch made one too; None where it can't be."""
    for stretch in stretches(sketch, limits, density, keep):
        if _names(sketch, stretch) == image:
            return as_one(sketch, stretch, limits, None)
        if _names(sketch, stretch) == image[::-1]:
            return as_one(sketch, stretch.turned(), limits, None)
    return None
