"""Round wires along planar splines, with heights: exact centreline and solid.

The solid's skin is one spline surface for each smooth span: every pole of a circle (a rational quadratic
spline, exact) travels along its own cubic spline. No approximation by the kernel is involved.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from wrapit.errors import KernelError
from wrapit.geometry import BSpline
from wrapit.kernel.guard import guarded
from wrapit.kernel.measures import is_valid, volume_mm3
from wrapit.kernel.round_wires.skins import capped, skin, together
from wrapit.kernel.round_wires.spines import Spine

# By how much may a wire's volume differ from section times length? Sixteen sound wires differ by
# up to 6e-5; a bend tighter than the wire is thick came out with the sign reversed.
VOLUME_TOLERANCE = 1e-3


@dataclass(frozen=True, eq=False)
class RoundWire:
    """The centreline as one exact B-spline edge, and the round solid; None with the reason in `flaw`."""

    centreline: Any
    solid: Any | None
    flaw: str = ""


def round_wire(
    centreline: BSpline, diameter_mm: float, lifts: Sequence[tuple[float, float]], name: str
) -> RoundWire:
    """A round wire along a planar spline.

    `lifts` are heights (at_mm, z_mm) along the planar length with straight ramps between, whose kinks are
    rounded upwards; x and y of the centreline are those of the spline, exactly. A wire that is folded has a
    solid for each of its arms, which lie in each other next to the fold, in one shape. One that bends more
    tightly than it is thick has no sound solid. Raises KernelError naming the wire.
    """
    with guarded("making the round wire", name):
        spine = Spine(centreline, tuple(lifts), diameter_mm)
        edge = spine.edge()
    try:
        with guarded("making the round wire's solid", name):
            radius_mm = diameter_mm / 2
            arms = [capped([skin(spine, index, radius_mm) for index in arm]) for arm in spine.arms]
            solid = together(arms)
            flaw = _flaw(solid, math.pi / 4 * diameter_mm**2 * spine.length_mm)
    except KernelError as error:
        return RoundWire(edge, None, error.problem)
    return RoundWire(edge, None if flaw else solid, flaw)


def torus(
    centre: tuple[float, float, float],
    axis: tuple[float, float, float],
    radius_mm: float,
    tube_mm: float,
    name: str,
) -> Any:
    """A closed ring: a circle of `tube_mm` swept round the axis at `radius_mm`. Raises KernelError."""
    with guarded("making the ring", name):
        from OCP.BRepPrimAPI import BRepPrimAPI_MakeTorus
        from OCP.gp import gp_Ax2, gp_Dir, gp_Pnt

        return BRepPrimAPI_MakeTorus(gp_Ax2(gp_Pnt(*centre), gp_Dir(*axis)), radius_mm, tube_mm).Solid()


def _flaw(solid: Any, expected_mm3: float) -> str:
    got = volume_mm3(solid)
    if abs(got - expected_mm3) > VOLUME_TOLERANCE * expected_mm3:
        return f"it has {got:.2f} mm³ instead of {expected_mm3:.2f} mm³"
    return "" if is_valid(solid) else "it cuts through itself"
