"""Wires that turn and run at random, with walls inside some of their bends, on a bench made by hand."""

from __future__ import annotations

import functools
import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from hypothesis import strategies as st

from tests.drawing.generated import random_curve
from tests.exports.pieces_for_tests import eye, hairpin, spiral, woven
from tests.jig.metal import arcs, through, wires_of
from wrapit.config import JigConfig
from wrapit.geometry import FloatArray, Region
from wrapit.geometry.outlines.loops import circle, rounded_rectangle
from wrapit.jig.bench.model import Bench, Handling
from wrapit.jig.bench.touching import bench_of
from wrapit.jig.printed.planning import plan_jigs
from wrapit.wires.model import Bail, Wire

REACH_MM = 0.7


@dataclass(frozen=True)
class Part:
    """A line (`turn_deg` 0) or an arc that turns so far (left is positive), with a wall inside or none."""

    size_mm: float
    turn_deg: float = 0.0
    walled: bool = False

    @property
    def length_mm(self) -> float:
        """Along the wire."""
        return self.size_mm * (math.radians(abs(self.turn_deg)) if self.turn_deg else 1.0)


Walk = tuple[Part, ...]


def lines() -> st.SearchStrategy[Part]:
    return st.builds(Part, st.floats(0.4, 25))


def bends(least_deg: float = 4, most_deg: float = 420) -> st.SearchStrategy[Part]:
    """Slight and full ones alike, to either side."""
    angle = st.one_of(st.floats(least_deg, 30), st.floats(30, 200), st.floats(200, most_deg))
    signed = st.builds(lambda sign, size: sign * size, st.sampled_from([1, -1]), angle)
    return st.builds(Part, st.floats(0.3, 15), signed, st.booleans())


def walks() -> st.SearchStrategy[Walk]:
    return st.lists(st.one_of(lines(), bends(), bends()), min_size=1, max_size=7).map(tuple)


def wire_along(walk: Walk) -> Wire:
    (wire,) = wires_of([arcs((0, 0), 0.3, *((part.size_mm, part.turn_deg) for part in walk))])
    return wire


def walls_inside(walk: Walk) -> tuple[Region, ...]:
    """A round wall inside each bend that has one, just as far from the wire as walls stand."""
    at, heading, walls = np.zeros(2), 0.3, []
    for part in walk:
        if not part.turn_deg:
            at = at + part.size_mm * np.array([math.cos(heading), math.sin(heading)])
            continue
        left = math.copysign(1.0, part.turn_deg) * np.array([-math.sin(heading), math.cos(heading)])
        centre = at + part.size_mm * left
        if part.walled and part.size_mm > REACH_MM + 0.3:
            walls.append(Region(circle((float(centre[0]), float(centre[1])), part.size_mm - REACH_MM)))
        heading += math.radians(part.turn_deg)
        at = centre - part.size_mm * math.copysign(1.0, part.turn_deg) * np.array(
            [-math.sin(heading), math.cos(heading)]
        )
    return tuple(walls)


def plate_around(wires: Sequence[Wire]) -> Region:
    cloud = np.vstack([wire.centreline.poles for wire in wires])
    (left, bottom), (right, top) = cloud.min(axis=0) - 5, cloud.max(axis=0) + 5
    return Region(rounded_rectangle(float(left), float(bottom), float(right), float(top), 2.0))


def bench_by_hand(wires: Sequence[Wire], walls: Sequence[Region], name: str = "jig") -> Bench:
    return bench_of(name, wires, walls, plate_around(wires), (), REACH_MM)


def bench_along(walk: Walk) -> Bench:
    """One wire along a walk, and the walls inside its bends."""
    return bench_by_hand((wire_along(walk),), walls_inside(walk))


def with_bail(wire: Wire, length_mm: float, *, at_end: bool) -> Wire:
    """The same with its first or last millimetres as the loop to hang the piece from."""
    start, end = (wire.length_mm - length_mm, wire.length_mm) if at_end else (0.0, length_mm)
    return replace(wire, bail=Bail(start, end, (0.0, 0.0), 4.0))


@functools.cache
def tangle(seed: int) -> tuple[Wire, ...]:
    """A smooth closed wire that crosses itself as chance has it, some with a second one."""
    rng = np.random.default_rng(seed)
    curves = [0.5 * random_curve(rng, 100, 3)[:-1:10] for _ in range(1 + seed % 2)]
    return wires_of([through(curve, closed=True) for curve in curves])


@functools.cache
def planned(name: str) -> Handling:
    """The printed jigs of a small piece, planned without the kernel."""
    pieces = {"eye": lambda: eye()[1], "hairpin": hairpin, "spiral": spiral, "woven": lambda: woven(3)}
    wires = tangle(int(name.removeprefix("tangle-"))) if name not in pieces else pieces[name]()
    jigs, _ = plan_jigs(wires, JigConfig(least_support=0))
    benches = []
    for jig in jigs.jigs:
        plan = jig.plan
        mine = [wire for wire in wires if wire.name in plan.wires]
        reach_mm = jig.channels.reach_mm
        benches.append(bench_of(plan.name, mine, jig.walls, plan.plate.outline, plan.pins, reach_mm))
    return Handling(tuple(benches), jigs.forms)


PLANNED = ("eye", "hairpin", "spiral", "woven", "tangle-0", "tangle-1", "tangle-2", "tangle-3")


def course(wire: Wire, step_mm: float = 0.02) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Places (n,), points (n, 2) and left normals (n, 2), by summing chords: no arc length of ours."""
    u = np.linspace(*wire.centreline.domain, max(2000, round(wire.length_mm / step_mm)))
    points = wire.centreline.at(u)
    chords = np.diff(points, axis=0)
    sizes = np.linalg.norm(chords, axis=1)
    at_mm = np.concatenate([[0.0], np.cumsum(sizes)])
    ahead = np.vstack([chords, chords[-1:]]) / np.append(sizes, sizes[-1])[:, None]
    return at_mm, points, np.column_stack([-ahead[:, 1], ahead[:, 0]])
