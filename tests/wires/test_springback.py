"""Wires bent further than drawn, against the law of round wire worked out on paper."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.jig.metal import arcs, circle, line, scribble, wires_of
from tests.wires.pieces import drawing_of, solution_of
from wrapit.config import Config, JigConfig
from wrapit.geometry import BezierChain, BSpline, from_chain
from wrapit.geometry.arclength import ArcLength
from wrapit.geometry.recurving import best_fit, recurved
from wrapit.materials import METALS
from wrapit.wires.springback import Overbent, overbend
from wrapit.wires.stage import draw_wires

# Half-hard copper of 1 mm: 3.395 · 200 MPa / (117 GPa · 1 mm).
LOSS = 3.395 * 200 / (117e3 * 1.0)


def bent(chain: BezierChain, loss: float = LOSS) -> Overbent:
    (wire,) = wires_of([chain], diameter_mm=1.0)
    return overbend(wire, loss, JigConfig())


def heading(spline: BSpline, end: int) -> float:
    direction = spline.derivative(np.array(spline.domain))[end]
    return math.atan2(direction[1], direction[0])


def test_a_quarter_circle_is_bent_more_tightly_and_further() -> None:
    assert METALS["copper"].springback_per_mm(1.0, "half hard") == pytest.approx(LOSS)
    over = bent(arcs((0, 0), 0, (10, 90)))
    line = over.wire.centreline
    u = np.linspace(*line.domain, 101)
    assert 1 / line.curvature(u) == pytest.approx(1 / (0.1 + LOSS), rel=2e-3)  # 9.45 mm instead of 10 mm
    turning = heading(line, 1) - heading(line, 0)
    assert math.degrees(turning) == pytest.approx(90 * (1 + 10 * LOSS), abs=0.01)  # 95.2°
    assert math.degrees(over.overbend_rad) == pytest.approx(90 * 10 * LOSS, abs=0.01)
    assert ArcLength(line).total_mm == pytest.approx(5 * math.pi, abs=1e-3), "wire gets no longer"
    assert over.residual_mm < 1e-4


def test_both_bends_of_an_s_are_overbent_to_their_own_side() -> None:
    over = bent(arcs((0, 0), 0, (9, 120), (14, -120)))
    curvature = over.wire.centreline.curvature(np.array([0.1, 0.9]) * over.wire.centreline.domain[1])
    assert curvature == pytest.approx([1 / 9 + LOSS, -1 / 14 - LOSS], rel=2e-3)
    assert [turn.inside for turn in over.wire.turns] == ["left"], "14 mm is no turn"
    assert over.moved_mm > 0.1
    assert over.residual_mm < 1e-3


def test_a_straight_wire_stays_where_it_is() -> None:
    over = bent(line((3, 4), (43, 34)))
    assert over.moved_mm < 1e-9
    assert over.overbend_rad == pytest.approx(0)
    assert over.wire.ends == pytest.approx(np.array([[3, 4], [43, 34]]))


@given(st.lists(st.tuples(st.floats(0, 31), st.floats(0, 31)), max_size=4))
def test_bent_further_where_it_is_held_alone(ends: list[tuple[float, float]]) -> None:
    (wire,) = wires_of([arcs((0, 0), 0, (10, 180))], diameter_mm=1.0)
    held = [(min(each), max(each)) for each in ends]
    over = overbend(wire, LOSS, JigConfig(), held)
    covered = np.linspace(0, 31.4, 31401)
    held_mm = 31.4 * np.any([(a < covered) & (covered < b) for a, b in [(-1, -1), *held]], axis=0).mean()
    bend = over.wire.centreline
    turned = (heading(bend, 1) - heading(bend, 0)) % (2 * math.pi)
    assert turned == pytest.approx(math.pi + held_mm * LOSS, abs=2e-4)
    assert over.overbend_rad == pytest.approx(held_mm * LOSS, abs=2e-3)
    assert over.residual_mm < 1e-3


def test_a_corner_keeps_its_angle() -> None:
    points = np.concatenate([line((0, 0), (10, 0)).points, line((10, 0), (10, 10)).points])
    bend = bent(BezierChain(points)).wire.centreline
    assert heading(bend, 1) - heading(bend, 0) == pytest.approx(math.pi / 2)


def test_a_closed_ring_laps_itself() -> None:
    over = bent(circle(10))
    tight = 1 / (0.1 + LOSS)
    ends = over.wire.ends
    lap = 2 * math.pi * (10 / tight - 1)
    assert np.linalg.norm(ends[1] - ends[0]) == pytest.approx(2 * tight * math.sin(lap / 2), rel=1e-3)
    assert over.wire.layers == 2, "its end lies on its start"


def test_a_shape_fits_itself_after_a_turn_and_a_shift() -> None:
    points = np.array([[0, 0], [4, 0], [4, 1], [7, 5]], float)
    turn = np.array([[0.6, -0.8], [0.8, 0.6]])
    fit = best_fit(points, points @ turn.T + [3, -2])
    assert fit.matrix == pytest.approx(turn)
    assert fit.offset == pytest.approx(np.array([3, -2]))
    assert fit.apart_mm == pytest.approx(0, abs=1e-12)


@given(st.integers(0, 10_000), st.floats(-9e-3, 9e-3))
def test_curvature_added_and_taken_away_is_the_same_curve(seed: int, change: float) -> None:
    drawn = from_chain(scribble(np.random.default_rng(seed), 50, 8))
    back = recurved(recurved(drawn, lambda k: 0 * k + change), lambda k: 0 * k - change)
    assert apart_mm(drawn, back) < 2e-3


@given(st.integers(0, 10_000), st.floats(1e-3, 9e-3))
def test_any_wire_let_go_comes_back_towards_the_drawing(seed: int, loss: float) -> None:
    over = bent(scribble(np.random.default_rng(seed), 50, 8), loss)
    # Nowhere does the curvature come back by less than four fifths of what was added.
    assert over.residual_mm < 0.2 * over.overbend_rad * over.wire.length_mm + 1e-3


def apart_mm(first: BSpline, second: BSpline) -> float:
    lengths = [ArcLength(first), ArcLength(second)]
    points = [each.spline.at(each.parameter(np.linspace(0, each.total_mm, 300))) for each in lengths]
    return float(np.abs(points[0] - points[1]).max())


def test_no_change_gives_the_same_curve() -> None:
    drawn = from_chain(scribble(np.random.default_rng(5), 50, 8))
    same = recurved(drawn, lambda k: 0 * k)
    assert apart_mm(drawn, same) < 1e-7


def test_corners_are_drawn_so_wide_that_the_overbent_one_is_the_tightest_allowed() -> None:
    drawing = drawing_of([(0, 0), (20, 0), (20, 20)], [(0, 1, None), (1, 2, None)])
    solution = solution_of(drawing, [[(0, False), (1, False)]])
    metal = {"gauge": "1.0 mm", "temper": "half hard"}
    settings = Config.model_validate(
        {"drawing": "a.svg", "wire": metal, "jig": {"springback": "compensate"}, "name": "a"}
    )
    wires, _ = draw_wires(solution, settings)
    tightest = 1.5  # an inner radius of one diameter
    assert wires[0].min_bend_radius_mm == pytest.approx(1 / (1 / tightest - LOSS), rel=1e-3)
    over = overbend(wires[0], LOSS, settings.jig)
    u = np.linspace(*over.wire.centreline.domain, 4001)
    assert 1 / np.abs(over.wire.centreline.curvature(u)).max() == pytest.approx(tightest, rel=5e-3)
