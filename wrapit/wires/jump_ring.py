"""Where a jump ring goes when no wire's end is bent into a loop to hang the piece from."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence

import numpy as np

from wrapit.config import Config
from wrapit.drawing.model import Drawing
from wrapit.errors import Finding, WireError
from wrapit.geometry import FloatArray, unit
from wrapit.geometry.arclength import ArcLength
from wrapit.geometry.bspline import chain_of
from wrapit.wires.bail import hanging_place
from wrapit.wires.model import RING_GAP_MM, JumpRing, Wire

# Where a ring is tried, and how closely wires and ring are looked at for touching.
STEP_MM = 0.1
TRIED_STEP = 3  # every so many points of the wires a ring is tried
LEAST_OUTWARD = 0.3  # a wire that runs outward itself would let a ring slide
# Places round the ring, 4° apart: 0.2 mm on a ring of 5 mm, less than a wire is thick.
ROUND = np.linspace(0.0, 2 * np.pi, 97)[:-1]


def jump_ring(
    wires: Sequence[Wire], drawing: Drawing, config: Config
) -> tuple[JumpRing | None, tuple[Finding, ...]]:
    """The jump ring that the piece hangs from; None without a bail, or if a wire's end is bent into one.

    It is hooked round the wire, square to it, as near to the bail's place as it touches no other wire,
    within its inner diameter; if it touches one everywhere there, it stays at the place. Raises WireError
    where no wire is so near.
    """
    bail = config.bail
    if bail is None or any(wire.bail is not None for wire in wires):
        return None, ()
    place, outward = hanging_place([chain_of(wire.centreline) for wire in wires], drawing, bail)
    courses = [_course(wire) for wire in wires]
    points, across = (np.concatenate(each) for each in zip(*courses, strict=True))
    apart = np.linalg.norm(points[:, :2] - place, axis=1)
    if apart.min() > bail.diameter:
        raise WireError(
            f"there is no wire within {bail.diameter:g} mm of ({place[0]:.1f}, {place[1]:.1f}) mm",
            "bail.at",
            "give a point of the drawing, as drawing.json has it, or `top`",
        )
    order = np.argsort(apart, kind="stable")
    near = order[apart[order] <= bail.diameter]
    across *= np.sign(across @ outward)[:, None]
    near = np.array([near[0], *(i for i in near[1::TRIED_STEP] if across[i] @ outward >= LEAST_OUTWARD)])
    rings = [_ring(points[i], across[i], bail.diameter, config.wire.gauge) for i in near]
    surroundings = points[apart <= 3 * bail.diameter]
    free = next((ring for ring in rings if _is_free(ring, surroundings)), None)
    found = rings[0] if free is None else dataclasses.replace(free, free=True)
    return found, (_finding(found),)


def _course(wire: Wire) -> tuple[FloatArray, FloatArray]:
    """Points (m, 3) along the wire, and unit directions (m, 2) across it."""
    lengths = ArcLength(wire.centreline)
    at_mm = lengths.stations(STEP_MM)
    u = lengths.parameter(at_mm)
    tangent = unit(wire.centreline.derivative(u))
    return np.column_stack([wire.centreline.at(u), wire.heights_mm(at_mm)]), np.column_stack(
        [-tangent[:, 1], tangent[:, 0]]
    )


def _ring(point: FloatArray, outward: FloatArray, inside_mm: float, gauge_mm: float) -> JumpRing:
    x, y, z = (float(value) for value in point)
    return JumpRing((x, y), (float(outward[0]), float(outward[1])), z, inside_mm, gauge_mm, free=False)


def _is_free(ring: JumpRing, points: FloatArray) -> bool:
    from scipy.spatial import cKDTree

    along = np.column_stack([np.outer(np.cos(ROUND), ring.outward), np.sin(ROUND)])
    apart, _ = cKDTree(points).query(np.array(ring.centre) + ring.radius_mm * along)
    return bool(apart.min() >= ring.diameter_mm + RING_GAP_MM / 2)


def _finding(ring: JumpRing) -> Finding:
    crowded = "" if ring.free else "; there is little room for it between the wires"
    return Finding(
        "note",
        "jump-ring",
        f"({ring.point[0]:.1f}, {ring.point[1]:.1f}) mm",
        f"no wire ends there with room for a loop of {ring.inner_diameter_mm:g} mm,"
        f" so the guide lists a jump ring{crowded}",
        "to have a wire bent into the loop, set bail.at to a free end,"
        " or let one end there with decomposition.constraints",
    )
