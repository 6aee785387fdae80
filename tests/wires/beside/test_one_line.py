"""Wires that run along lines twice in every way that lines allow: no kink, no metal in metal, all said."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st
from scipy.spatial import cKDTree

from tests.exports.pieces_for_tests import arc_chain
from tests.jig.metal import arcs
from tests.wires.beside.test_beside import APART_MM, CONFIG, GAUGE_MM, Edge, Step, apart_mm, is_smooth, laid
from tests.wires.pieces import drawing_of, solution_of
from wrapit.fit.limits import least_radius_mm
from wrapit.geometry import BezierChain, FloatArray, from_chain, straight
from wrapit.geometry.arclength import ArcLength
from wrapit.kernel.interference import common_mm3
from wrapit.kernel.round_wires.sweeps import round_wire
from wrapit.wires.beside.shifting import Course, Ramp, Shift, shifted
from wrapit.wires.beside.sides import find_stretches
from wrapit.wires.model import DoubleRun, Wire
from wrapit.wires.stacking import lay_wires

THERE_AND_BACK: list[Step] = [(0, False), (1, False), (1, True), (2, False)]


def branch(tip: tuple[float, float], curve: BezierChain | None = None) -> tuple[list, list[Edge]]:
    """A line that passes a junction with a branch."""
    points = [(-25.0, 0.0), (0.0, 0.0), tip, (25.0, 0.0)]
    return points, [(0, 1, None), (1, 2, curve), (1, 3, None)]


def hook(radius: float) -> BezierChain:
    """Up 12 mm, round half a circle, and down 12 mm."""
    round_it = arc_chain((radius, 12.0), radius, math.pi, -math.pi).points
    down = straight((2 * radius, 12.0), (2 * radius, 0.0)).points
    points = np.concatenate([straight((0.0, 0.0), (0.0, 12.0)).points, round_it, down])
    points[1:, 0] = points[:-1, 3]
    return BezierChain(points)


def test_a_line_that_bends_too_tightly_for_two_is_laid_upon_itself_and_says_so() -> None:
    """A bend of 0.57 mm has no room for a run 0.52 mm inside it, and one of 3 mm has."""
    for radius, fits in ((0.57, False), (3.0, True)):
        points, edges = branch((2 * radius, 0.0), hook(radius))
        (wire,), findings = laid(points, edges, [THERE_AND_BACK])
        told = [each for each in findings if each.code == "tight-double"]
        assert bool(wire.doubles) == fits
        assert len(told) == (0 if fits else 1)


@pytest.mark.parametrize("opposed", [False, True])
def test_two_stretches_in_a_row_are_two(opposed: bool) -> None:
    """Two wires share a line, then each shares the next one with a third: the sides may change there."""
    points = [
        (0.0, 0.0),
        (20.0, 0.0),
        (40.0, 0.0),
        (-15.0, 8.0),
        (-15.0, -8.0),
        (55.0, 8.0),
        (55.0, -8.0),
        (32.0, 17.0),
    ]
    edges: list[Edge] = [
        (0, 1, None), (1, 2, None), (3, 0, None), (4, 0, None), (2, 5, None), (2, 6, None), (1, 7, None)
    ]  # fmt: skip
    one: list[Step] = [(2, False), (0, False), (1, False), (4, False)]
    two: list[Step] = [(3, False), (0, False), (6, False)]
    three: list[Step] = [(1, False), (5, False)]
    if opposed:
        three = [(segment, not back) for segment, back in reversed(three)]
    wires, findings = laid(points, edges, [one, two, three])
    assert not [each for each in findings if each.code == "tight-double"]
    first, second = wires[0].doubles
    assert (first.other, second.other) == ("wire-02", "wire-03")
    assert second.opposed == opposed
    for wire in wires:
        assert is_smooth(wire)
        assert wire.min_bend_radius_mm >= 0.99 * least_radius_mm(CONFIG)
        for run in wire.doubles:
            assert apart_mm([with_runs(each, wire.name, run.other) for each in wires], wire, run) == (
                pytest.approx(APART_MM, rel=0.02)
            )


def with_runs(wire: Wire, *names: str) -> Wire:
    """The wire with only those runs that lie beside one of these."""
    return replace(wire, doubles=tuple(run for run in wire.doubles if run.other in names))


@pytest.mark.parametrize("away_mm", [0.0, 0.4])
def test_a_shifted_line_goes_half_round_the_tip_of_a_fold(away_mm: float) -> None:
    """A line laid back upon itself, shifted: from one side of it to the other with no gap."""
    line = BezierChain(
        np.concatenate([straight((0, 0), (10, 0)).points, straight((10, 0), (0, away_mm)).points])
    )
    moved = shifted(Course(line, Shift(0.5)), [10.0])
    points = moved.chain.points
    assert np.array_equal(points[1:, 0], points[:-1, 3])
    assert moved.chain.sampled(0.01)[:, 0].max() == pytest.approx(10.5, abs=0.02)
    tangents = np.diff(moved.chain.sampled(0.01), axis=0)
    turn = np.abs(np.diff(np.unwrap(np.arctan2(*tangents.T[::-1]))))
    assert turn.max() < 0.1
    assert moved.places_mm(np.array([10.0]))[0] == pytest.approx(moved.chain.length / 2, abs=1.0)


def test_a_line_run_twice_the_same_way_lies_beside_itself() -> None:
    """Round a loop and along its first line again: one wire, one direction, two runs."""
    points = [(0.0, 0.0), (25.0, 0.0), (12.0, 20.0), (-20.0, -6.0), (45.0, -6.0)]
    edges: list[Edge] = [(3, 0, None), (0, 1, None), (1, 2, None), (2, 0, None), (1, 4, None)]
    trail: list[Step] = [(0, False), (1, False), (2, False), (3, False), (1, False), (4, False)]
    (wire,), findings = laid(points, edges, [trail])
    assert not [each for each in findings if each.code == "tight-double"]
    out, again = wire.doubles
    assert (out.opposed, again.opposed) == (False, False)
    assert out.side != again.side
    assert (out.first, again.first) == (True, False)
    assert apart_mm([wire], wire, out) == pytest.approx(APART_MM, rel=0.02)
    assert is_smooth(wire)
    # The loop closes beside its start; it crosses itself once at most, and lies flat along the stretch.
    middle = np.array([(again.start_mm + again.end_mm) / 2])
    assert wire.heights_mm(middle)[0] == pytest.approx(0, abs=1e-6)


def test_solids_of_two_wires_side_by_side_share_nothing() -> None:
    points = [(0.0, 0.0), (20.0, 6.0), (-15.0, 8.0), (-15.0, -8.0), (35.0, 16.0), (35.0, 0.0)]
    arc = BezierChain(np.array([[(0, 0), (7, -3), (14, 0), (20, 6)]], float))
    edges: list[Edge] = [(0, 1, arc), (2, 0, None), (3, 0, None), (1, 4, None), (1, 5, None)]
    wires, _ = laid(
        points, edges, [[(1, False), (0, False), (3, False)], [(2, False), (0, False), (4, False)]]
    )
    made = [round_wire(wire.centreline, GAUGE_MM, wire.lifts, wire.name) for wire in wires]
    assert [each.flaw for each in made] == ["", ""]
    assert max(wire.layers for wire in wires) == 1
    assert common_mm3(made[0].solid, made[1].solid, "both") == 0
    assert cKDTree(wires[0].centreline.chain.sampled(0.05)).query(wires[1].centreline.chain.sampled(0.05))[
        0
    ].min() == pytest.approx(APART_MM, rel=0.01)


def test_a_joint_that_two_cubics_see_differently_in_the_last_bit_is_one(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Arithmetic on many places at once rounds some otherwise: a drawing of a rhinoceros stopped there."""
    line = arcs((0, 0), 0, (6, 0), (4, 100), (6, 0))
    course = Course(line, Shift(0.0, (Ramp(1.0, line.length - 1.0, 0.0, 0.5),)))
    exact = course.cubics

    def rounded(start_mm: FloatArray, end_mm: FloatArray) -> list[FloatArray]:
        found = [points.copy() for points in exact(start_mm, end_mm)]
        assert any(len(points) > 1 for points in found)
        for points in found:
            points[1:, 0] = np.nextafter(points[1:, 0], np.inf)
        return found

    true = shifted(course)
    monkeypatch.setattr(Course, "cubics", lambda _, start_mm, end_mm: rounded(start_mm, end_mm))
    np.testing.assert_allclose(shifted(course).chain.points, true.chain.points, rtol=0, atol=1e-12)


@settings(max_examples=25, deadline=None, phases=[Phase.generate])
@given(
    st.lists(st.tuples(st.floats(3, 12), st.floats(-100, 100)), min_size=1, max_size=5),
    st.floats(0.1, 0.5),
    st.floats(-0.6, 0.6),
)
def test_a_shifted_line_lies_as_far_off_as_asked(
    parts: list[tuple[float, float]], share: float, shift: float
) -> None:
    """On arcs and lines: the distance asked for, one tangent, and places that keep their order."""
    line = arcs((0, 0), 0, *[(each, 0) if abs(turn) < 5 else (each, turn) for each, turn in parts])
    total = line.length
    ramp = Ramp(share * total, (1 - share / 2) * total, 0.0, shift)
    course = Course(line, Shift(0.0, (ramp,)))
    bounds = [0.3 * total, 0.9 * total]
    moved = shifted(course, bounds)
    spline = from_chain(moved.chain)
    assert (np.unique(spline.knots[4:-4], return_counts=True)[1] <= 2).all()
    at_mm = np.linspace(0, total, 41)
    left, _ = course.shifts(at_mm)
    lengths = ArcLength(from_chain(line))
    u = lengths.parameter(at_mm)
    ahead = lengths.spline.derivative(u)
    ahead /= np.linalg.norm(ahead, axis=1)[:, None]
    expected = lengths.spline.at(u) + left[:, None] * np.column_stack([-ahead[:, 1], ahead[:, 0]])
    assert cKDTree(moved.chain.sampled(0.002)).query(expected)[0].max() < 2e-3
    places = moved.places_mm(np.array([0.0, *bounds, total]))
    assert (np.diff(places) > 0).all()
    assert places[-1] == pytest.approx(moved.chain.length, abs=1e-6)


@settings(max_examples=10, deadline=None)
@given(st.floats(0.9, 0.999), st.booleans())
def test_a_run_is_raised_over_another_but_not_over_the_one_beside_it(near: float, opposed: bool) -> None:
    lines = [straight((0, 0), (30, 0)), straight((0, near), (30, near))]
    if opposed:
        lines[1] = lines[1].reversed()
    splines = [from_chain(line) for line in lines]
    assert max(z for _, z in lay_wires(splines, 1.0)[1]) > 0
    beside = [
        (DoubleRun(0, 30, "wire-02", "left", opposed, True),),
        (DoubleRun(0, 30, "wire-01", "left" if opposed else "right", opposed, False),),
    ]
    assert lay_wires(splines, 1.0, beside) == [(), ()]
    # Only where both are doubled: half of it is raised all the same.
    half = [(replace(beside[0][0], end_mm=10),), beside[1]]
    assert max(z for _, z in lay_wires(splines, 1.0, half)[1]) > 0


@settings(max_examples=40, deadline=None)
@given(st.integers(2, 5), st.booleans(), st.data())
def test_stretches_are_the_longest_rows_of_segments_with_two_runs(
    count: int, opposed: bool, data: st.DataObject
) -> None:
    """Each of two trails passes a part of a row of segments: stretches are what both pass."""
    points: Sequence[tuple[float, float]] = [(10.0 * i, 0.0) for i in range(count + 1)]
    drawing = drawing_of(points, [(i, i + 1, None) for i in range(count)])
    spans = []
    for _ in range(2):
        low = data.draw(st.integers(0, count - 1))
        spans.append((low, data.draw(st.integers(low, count - 1))))
    trails: list[list[Step]] = [[(e, False) for e in range(low, high + 1)] for low, high in spans]
    if opposed:
        trails[1] = [(e, True) for e, _ in reversed(trails[1])]
    both = sorted(set(range(spans[0][0], spans[0][1] + 1)) & set(range(spans[1][0], spans[1][1] + 1)))
    left_out = set(data.draw(st.lists(st.sampled_from(range(count)), max_size=2)))
    walks = solution_of(drawing, trails).trails
    found = find_stretches(drawing, walks, 1.0, left_out)
    rows = [
        tuple(row)
        for wanted, group in itertools.groupby(both, lambda e: e not in left_out)
        for row in [list(group)]
        if wanted
    ]
    assert [stretch.segments for stretch in found] == rows
    for stretch in found:
        assert stretch.opposed == opposed
        assert not stretch.folded
        for strand in stretch.strands:
            steps = (
                solution_of(drawing, trails).trails[strand.trail].traversals[strand.first : strand.last + 1]
            )
            assert sorted(step.segment for step in steps) == sorted(stretch.segments)


def turned_back(angle_deg: float) -> Wire:
    """Two wires share a line; the first turns back at its end by almost half a turn, on its inner side."""
    way = math.radians(180 - angle_deg)
    tip = (20 - 30 * math.cos(way), -30 * math.sin(way))
    points = [(0.0, 0.0), (20.0, 0.0), (-15.0, 5.0), (-15.0, -9.0), tip, (40.0, 0.0)]
    edges: list[Edge] = [(0, 1, None), (2, 0, None), (3, 0, None), (1, 4, None), (1, 5, None)]
    trails: list[list[Step]] = [
        [(2, False), (0, False), (3, False)],
        [(1, False), (0, False), (4, False)],
    ]
    wires, findings = laid(points, edges, trails)
    assert not [each for each in findings if each.code == "tight-bend" and each.level == "error"]
    return wires[0]


@pytest.mark.parametrize("angle_deg", [90, 130, 150, 165, 172])
def test_a_run_that_turns_back_sharply_never_lies_in_itself(angle_deg: float) -> None:
    assert turned_back(angle_deg).min_bend_radius_mm > GAUGE_MM / 2
