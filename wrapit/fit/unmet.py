"""What couldn't be made fit, told as findings with a remedy that the config takes."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from wrapit.config import Config
from wrapit.errors import Finding
from wrapit.fit.clearing import short_lines, small_faces
from wrapit.fit.measuring import NOISE_RAD
from wrapit.fit.model import Limits
from wrapit.fit.programme import needed_mm
from wrapit.fit.sketch import Line, Sketch
from wrapit.geometry import FloatArray
from wrapit.geometry.arclength import piece
from wrapit.geometry.steering.tight import Tight, tight_places_of


def unmet(sketch: Sketch, before: Sketch, limits: Limits, config: Config) -> tuple[Finding, ...]:
    """A finding for each line that is still too short or too tight, and each face that is still too small.

    `before` is the drawing as it was read, whose numbers the remedies name.
    """

    def told(at: Iterable[float], message: str, origins: Iterable[int]) -> Finding:
        x, y = at
        remedy = _remedy(frozenset(origins), len(before.lines), config)
        return Finding("warning", "unfit", f"drawing at {x:.1f}, {y:.1f} mm", message, remedy)

    found = []
    for n in short_lines(sketch, limits):
        line = sketch.lines[n]
        long_mm, least_mm = f"{line.curve.length:.1f} mm", f"{limits.shortest_mm:g} mm"
        message = f"a line of {long_mm} stays, shorter than can be bent ({least_mm})"
        found.append(told(line.told("", "").at, message, line.origin))
    faces = sketch.faces
    for index in small_faces(sketch, faces, limits):
        face = faces.faces[index]
        needed = needed_mm(sketch, face.lines, limits)
        message = f"a face stays with {face.inside_mm:.1f} mm of room, where wire needs {needed:.1f} mm"
        # Where lines cross without a node, a face may have no line of its own.
        around = face.lines or frozenset([_line_at(sketch, face.centre)])
        least = min(around, key=lambda n: (sketch.lines[n].curve.length, n))
        found.append(told(face.centre, message, sketch.lines[least].origin))
    lines = [line for _, line in sorted(sketch.lines.items())]
    tight = tight_places_of([line.curve for line in lines], limits.radius_mm, closed=False)
    for line, places in zip(lines, tight, strict=True):
        at = _tightest(line, places)
        if at is not None:
            message = f"a bend tighter than {limits.radius_mm:.2f} mm stays: there is no room to widen it"
            found.append(told(at, message, (_nearest(at, line, before),)))
    return tuple(found)


def _tightest(line: Line, tight: Sequence[Tight]) -> FloatArray | None:
    """Where a line turns most of all that is too tight, (2,); None where nothing is."""
    if not any(each.turn > NOISE_RAD for each in tight):
        return None
    worst = max(tight, key=lambda each: each.turn)
    return piece(line.curve, 0.0, (worst.start + worst.end) / 2).end


def _line_at(sketch: Sketch, at: FloatArray) -> int:
    """The line nearest to a place."""
    import shapely

    return min(sorted(sketch.lines), key=lambda n: sketch.lines[n].shape.distance(shapely.Point(at)))


def _nearest(at: FloatArray, line: Line, before: Sketch) -> int:
    """Of the segments that a line comes from the one that is nearest to a place."""
    import shapely

    place = shapely.Point(at)
    return min(line.origin, key=lambda number: (before.lines[number].shape.distance(place), number))


def _remedy(origins: frozenset[int], segments: int, config: Config) -> str:
    """To leave out what is in the way; the lists are whole, so that they can be pasted.

    What the config keeps can't be dropped as well, and something has to be left.
    """
    if kept := origins.intersection(config.keep):
        rest = [number for number in config.keep if number not in kept]
        return f"let it be left out with keep: {rest}, or make the piece larger"
    dropped = sorted(origins.union(config.drop))
    if len(dropped) == segments:
        return "make the piece larger, or use thinner wire"
    return f"leave it out with drop: {dropped}, or make the piece larger"
