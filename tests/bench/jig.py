"""Speed of the jig stage beside the naive way, and robustness on wires drawn at random.

The naive way builds each wall as a solid of its own, cuts every piece of every channel from it, and fuses
the walls to the plate, with one three-dimensional boolean at a time. It runs on one small design only.
"""

from __future__ import annotations

import itertools
import math
import time
from typing import Any

import numpy as np
import shapely

from tests.jig.metal import arcs, scribble, spiral, wires_of
from wrapit.config import JigConfig
from wrapit.errors import WrapItError
from wrapit.geometry.outlines.exact import Outliner
from wrapit.jig.channel import Channels
from wrapit.jig.printed.plan import plan_jig
from wrapit.jig.printed.smoothed import smoothed
from wrapit.jig.printed.stage import build_jig
from wrapit.jig.support import total_support
from wrapit.jig.wall_ground import wall_ground
from wrapit.jig.wrapping.passage import prolonged_mm
from wrapit.kernel.edges import region_face
from wrapit.kernel.measures import volume_mm3
from wrapit.wires.model import Wire

NAIVE_LIMIT_S = 240.0
SCRIBBLES = 40


def small_design() -> tuple[Wire, ...]:
    """Three wires like a butterfly's: two mirrored wings and a body between."""
    wing = arcs((2, 0), 0.6, (9, 200), (12, 40), (6, 150), (14, -30))
    mirrored = wing.mapped([[-1, 0], [0, 1]])
    body = arcs((0, -16), math.pi / 2, (40, 10), (30, 0), (1.8, 180), (8, 0))
    return wires_of([wing, mirrored, body])


def dense_design() -> tuple[Wire, ...]:
    """Sixteen wires: spirals, hairpins and crossings on 70 mm."""
    rng = np.random.default_rng(16)
    chains = [spiral(3.2, 2).mapped(np.eye(2), (18.0 * i, 12.0 * (i % 2))) for i in range(4)]
    chains += [arcs((5 + 9 * i, -16), math.pi / 2, (14, 0), (2.2, 180), (14, 0)) for i in range(6)]
    chains += [scribble(rng, 30, 5).mapped(np.eye(2), (8.0 * i, 22.0)) for i in range(6)]
    return wires_of(chains)


def naive_seconds(wires: tuple[Wire, ...], config: JigConfig) -> tuple[float, int, bool]:
    """Seconds, booleans done, and whether it came to an end within the limit."""
    from OCP.BRepAlgoAPI import BRepAlgoAPI_Cut, BRepAlgoAPI_Fuse

    start = time.perf_counter()
    plan, _ = plan_jig(wires, config)
    channels = Channels.of(wires, config)
    top = plan.plate.thickness_mm
    slots = [_prism(face, top - 1, 12) for face in _slots(channels)]
    jig = _prism(region_face(plan.plate.outline), 0, top)
    booleans = 0
    for wire in wires:
        for turn in wire.turns:
            ground = wall_ground(channels, turn, prolonged_mm(turn, config), config.wall_thickness)
            solid = _prism(_fitted_face(ground), top - 0.1, 5.1)
            for slot in slots:
                solid = BRepAlgoAPI_Cut(solid, slot).Shape()
                booleans += 1
                if time.perf_counter() - start > NAIVE_LIMIT_S:
                    return time.perf_counter() - start, booleans, False
            jig = BRepAlgoAPI_Fuse(jig, solid).Shape()
            booleans += 1
    return time.perf_counter() - start, booleans, volume_mm3(jig) > 0


def _slots(channels: Channels) -> list[Any]:
    """The channel of each wire in pieces of about 5 mm, as exact faces."""
    faces = []
    for chain in channels.chains:
        points = chain.sampled(0.02)
        pieces = max(1, round(chain.length / 5))
        cuts = np.linspace(0, len(points) - 1, pieces + 1).astype(int)
        for a, b in itertools.pairwise(cuts):
            slot = shapely.LineString(points[a : b + 1]).buffer(channels.reach_mm + 3e-4, quad_segs=32)
            outliner = Outliner.of([chain], (channels.reach_mm,), 1.2e-3)
            faces.append(region_face(outliner.region(slot)))
    return faces


def _fitted_face(polygon: Any) -> Any:
    largest = shapely.Polygon(max(shapely.get_parts(polygon), key=lambda part: part.area).exterior)
    return region_face(smoothed(largest.simplify(0.005), largest.buffer(1.0), 0.001, 0.005))


def _prism(face: Any, z: float, height: float) -> Any:
    from OCP.BRepBuilderAPI import BRepBuilderAPI_Transform
    from OCP.BRepPrimAPI import BRepPrimAPI_MakePrism
    from OCP.gp import gp_Trsf, gp_Vec

    move = gp_Trsf()
    move.SetTranslation(gp_Vec(0, 0, z))
    placed = BRepBuilderAPI_Transform(face, move, True).Shape()
    return BRepPrimAPI_MakePrism(placed, gp_Vec(0, 0, height)).Shape()


def main() -> None:
    """Prints the tables."""
    config = JigConfig()
    build_jig(small_design()[:1], config)  # loads the kernel
    seconds = {}
    print(
        f"{'design':10s} {'wires':>5s} {'mm':>5s} {'jigs':>4s} {'walls':>5s} {'support':>7s} {'seconds':>7s}"
    )
    single = config.model_copy(update={"split": "single"})
    for name, wires, chosen in (
        ("small", small_design(), single),
        ("dense", dense_design(), single),
        ("dense auto", dense_design(), config),
    ):
        start = time.perf_counter()
        jigs, _ = build_jig(wires, chosen)
        seconds[name] = time.perf_counter() - start
        walls = sum(len(jig.walls) for jig in jigs.jigs)
        support = total_support([one for jig in jigs.jigs for one in jig.support])
        length = sum(wire.length_mm for wire in wires)
        print(
            f"{name:10s} {len(wires):5d} {length:5.0f} {len(jigs.jigs):4d} {walls:5d}"
            f" {support:7.3f} {seconds[name]:7.2f}"
        )
    took, booleans, ended = naive_seconds(small_design(), config)
    print(
        f"naive way, small: {took:.1f} s for {booleans} booleans{'' if ended else ' (stopped)'},"
        f" {took / seconds['small']:.0f} times as long"
    )
    failures = []
    start = time.perf_counter()
    for seed in range(SCRIBBLES):
        rng = np.random.default_rng(seed)
        chains = [scribble(rng, 50, 8 + seed % 10, closed=seed % 3 == 0) for _ in range(1 + seed % 4)]
        try:
            build_jig(wires_of(chains), config)
        except WrapItError as failure:
            failures.append(f"{seed}: {failure}")
    each = (time.perf_counter() - start) / SCRIBBLES
    print(f"{SCRIBBLES} random pieces: {len(failures)} failed, {each:.2f} s each")
    print("\n".join(failures))


if __name__ == "__main__":
    main()
