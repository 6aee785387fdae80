"""Round wires along planar splines, with heights: exact centreline and solid.

The solid's skin is one spline surface for each smooth span: every pole of a circle (a rational quadratic
spline, exact) travels along its own cubic spline. No approximation by the kernel is involved.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from wrapit.errors import KernelError
from wrapit.geometry import BSpline
from wrapit.kernel.checks import is_valid, volume_mm3
from wrapit.kernel.guard import guarded
from wrapit.kernel.skins import capped, skin
from wrapit.kernel.spines import Spine

VOLUME_TOLERANCE = 1e-3
TIGHT = 0.98  # a wire bent to less than its own radius can't be a valid solid; the bend itself is reported


def round_wire(
    centreline: BSpline, diameter_mm: float, lifts: Sequence[tuple[float, float]], name: str
) -> tuple[Any, Any]:
    """The solid round wire and its centreline as one exact B-spline edge.

    `lifts` are heights (at_mm, z_mm) along the planar length with straight ramps between, whose kinks are
    rounded upwards; x and y of the centreline are those of the spline, exactly. Raises KernelError
    naming the wire.
    """
    with guarded("making the round wire", name):
        spine = Spine(centreline, tuple(lifts), diameter_mm)
        skins = [skin(spine, index, diameter_mm / 2) for index in range(len(spine.spans))]
        solid = capped(skins, spine.breaks)
        if spine.sharpest_per_mm * diameter_mm / 2 < TIGHT:
            _check(solid, math.pi / 4 * diameter_mm**2 * spine.length_mm, name)
        return solid, spine.edge()


def _check(solid: Any, expected_mm3: float, name: str) -> None:
    got = volume_mm3(solid)
    if abs(got - expected_mm3) > VOLUME_TOLERANCE * expected_mm3:
        raise KernelError(f"the round wire has {got:.2f} mm³ instead of {expected_mm3:.2f} mm³", name)
    if not is_valid(solid):
        raise KernelError("the round wire is not a valid solid", name, "make its tightest bend wider")
