"""Contacts are where a wall stands beside the wire: found again with shapely, place by place."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from shapely import Polygon, prepare
from shapely import points as shapely_points

from tests.instructions.order.walks import (
    PLANNED,
    REACH_MM,
    Walk,
    bench_along,
    course,
    planned,
    walks,
)
from wrapit.geometry import Region
from wrapit.jig.bench.model import Bench, Contact
from wrapit.jig.bench.touching import DEPTH_MM, SHORTEST_MM, STEP_MM
from wrapit.jig.channel import SIDES
from wrapit.wires.model import Wire

# How far ends of contacts may lie off: a step of the wire's places, and what polygons of 0.02 mm leave.
ENDS_MM = 0.35


def polygon(wall: Region) -> Polygon:
    return Polygon(wall.outer.sampled(0.002), [hole.sampled(0.002) for hole in wall.holes])


def check(wire: Wire, bench: Bench, reach_mm: float) -> None:
    """Well within a contact the wall is there; where it is well there, there is a contact."""
    contacts = bench.contacts[wire.name]
    assert list(contacts) == sorted(contacts, key=lambda each: (each.start_mm, each.end_mm))
    at_mm, points, normals = course(wire)
    at_mm, points, normals = at_mm[::3], points[::3], normals[::3]
    for index, wall in enumerate(bench.walls):
        whole = polygon(wall)
        inner, outer = whole.buffer(-0.05), whole.buffer(0.05)
        prepare(inner)
        prepare(outer)
        for side, sign in SIDES.items():
            probes = shapely_points(points + sign * (reach_mm + DEPTH_MM) * normals)
            mine = [
                each for each in contacts if (each.index, each.side, each.around) == (index, side, "wall")
            ]
            near = np.array([outer.intersects(probe) for probe in probes])
            for each in mine:
                assert each.end_mm - each.start_mm >= SHORTEST_MM
                assert near[inside(at_mm, each, ENDS_MM)].all()
            surely = np.array([inner.intersects(probe) for probe in probes])
            covered = np.zeros(len(at_mm), bool)
            for each in mine:
                covered |= inside(at_mm, each, -ENDS_MM)
            missed = surely & ~covered
            # What is left out is too short to wrap round, or looks so: steps see it up to two steps shorter.
            assert longest(at_mm, missed) < SHORTEST_MM + 2 * STEP_MM


def inside(at_mm: np.ndarray, contact: Contact, margin_mm: float) -> np.ndarray:
    return (at_mm >= contact.start_mm + margin_mm) & (at_mm <= contact.end_mm - margin_mm)


def longest(at_mm: np.ndarray, mask: np.ndarray) -> float:
    best = start = 0.0
    before = False
    for at, here in zip(at_mm, mask, strict=True):
        if here and not before:
            start = float(at)
        if here:
            best = max(best, float(at) - start)
        before = bool(here)
    return best


@given(walks())
@settings(max_examples=12)
def test_beside_round_walls(walk: Walk) -> None:
    bench = bench_along(walk)
    check(bench.wires[0], bench, REACH_MM)


@pytest.mark.parametrize("name", [name for name in PLANNED if not name.startswith("tangle")])
def test_in_jigs_that_are_planned(name: str) -> None:
    for bench in planned(name).benches:
        for wire in bench.wires[:2]:
            check(wire, bench, wire.diameter_mm / 2 + 0.2)
