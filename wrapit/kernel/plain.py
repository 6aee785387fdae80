"""Polygons of short lines in the place of outlines that bound no sound face."""

from __future__ import annotations

from wrapit.errors import KernelError
from wrapit.geometry import Region
from wrapit.geometry.outlines.polygons import polygon_of, region_of
from wrapit.kernel.edges import region_face
from wrapit.kernel.guard import guarded
from wrapit.kernel.measures import is_valid
from wrapit.kernel.runs import RUN_TOLERANCE_MM

# How near such a polygon is to its outline: far nearer than a wall's check asks (1e-3 mm), and with lines
# that are no shorter than what outlines are made of otherwise.
SAMPLE_MM = 1e-3
SIMPLER_MM = 1e-4
SHORTEST_MM = 1e-3


class Plain:
    """Makes regions plain where they need it, and keeps their places."""

    def __init__(self) -> None:
        self.places: list[str] = []

    def region(self, region: Region, slack_mm: float = RUN_TOLERANCE_MM) -> Region:
        """The region itself where its face is sound, else its polygon; KernelError if it has none."""
        if _sound(region, slack_mm):
            return region
        import shapely

        x, y = region.outer.edges[0].start
        place = f"({x:.1f}, {y:.1f}) mm"
        healed = polygon_of(region, SAMPLE_MM).buffer(0)
        parts = [part for part in shapely.get_parts(healed) if part.area > 0]
        if not parts:
            raise KernelError("an outline encloses nothing", f"at {place}")
        largest = max(parts, key=lambda part: float(part.area)).simplify(SIMPLER_MM)
        self.places.append(place)
        return region_of(shapely.remove_repeated_points(largest, SHORTEST_MM))


def _sound(region: Region, slack_mm: float) -> bool:
    try:
        with guarded("an outline's face", "one outline"):
            return is_valid(region_face(region, 0.0, slack_mm))
    except KernelError:
        return False
