"""Builds the jig: plan, exact faces, one solid, and the proof that it holds the wires."""

from __future__ import annotations

from wrapit.config import JigConfig
from wrapit.errors import Finding, JigError
from wrapit.geometry import Region
from wrapit.jig.course import Course
from wrapit.jig.model import Jig, JigPlan, JigSet, Part
from wrapit.jig.plan import plan_jig
from wrapit.jig.support import min_wall_to_wire_mm, turn_support
from wrapit.wires.model import Wire

COLOUR = "#c8ccd4"
CLEARANCE_TOLERANCE_MM = 1e-3


def build_jig(wires: tuple[Wire, ...], config: JigConfig) -> tuple[JigSet, tuple[Finding, ...]]:
    """The printed jig of these wires, checked.

    Raises JigError where no jig can be made or one fails its check, KernelError where the kernel fails.
    """
    plan, findings = plan_jig(wires, config)
    return JigSet("single", (_build(plan, wires, config),)), findings


def _build(plan: JigPlan, wires: tuple[Wire, ...], config: JigConfig) -> Jig:
    course = Course.of(tuple(wire for wire in wires if wire.name in plan.wires), config)
    walls = tuple(course.outliner.region(wall.outline) for wall in plan.walls)
    gap = _checked_gap(course, walls, config)
    solid = _solid(plan, walls)
    from wrapit.kernel.checks import count_solids, size_mm, volume_mm3

    return Jig(
        name=plan.name,
        wires=plan.wires,
        part=Part(plan.name, solid, COLOUR),
        walls=walls,
        plate=Region(plan.plate.outline.outer, tuple(hole.outline for hole in plan.holes)),
        plan=plan,
        valid=True,
        solids=count_solids(solid),
        volume_mm3=volume_mm3(solid),
        support=turn_support(course, walls),
        min_wall_to_wire_mm=gap,
        size_mm=size_mm(solid),
    )


def _checked_gap(course: Course, walls: tuple[Region, ...], config: JigConfig) -> float | None:
    gap, (x, y) = min_wall_to_wire_mm(course, walls)
    if gap is not None and gap < config.clearance - CLEARANCE_TOLERANCE_MM:
        raise JigError(
            f"a wall comes within {gap:.4f} mm of a wire",
            f"at ({x:.2f}, {y:.2f}) mm",
            "change jig.clearance or the size a little",
        )
    return gap


def _solid(plan: JigPlan, walls: tuple[Region, ...]) -> object:
    from wrapit.kernel.terraces import Terrace, terraced_solid

    top = plan.plate.thickness_mm
    terraces = [Terrace(region, top + wall.height_mm) for region, wall in zip(walls, plan.walls, strict=True)]
    holes = [hole.outline for hole in plan.holes]
    return terraced_solid(plan.plate.outline.outer, 0.0, top, terraces, holes, f"jig {plan.name}")
