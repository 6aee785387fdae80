"""Wires on small pieces with answers known on paper."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.jig.metal import arcs
from tests.wires.pieces import circle, drawing_of, solution_of
from wrapit.config import Config, JigConfig
from wrapit.decomposition.model import Solution
from wrapit.geometry import BezierChain, from_chain
from wrapit.geometry.arclength import ArcLength, cut
from wrapit.wires.centreline import join
from wrapit.wires.mirror import mirrored
from wrapit.wires.stacking import lay_wires
from wrapit.wires.stage import draw_wires
from wrapit.wires.turns import find_turns

CONFIG = Config(drawing="none.png")
PAPERS_RULE = Config(drawing="none.png", jig=JigConfig(support="turns"))
coordinates = st.floats(-20, 20, allow_nan=False).map(lambda v: round(v, 3))


@st.composite
def chains(draw: st.DrawFn) -> BezierChain:
    """Chains with one tangent at each joint."""
    count = draw(st.integers(1, 6))
    corners = np.cumsum([[draw(st.floats(2, 10)), draw(st.floats(-6, 6))] for _ in range(count + 1)], axis=0)
    angles = [draw(st.floats(-1.2, 1.2)) for _ in range(count + 1)]
    tangents = np.column_stack([np.cos(angles), np.sin(angles)])
    handles = [draw(st.floats(0.3, 1.5)) for _ in range(2 * count)]
    return BezierChain(
        np.array(
            [
                [
                    corners[i],
                    corners[i] + handles[2 * i] * tangents[i],
                    corners[i + 1] - handles[2 * i + 1] * tangents[i + 1],
                    corners[i + 1],
                ]
                for i in range(count)
            ]
        )
    )


def trail_of(*points: tuple[float, float]) -> Solution:
    """A drawing of straight segments in a row, and the one wire that follows it."""
    drawing = drawing_of(points, [(i, i + 1, None) for i in range(len(points) - 1)])
    return solution_of(drawing, [[(i, False) for i in range(len(points) - 1)]])


@given(chains())
def test_spline_is_the_chain_exactly(chain: BezierChain) -> None:
    spline = from_chain(chain)
    assert len(spline.poles) == 2 * len(chain) + 2, "each smooth joint loses its pole"
    lengths = ArcLength(spline)
    assert lengths.total_mm == pytest.approx(chain.length, rel=1e-6)
    at_mm = np.linspace(0.01, 0.99, 7) * chain.length
    on_spline = spline.at(lengths.parameter(at_mm))
    on_chain = np.array([cut(chain, float(s))[0].end for s in at_mm])
    assert np.abs(on_spline - on_chain).max() < 2e-3  # how exactly a chain is cut; points agree to 1e-9
    for cubic, (u0, u1) in zip(
        chain.points, zip(spline.breaks, spline.breaks[1:], strict=False), strict=True
    ):
        t = np.linspace(0, 1, 9)
        exact = BezierChain(cubic[None]).points[0]
        basis = np.column_stack([(1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t**2 * (1 - t), t**3])
        assert np.abs(spline.at(u0 + (u1 - u0) * t) - basis @ exact).max() < 1e-9


@given(chains(), st.floats(0.01, 0.99))
def test_cut_keeps_length_and_ends(chain: BezierChain, share: float) -> None:
    before, after = cut(chain, share * chain.length)
    assert before.length == pytest.approx(share * chain.length, abs=2e-3)
    assert before.length + after.length == pytest.approx(chain.length, rel=1e-6)
    assert np.array_equal(before.end, after.start)


@pytest.mark.parametrize("post_bends", [False, True])
def test_right_angle_becomes_an_arc_of_the_tightest_allowed_radius(post_bends: bool) -> None:
    solution = trail_of((0, 0), (20, 0), (20, 20))
    jig = JigConfig(post_bends=post_bends, clearance="0.2 mm", min_wall_width="0.8 mm")
    (wire,), findings = draw_wires(solution, CONFIG.model_copy(update={"jig": jig}))
    # Dead soft: inner radius d/2, centreline d; a post of 0.8 mm with 0.2 mm of clearance needs more.
    radius = wire.diameter_mm / 2 + 0.6 if post_bends else wire.diameter_mm
    assert wire.min_bend_radius_mm == pytest.approx(radius, rel=1e-3)
    assert wire.length_mm == pytest.approx(40 - 2 * radius + radius * math.pi / 2, abs=1e-3)
    assert wire.max_deviation_from_drawing_mm == pytest.approx(radius * (math.sqrt(2) - 1), abs=1e-3)
    assert wire.segment_spans_mm[0][1] == pytest.approx(wire.length_mm / 2, abs=1e-6)
    assert not [finding for finding in findings if finding.level != "note"]


@given(st.floats(0.001, 3.0))
def test_any_bend_is_rounded_smoothly(bend: float) -> None:
    end = (20 + 20 * math.cos(bend), 20 * math.sin(bend))
    joined = join([s.curve for s in trail_of((0, 0), (20, 0), end).decomposition.drawing.segments], 1.0)
    spline = from_chain(joined.chain)
    inner = [k for k in set(spline.knots) if 0 < k < spline.knots[-1]]
    assert all(np.sum(spline.knots == k) == 2 for k in inner), "no corner is left"
    u = np.linspace(*spline.domain, 2001)
    wanted = 1.0 if math.tan(bend / 2) < 9 else 9 / math.tan(bend / 2)
    assert 1 / np.abs(spline.curvature(u)).max() > 0.995 * wanted


def test_hairpin_without_room_is_reported() -> None:
    _, findings = draw_wires(trail_of((0, 0), (2, 0), (0.3, 0.4)), CONFIG)
    (finding,) = [finding for finding in findings if finding.code == "tight-bend"]
    assert finding.where.startswith("wire-01 at")
    assert "radius" in finding.message


def test_a_small_kink_inside_a_segment_is_widened() -> None:
    line = np.array([[0, 0], [10, 0], [10.4, 0.3], [10.8, 0], [20, 0]], float)
    handles = np.array([[1, 0], [1, 0], [1, 0.2], [1, 0], [1, 0]]) * 0.12
    kinked = BezierChain(
        np.array(
            [[line[i], line[i] + handles[i], line[i + 1] - handles[i + 1], line[i + 1]] for i in range(4)]
        )
    )
    drawing = drawing_of([(0, 0), (20, 0)], [(0, 1, kinked)])
    (wire,), findings = draw_wires(solution_of(drawing, [[(0, False)]]), CONFIG)
    assert wire.min_bend_radius_mm >= 0.999 * wire.diameter_mm
    assert 0 < wire.max_deviation_from_drawing_mm <= 0.35
    assert not [finding for finding in findings if finding.code == "tight-bend"]


def test_circle_is_one_turn_to_the_left() -> None:
    drawing = drawing_of([(5, 0)], [(0, 0, circle(5))])
    (wire,), _ = draw_wires(solution_of(drawing, [[(0, False)]], closed=True), CONFIG)
    (turn,) = wire.turns
    assert turn.inside == "left"
    assert (turn.start_mm, turn.end_mm) == (pytest.approx(0), pytest.approx(wire.length_mm))
    assert turn.max_curvature_per_mm == pytest.approx(0.2, rel=0.01)
    assert wire.length_mm == pytest.approx(10 * math.pi, rel=1e-3)
    assert wire.cut_length_mm == pytest.approx(wire.length_mm + 50)


def test_s_curve_turns_left_then_right() -> None:
    k = 4 / 3 * math.tan(math.pi / 8) * 4
    up = np.array([[0, 0], [k, 0], [4, 4 - k], [4, 4]], float)
    s = BezierChain(np.array([up, [[4, 4], [4, 4 + k], [8 - k, 8], [8, 8]]], float))
    turns, _ = find_turns("wire-01", from_chain(s), CONFIG.jig)
    assert [turn.inside for turn in turns] == ["left", "right"]


def test_the_papers_rule_holds_a_long_straight_stretch_on_one_side() -> None:
    (wire,), _ = draw_wires(trail_of((0, 0), (30, 0)), PAPERS_RULE)
    assert [(turn.inside, turn.stretch, turn.start_mm, turn.end_mm) for turn in wire.turns] == [
        ("left", True, 3.0, pytest.approx(27))
    ]
    (short,), _ = draw_wires(trail_of((0, 0), (19, 0)), PAPERS_RULE)
    assert short.turns == ()
    (taut,), _ = draw_wires(trail_of((0, 0), (30, 0)), CONFIG)
    assert taut.turns == (), "a wire under tension is straight by itself"


@given(st.floats(20, 200), st.sampled_from([1, -1]))
def test_a_long_stretch_is_held_on_its_concave_side(radius_mm: float, side: int) -> None:
    bent = from_chain(arcs((0, 0), 0, (radius_mm, side * math.degrees(30 / radius_mm))))
    (stretch,), _ = find_turns("wire-01", bent, PAPERS_RULE.jig)
    assert stretch.stretch
    assert stretch.inside == ("left" if side > 0 else "right")
    assert find_turns("wire-01", bent, CONFIG.jig)[0] == ()


def test_crossing_wires_are_tied_and_the_later_lies_on_top() -> None:
    drawing = drawing_of(
        [(0, 0), (-10, 0), (10, 0), (0, -10), (0, 10)],
        [(1, 0, None), (0, 2, None), (3, 0, None), (0, 4, None)],
    )
    solution = solution_of(drawing, [[(0, False), (1, False)], [(2, False), (3, False)]])
    (first, second), _ = draw_wires(solution, CONFIG)
    assert [(b.junction, b.others) for b in first.bindings] == [(0, ("wire-02",))]
    assert second.bindings[0].at_mm == pytest.approx(10, abs=1e-6)
    assert first.lifts == ()
    assert first.layers == 1
    assert max(z for _, z in second.lifts) == pytest.approx(first.diameter_mm, abs=0.01)
    assert second.layers == 2


@given(st.floats(0.2, 1.4), st.floats(-3, 3))
def test_laid_wires_keep_a_diameter_apart_in_space(angle: float, offset: float) -> None:
    d = 1.0
    first = from_chain(BezierChain(np.array([[[-12, 0], [-4, 2], [4, -2], [12, 0]]], float)))
    direction = np.array([math.cos(angle), math.sin(angle)])
    ends = np.array([offset, 0]) + np.outer([-12, -4, 4, 12], direction)
    second = from_chain(BezierChain(ends[None]))
    low, high = lay_wires([first, second], d)
    assert low == ()
    points = []
    for spline, lifts in ((first, ()), (second, high)):
        lengths = ArcLength(spline)
        at_mm = lengths.stations(0.03)
        z = np.interp(at_mm, *zip(*lifts, strict=True)) if lifts else np.zeros_like(at_mm)
        points.append(np.column_stack([spline.at(lengths.parameter(at_mm)), z]))
    apart = np.linalg.norm(points[0][:, None] - points[1][None], axis=2)
    assert apart.min() > 0.97 * d


@pytest.mark.parametrize("count", [1, 9, 101])
def test_wires_are_numbered_in_order_and_named_by_their_numbers(count: int) -> None:
    points = [(10.0 * i, y) for i in range(count) for y in (0.0, 8.0)]
    drawing = drawing_of(points, [(2 * i, 2 * i + 1, None) for i in range(count)])
    wires, _ = draw_wires(solution_of(drawing, [[(i, False)] for i in range(count)]), Config(drawing="x.svg"))
    assert [wire.number for wire in wires] == list(range(1, count + 1))
    assert wires[-1].name == f"wire-{count:02d}"
    assert [wire.number for wire in mirrored(wires)] == [wire.number for wire in wires]


def test_a_wires_height_is_read_off_its_lifts() -> None:
    drawing = drawing_of([(0, 0), (20, 0), (10, -9), (10, 9)], [(0, 1, None), (2, 3, None)])
    (low, high), _ = draw_wires(
        solution_of(drawing, [[(0, False)], [(1, False)]]), Config(drawing="x.svg", wire={"gauge": "1 mm"})
    )
    assert low.heights_mm(np.array([0.0, 10.0])).tolist() == [0.0, 0.0]
    at, z = np.array(high.lifts).T
    assert np.allclose(high.heights_mm(at), z)
    assert high.heights_mm(np.array([9.0]))[0] == pytest.approx(1.0, abs=0.02)
