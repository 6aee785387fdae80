"""Exact wall faces from the plan's polygons, each checked; the polygon itself where that fails."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from wrapit.errors import Finding
from wrapit.geometry import Region
from wrapit.geometry.outlines.polygons import polygon_of, region_area_mm2, region_of
from wrapit.jig.channel import Channels
from wrapit.jig.model import Wall
from wrapit.jig.support import min_wall_to_wire_mm

# When an exact outline is true: no nearer to a wire than this much under the clearance (0.5 % of the
# usual one), and its area as the polygon's within AREA_PER_MM of the polygon's length. Polygon and outline
# lie within SLACK + PAD = 1.5e-3 mm of one another along channels and within 5e-3 mm along fitted backs; an
# outline with a fold or a lost stretch is off by far more. The scale of what
# `min_wall_to_wire_mm` and this check see is SAMPLE. Leaf and butterfly have no face by polygon; 30 % up or
# down changes nothing.
CLEARANCE_TOLERANCE_MM = 1e-3
AREA_PER_MM = 6e-3
SAMPLE_MM = 1e-3
# Half the width of slits and spikes that a polygon loses before it becomes a face: their sides would cross as
# curves, and of lines the kernel makes no sound solid. A tenth of what the note on such walls says.
SPIKE_MM = 2e-4


@dataclass(frozen=True, eq=False)
class Face:
    """A wall's face, its smallest gap to any wire's surface, and whether its outline is exact."""

    region: Region
    gap_mm: float
    exact: bool


def wall_face(channels: Channels, wall: Wall) -> Face:
    """The exact face; where it fails its check, the polygon, whose sides are within 1e-3 mm of it."""
    try:
        region = channels.outliner.region(_without_spikes(wall.outline))
        sampled = polygon_of(region, SAMPLE_MM)  # ValueError where a loop has shrunk to less than a triangle
    except (ValueError, IndexError, ArithmeticError):  # no outline could be put together
        return _plain(channels, wall)
    gap, _ = min_wall_to_wire_mm(channels, (region,))
    true = (
        gap is not None
        and gap >= channels.inside_gap_mm - CLEARANCE_TOLERANCE_MM
        and sampled.is_valid
        and abs(region_area_mm2(region) - wall.outline.area) < AREA_PER_MM * wall.outline.length
    )
    return Face(region, float(gap or 0.0), exact=True) if true else _plain(channels, wall)


def plain_finding(faces: tuple[Face, ...], jig: str) -> tuple[Finding, ...]:
    """Says so when walls have outlines of short straight lines instead of exact curves."""
    plain = sum(not face.exact for face in faces)
    if not plain:
        return ()
    message = f"{plain} of {len(faces)} walls follow the wire in short straight lines, within 0.002 mm"
    return (Finding("note", "plain-wall", jig, message, "nothing needs to be done"),)


def _plain(channels: Channels, wall: Wall) -> Face:
    region = region_of(_without_spikes(wall.outline.simplify(1e-4)))
    gap, _ = min_wall_to_wire_mm(channels, (region,))
    return Face(region, float(gap or 0.0), exact=False)


def _without_spikes(outline: Any) -> Any:
    """The polygon without slits and spikes, whose two sides would cross as curves."""
    import shapely

    for grown_mm in (SPIKE_MM, -2 * SPIKE_MM, SPIKE_MM):
        outline = outline.buffer(grown_mm, join_style="mitre")
    return max(shapely.get_parts(outline), key=lambda part: part.area)
