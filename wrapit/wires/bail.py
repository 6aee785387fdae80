"""The bail: a loop at the end of a wire that the piece hangs from."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from typing import Any

import numpy as np

from wrapit.config import BailConfig, Config
from wrapit.decomposition.json_file import wire_name
from wrapit.drawing.model import Drawing
from wrapit.errors import Finding, WireError
from wrapit.geometry import BezierChain, FloatArray, unit
from wrapit.geometry.arclength import cut
from wrapit.geometry.bezier import joined as as_one
from wrapit.geometry.polyline import steps
from wrapit.materials import min_inner_bend_radius_mm
from wrapit.wires.bail_loop import Eye, EyeSize, best_eye
from wrapit.wires.centreline import Joined
from wrapit.wires.model import Bail

# How closely wires are looked at for the centre of gravity and for touching.
STEP_MM = 0.05
PLUMB_MM = 0.1  # the top is the highest place so near to the line through the centre of gravity
STEM_DIAMETERS = 4.0  # so much of a wire before its end belongs to the neck
EXTRA_MM = 0.02  # more than the narrowest wall needs, or rounding would leave it out


def with_bail(
    joined: Sequence[Joined], drawing: Drawing, config: Config
) -> tuple[list[Joined], dict[int, Bail], tuple[Finding, ...]]:
    """The wires, one of them with a loop at an end near the bail's place; which wire has it, by index.

    None has one where no wire ends there with room for it: `jump_ring` has a place for a ring then. Raises
    WireError where the loop is too tight for the metal, or its place is no junction.
    """
    if config.bail is None:
        return list(joined), {}, ()
    size = _size(config.bail, config)
    chains = [each.chain for each in joined]
    place, outward = hanging_place(chains, drawing, config.bail)
    lines = [_line(chain) for chain in chains]
    for index, at_end in _ends_near(chains, place, config.bail.diameter):
        stem = chains[index] if at_end else chains[index].reversed()
        others = _others(stem, lines, index, size)
        eye = best_eye(stem, others, outward, size)
        if eye is not None:
            bent = _extended(joined[index], eye, at_end)
            bail = _bail(bent, eye, at_end, config.bail)
            return [*joined[:index], bent, *joined[index + 1 :]], {index: bail}, (_loop_finding(bail, index),)
    return list(joined), {}, ()


def hanging_place(
    chains: Sequence[BezierChain], drawing: Drawing, bail: BailConfig
) -> tuple[FloatArray, FloatArray]:
    """Where the piece hangs from, and the unit direction away from its centre of gravity."""
    clouds = [chain.sampled(STEP_MM) for chain in chains]
    points = np.concatenate(clouds)
    weights = np.concatenate([_weights(cloud) for cloud in clouds])
    centre = weights @ points / weights.sum()
    if bail.at == "top":
        plumb = points[np.abs(points[:, 0] - centre[0]) <= PLUMB_MM]
        above = plumb if len(plumb) else points
        return above[int(above[:, 1].argmax())], np.array([0.0, 1.0])
    if isinstance(bail.at, tuple):
        place = np.array(bail.at)
    elif bail.at < len(drawing.junctions):
        place = drawing.junctions[bail.at].point
    else:
        raise WireError(
            f"there is no junction {bail.at}", "bail.at", "drawing.svg shows the numbers of the junctions"
        )
    away = place - centre
    return place, unit(away) if np.linalg.norm(away) > 1e-6 else np.array([0.0, 1.0])


def _size(bail: BailConfig, config: Config) -> EyeSize:
    wire, jig = config.wire, config.jig
    least = min_inner_bend_radius_mm(wire.gauge, wire.temper)
    if bail.diameter < 2 * least:
        raise WireError(
            f"a loop of {bail.diameter:g} mm inside is tighter than this wire takes",
            "bail.diameter",
            f"make it {2 * least:.1f} mm or more, or use thinner or softer wire",
        )
    # The neck leaves room for the narrowest wall inside its bend.
    post = jig.clearance + jig.min_wall_width / 2 + EXTRA_MM
    return EyeSize((bail.diameter + wire.gauge) / 2, wire.gauge / 2 + max(least, post), wire.gauge)


def _weights(cloud: FloatArray) -> FloatArray:
    halves = steps(cloud) / 2
    return np.concatenate([halves, [0.0]]) + np.concatenate([[0.0], halves])


def _ends_near(chains: Sequence[BezierChain], place: FloatArray, reach_mm: float) -> list[tuple[int, bool]]:
    """Ends of open wires, nearest first: the wire's index, and whether it is its last end."""
    ends = [
        (float(np.linalg.norm((chain.end if last else chain.start) - place)), index, last)
        for index, chain in enumerate(chains)
        if np.linalg.norm(chain.end - chain.start) > 1e-6
        for last in (False, True)
    ]
    return [(index, last) for apart, index, last in sorted(ends) if apart <= reach_mm]


def _line(chain: BezierChain) -> Any:
    import shapely

    return shapely.LineString(chain.sampled(STEP_MM))


def _others(stem: BezierChain, lines: Sequence[Any], index: int, size: EyeSize) -> Any:
    """All centrelines but the last stretch of the wire that ends here."""
    import shapely

    kept = [line for other, line in enumerate(lines) if other != index]
    neck_mm = size.loop_mm + STEM_DIAMETERS * size.wire_mm
    if neck_mm < stem.length:
        kept.append(_line(cut(stem, stem.length - neck_mm)[0]))
    return shapely.union_all(kept)


def _extended(joined: Joined, eye: Eye, at_end: bool) -> Joined:
    if at_end:
        return dataclasses.replace(joined, chain=as_one([joined.chain, eye.chain]))
    before = eye.chain.length
    return Joined(
        as_one([eye.chain.reversed(), joined.chain]),
        tuple((start + before, end + before) for start, end in joined.spans_mm),
        tuple(dataclasses.replace(corner, at_mm=corner.at_mm + before) for corner in joined.corners),
    )


def _bail(bent: Joined, eye: Eye, at_end: bool, config: BailConfig) -> Bail:
    length, eye_mm = bent.chain.length, eye.chain.length
    start, end = (length - eye_mm, length) if at_end else (0.0, eye_mm)
    return Bail(start, end, (float(eye.centre[0]), float(eye.centre[1])), config.diameter)


def _loop_finding(bail: Bail, index: int) -> Finding:
    return Finding(
        "note",
        "bail",
        f"{wire_name(index)} at {(bail.start_mm + bail.end_mm) / 2:.0f} mm",
        f"its end goes on into a loop of {bail.inner_diameter_mm:g} mm inside, round"
        f" ({bail.centre[0]:.1f}, {bail.centre[1]:.1f}) mm",
        "hang the piece from it; wrap the tail round the neck",
    )
