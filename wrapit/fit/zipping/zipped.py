"""Lines that run along one another with less room between them than wire needs: they become one."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

from wrapit.fit.mirrored import Mirror, mirror_of
from wrapit.fit.model import Limits
from wrapit.fit.sketch import Sketch
from wrapit.fit.worth import worths
from wrapit.fit.zipping.joining import as_one, folded
from wrapit.fit.zipping.stretches import Near, Stretch, near_places, stretches

# So many pairs at most become one: each leaves fewer lines that are near.
_MOST: Final = 60

# A stretch by the origins of its line and of the line beside it.
_Names = tuple[frozenset[int], frozenset[int]]


def zipped(sketch: Sketch, limits: Limits, keep: frozenset[int]) -> Sketch:
    """The sketch with lines that are too near to one another made one, the lesser led into the other.

    Of a mirrored figure both sides are, or neither; two lines that are images of one another become one on
    the axis. `keep` are segments of the original that stay.
    """
    whole, sketch = sketch, folded(sketch, limits)
    near = near_places(sketch, limits.room_mm)
    if not len(near.gap):
        return sketch
    worth = worths(whole, whole.faces, limits)
    density = {whole.lines[n].origin: worth[n] / whole.lines[n].curve.length for n in worth}
    failed: set[tuple[object, ...]] = set()
    found, mirror = stretches(sketch, near, limits, density, keep), mirror_of(sketch)
    for _ in range(_MOST):
        stretch = next((s for s in found if _name(sketch, s) not in failed), None)
        if stretch is None:
            break
        image = _image(sketch, stretch, mirror)
        between = mirror.pairs.get(stretch.line) == stretch.other
        result = as_one(sketch, stretch, limits, mirror.axis if between else None)
        if image is not None and result is not None:
            beside = near_places(result, limits.room_mm, (sketch, near))
            result = _other_side(result, beside, image, limits, density, keep)
        if result is None:
            failed.add(_name(sketch, stretch))
        else:
            near = near_places(result, limits.room_mm, (sketch, near))
            sketch = result
            found, mirror = stretches(sketch, near, limits, density, keep), mirror_of(sketch)
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
    near: Near,
    image: _Names,
    limits: Limits,
    density: Mapping[frozenset[int], float],
    keep: frozenset[int],
) -> Sketch | None:
    """The sketch with the mirror image of a stretch made one too; None where it can't be."""
    for stretch in stretches(sketch, near, limits, density, keep):
        if _names(sketch, stretch) == image:
            return as_one(sketch, stretch, limits, None)
        if _names(sketch, stretch) == image[::-1]:
            return as_one(sketch, stretch.turned(), limits, None)
    return None
