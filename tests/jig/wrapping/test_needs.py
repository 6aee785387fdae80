"""Walls by need: none that isn't, enough that a taut wire lies as drawn."""

from __future__ import annotations

import math

import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.jig.metal import arcs, line, wires_of
from wrapit.config import JigConfig
from wrapit.geometry import BezierChain
from wrapit.jig.channel import Channels
from wrapit.jig.wrapping.needs import NeededWalls, planned_walls

TAUT, TURNS = JigConfig(), JigConfig(support="turns")


def planned(chain: BezierChain, config: JigConfig = TAUT) -> NeededWalls:
    return planned_walls(Channels.of(wires_of([chain], config), config), config, shapely.Polygon())


def area(walls: NeededWalls) -> float:
    return sum(polygon.area for polygon, _ in walls.polygons)


@given(st.floats(0, 2 * math.pi), st.floats(5, 120))
def test_a_straight_wire_needs_no_wall(heading: float, length_mm: float) -> None:
    walls = planned(line((0, 0), (length_mm * math.cos(heading), length_mm * math.sin(heading))))
    assert walls.polygons == walls.held == ()
    assert walls.laid[0].off_mm.max() < 1e-6


@settings(max_examples=15)
@given(st.floats(3, 40), st.floats(20, 200), st.floats(3, 40), st.floats(20, 120))
def test_a_taut_s_stays_within_the_tolerance(r1: float, a1: float, r2: float, a2: float) -> None:
    walls = planned(arcs((0, 0), 0, (10, 0), (r1, a1), (r2, -a2), (10, 0)))
    assert walls.laid[0].off_mm.max() <= TAUT.taut_tolerance + 1e-9


@pytest.mark.parametrize("radius_mm", [6, 12, 20, 25, 45])
def test_mirrored_wires_have_mirrored_walls(radius_mm: float) -> None:
    left = planned(arcs((0, 0), 0, (12, 0), (radius_mm, 100), (12, 0)))
    right = planned(arcs((0, 0), 0, (12, 0), (radius_mm, -100), (12, 0)))
    turned = [shapely.transform(polygon, lambda at: at * [1, -1]) for polygon, _ in right.polygons]
    ours = shapely.union_all([polygon for polygon, _ in left.polygons])
    assert ours.area > 0
    assert ours.symmetric_difference(shapely.union_all(turned)).area < 0.01 * ours.area
    assert {span.inside for span in left.held} == {"left"}
    assert {span.inside for span in right.held} == {"right"}


def test_less_wall_than_by_the_papers_rule_and_the_same_each_time() -> None:
    chain = arcs((0, 0), 0, (40, 0), (8, 90), (40, 0))
    assert 0 < area(planned(chain)) < 0.7 * area(planned(chain, TURNS))
    assert planned(chain).polygons == planned(chain).polygons
