"""What couldn't be made fit, told as findings."""

from __future__ import annotations

from wrapit.drawing.model import Removal
from wrapit.errors import Finding
from wrapit.fit.clearing import short_lines, small_faces
from wrapit.fit.faces import faces_of
from wrapit.fit.measuring import tight_bends
from wrapit.fit.model import Limits
from wrapit.fit.programme import needed_mm
from wrapit.fit.sketch import Sketch
from wrapit.geometry import FloatArray


def unmet(sketch: Sketch, limits: Limits) -> tuple[Finding, ...]:
    """A finding for each line that is still too short or too tight, and each face that is still too small."""
    found = [
        _finding(
            sketch.lines[n].told("", ""),
            f"a line of {sketch.lines[n].curve.length:.1f} mm stays, shorter than can be bent "
            f"({limits.shortest_mm:g} mm)",
            _origin(sketch, n),
        )
        for n in short_lines(sketch, limits)
    ]
    faces = faces_of(sketch)
    for index in small_faces(sketch, faces, limits):
        face = faces.faces[index]
        needed = needed_mm(sketch, face.lines, limits)
        message = f"a face stays with {face.inside_mm:.1f} mm of room, where wire needs {needed:.1f} mm"
        x, y = face.centre
        place = Removal("", (float(x), float(y)), 0.0)
        near = face.lines or frozenset([_nearest(sketch, face.centre)])
        found.append(_finding(place, message, _origin(sketch, min(near))))
    found += [
        _finding(
            line.told("", ""),
            f"a line stays with a bend tighter than {limits.radius_mm:.2f} mm: there is no room to widen it",
            _origin(sketch, n),
        )
        for n, line in sorted(sketch.lines.items())
        if tight_bends(line.curve, limits.radius_mm)
    ]
    return tuple(found)


def _nearest(sketch: Sketch, at: FloatArray) -> int:
    """The line nearest to a place: a face where lines cross without a node may have none of its own."""
    from shapely import Point

    return min(sorted(sketch.lines), key=lambda n: sketch.lines[n].shape.distance(Point(at)))


def _origin(sketch: Sketch, n: int) -> int:
    return min(sketch.lines[n].origin)


def _finding(place: Removal, message: str, origin: int) -> Finding:
    x, y = place.at
    return Finding(
        "warning",
        "unfit",
        f"drawing at {x:.1f}, {y:.1f} mm",
        message,
        f"leave it out with drop: [{origin}], or make the piece larger",
    )
