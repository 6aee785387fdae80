"""Outlines moved outward or inward by a distance: exact parallels of their curves, round at corners."""

from __future__ import annotations

from typing import Any

from wrapit.geometry.outlines.exact import Outliner
from wrapit.geometry.outlines.loops import Arc, Loop, Region, is_circle

# The sampled outline lies this near to the true one (chords of 0.02 mm), much less than any kerf.
_SAMPLE_MM = 1e-4


def offset_region(region: Region, distance_mm: float) -> tuple[Region, ...]:
    """The region grown by a distance (shrunk if it is negative): none, one or more regions.

    Polygons decide what is left, the true curves where it lies, to 1e-4 mm; convex corners become arcs.
    """
    from shapely import Polygon, get_parts
    from shapely.geometry.polygon import orient

    if distance_mm == 0:
        return (region,)
    (first, *_) = region.outer.edges
    if not region.holes and is_circle(region.outer.edges) and isinstance(first, Arc):
        radius_mm = first.radius_mm + distance_mm
        arc = Arc(first.centre, radius_mm, first.start_rad, first.sweep_rad)
        return (Region(Loop((arc,))),) if radius_mm > 0 else ()
    loops = (region.outer, *region.holes)
    flat = Polygon(_ring(region.outer), [_ring(hole) for hole in region.holes])
    moved = flat.buffer(distance_mm, quad_segs=64)
    distance = abs(distance_mm)
    edges = [edge for loop in loops for edge in loop.edges]
    outliner = Outliner.of(edges, (distance,), min(1.2e-3, distance / 4))
    parts = [part for part in get_parts(moved) if part.geom_type == "Polygon" and not part.is_empty]
    parts.sort(key=lambda part: part.bounds)
    return tuple(outliner.region(orient(part)) for part in parts)


def _ring(loop: Loop) -> Any:
    return loop.sampled(_SAMPLE_MM)
