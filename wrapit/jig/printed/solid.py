"""The jig's solid from its plan and exact faces."""

from __future__ import annotations

from typing import TYPE_CHECKING

import shapely

from wrapit.config import JigConfig
from wrapit.geometry import Region
from wrapit.geometry.outlines.loops import circle
from wrapit.geometry.outlines.polygons import polygon_of
from wrapit.jig.model import Groove, JigPlan, Label, Seat
from wrapit.jig.printed.smoothed import ENGRAVED_SLACK_MM, smoothed

if TYPE_CHECKING:
    from wrapit.kernel.terraces import Terrace, Terraced

# How near a wall's sides are to its exact outline: a fifth of what its gap may lack (`wall_face`). The
# butterfly's walls have 151 sides so, 205 at 2.5e-5, 138 at 1e-3.
WALL_SLACK_MM = 2e-4
# How near the set-back top of a wall is to its true parallel: no wire touches it, so as near as one sees. Its
# cubics take the first, its faces the rest: all butterfly's crowns have 87 side faces so, 95 with
# coarser arcs (a quarter in 4 chords, whose bends are corners).
CROWN_TOLERANCE_MM = 0.01
CROWN_FIT_MM = 0.001
# Necks narrower than twice this are cut off: the sides of narrower ones might cross.
CROWN_NECK_MM = 0.02
# A smaller top is left out (the wall ends at the step): less than one blob of a nozzle of 0.4 mm, 0.8 long.
LEAST_CROWN_MM2 = 0.3
# How near the plate's sides are to its outline: nothing rests on them. The butterfly's plate has 10 so, 11
# at 0.005.
RIM_SLACK_MM = 0.01


def jig_solid(plan: JigPlan, walls: tuple[Region, ...], config: JigConfig) -> Terraced:
    """One solid: plate with holes and seats, walls on it, numbers and the wires' course engraved.

    Raises KernelError naming the jig.
    """
    from wrapit.kernel.terraces import Terrace, terraced_solid

    top = plan.plate.thickness_mm
    terraces = [
        _wall(region, top, wall.height_mm, config.lead_in)
        for region, wall in zip(walls, plan.walls, strict=True)
    ]
    engravings: list[Label | Groove] = [*plan.labels]
    if plan.groove is not None:
        engravings.append(plan.groove)
    for engraved in engravings:
        level = top - engraved.depth_mm
        terraces += [Terrace(stroke, level, slack_mm=ENGRAVED_SLACK_MM) for stroke in engraved.strokes]
    terraces += [_seat(seat, top) for seat in plan.seats if seat.depth_mm < top]
    through = [hole.outline for hole in plan.holes]
    through += [circle(pin.centre, pin.diameter_mm / 2) for pin in plan.pins]
    through += plan.screw_holes
    through += [seat.pocket for seat in plan.seats if seat.depth_mm >= top]
    rim = plan.plate.outline.outer
    return terraced_solid(rim, 0.0, top, terraces, through, plan.name, RIM_SLACK_MM)


def _wall(region: Region, ground_mm: float, height_mm: float, lead_in_mm: float) -> Terrace:
    """A wall whose top is set back all round by the lead-in, over the same height.

    Its faces towards the wires stay exact up to the step; a wall too narrow for one has none.
    """
    from wrapit.kernel.terraces import Terrace

    crest = ground_mm + height_mm
    if lead_in_mm > 0:
        foot = polygon_of(region, 1e-3)
        crown = foot.simplify(1e-3).buffer(-lead_in_mm - CROWN_NECK_MM)
        crown = crown.buffer(CROWN_NECK_MM, join_style="mitre")
        crowns = [part for part in shapely.get_parts(crown) if part.area > LEAST_CROWN_MM2]
        if crowns:
            slack = CROWN_TOLERANCE_MM - CROWN_FIT_MM
            upon = tuple(Terrace(_crown(part, foot), crest, slack_mm=slack) for part in crowns)
            return Terrace(region, crest - lead_in_mm, upon, WALL_SLACK_MM)
    return Terrace(region, crest, slack_mm=WALL_SLACK_MM)


def _seat(seat: Seat, ground_mm: float) -> Terrace:
    """A pocket, with its post."""
    from wrapit.kernel.terraces import Terrace

    post = Terrace(Region(circle(seat.centre, seat.post_mm / 2)), ground_mm + seat.post_height_mm)
    return Terrace(Region(seat.pocket), ground_mm - seat.depth_mm, (post,) if seat.post_mm else ())


def _crown(crown: shapely.Polygon, foot: shapely.Polygon) -> Region:
    return smoothed(crown, foot, CROWN_FIT_MM, CROWN_TOLERANCE_MM)
