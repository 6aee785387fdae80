"""The jig's solid from its plan and exact faces."""

from __future__ import annotations

import math
from typing import Any

from wrapit.geometry import Arc, Loop, Region
from wrapit.jig.model import JigPlan


def jig_solid(plan: JigPlan, walls: tuple[Region, ...]) -> Any:
    """One solid: plate with holes, walls on it, numbers engraved. Raises KernelError naming the jig."""
    from wrapit.kernel.terraces import Terrace, terraced_solid

    top = plan.plate.thickness_mm
    terraces = [Terrace(region, top + wall.height_mm) for region, wall in zip(walls, plan.walls, strict=True)]
    for label in plan.labels:
        terraces += [Terrace(stroke, top - label.depth_mm) for stroke in label.strokes]
    through = [hole.outline for hole in plan.holes]
    through += [Loop((Arc(pin.centre, pin.diameter_mm / 2, 0.0, 2 * math.pi),)) for pin in plan.pins]
    through += plan.screw_holes
    return terraced_solid(plan.plate.outline.outer, 0.0, top, terraces, through, plan.name)
