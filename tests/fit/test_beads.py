"""Small round loops become beads: which, how large, and how lines are led through them."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from wrapit.config import Config
from wrapit.fit.beading.beads import LARGEST_MM, SMALLEST_MM, beaded, passing
from wrapit.fit.limits import limits_of
from wrapit.fit.model import Bead
from wrapit.fit.sketch import Line, Sketch
from wrapit.geometry import BezierChain, FloatArray, straight
from wrapit.geometry.steering.tight import bends, headings_of

LIMITS = limits_of(Config(drawing="x"), "gentle")
# A quarter of a circle of radius 1 as a cubic.
KAPPA = 0.5522847498


def arc(middle: FloatArray, rx: float, ry: float, start: int, quarters: int) -> BezierChain:
    """Some quarters of an ellipse, from one of its four ends on."""
    quarter = np.array([[1, 0], [1, KAPPA], [KAPPA, 1], [0, 1]])
    turn = np.array([[0, 1], [-1, 0]])
    cubics = [quarter @ np.linalg.matrix_power(turn, start + k) * (rx, ry) + middle for k in range(quarters)]
    for before, after in itertools.pairwise(cubics):
        after[0] = before[3]
    return BezierChain(np.array(cubics))


def threaded(rx: float, ry: float | None = None, middle: tuple[float, float] = (20, 0)) -> Sketch:
    """A line from the left and one to the right, with a loop of two lines between them."""
    ry = rx if ry is None else ry
    at = np.array(middle, dtype=float)
    upper, lower = arc(at, rx, ry, 0, 2), arc(at, rx, ry, 2, 2)
    right, left = upper.start, upper.end
    lower = BezierChain(np.array([np.vstack([left, lower.points[0, 1:]]), lower.points[1]]))
    lower = BezierChain(np.array([lower.points[0], np.vstack([lower.points[1, :3], right])]))
    start, end = np.array([0.0, 0.0]), np.array([60.0, 0.0])
    return of_lines(
        {0: start, 1: left, 2: right, 3: end},
        [(0, 1, straight(start, left)), (2, 1, upper), (1, 2, lower), (2, 3, straight(right, end))],
    )


def hanging(rx: float, ry: float | None = None, stem: tuple[float, float] = (30.0, 0.0)) -> Sketch:
    """A ring at the end of a line."""
    ring = arc(np.zeros(2), rx, rx if ry is None else ry, 0, 4)
    points = ring.points.copy()
    points[-1, 3] = points[0, 0]
    far = np.array(stem)
    return of_lines(
        {0: points[0, 0], 1: far}, [(0, 0, BezierChain(points)), (0, 1, straight(points[0, 0], far))]
    )


def of_lines(nodes: dict[int, FloatArray], lines: list[tuple[int, int, BezierChain]]) -> Sketch:
    return Sketch(nodes, {k: Line(*line, frozenset((k,))) for k, line in enumerate(lines)})


def mirrored(sketch: Sketch) -> Sketch:
    flip = np.diag([-1.0, 1.0])
    return Sketch(
        {node: point @ flip for node, point in sketch.nodes.items()},
        {k: Line(a.start, a.end, a.curve.mapped(flip), a.origin) for k, a in sketch.lines.items()},
    )


def far_of(curve: BezierChain, at: FloatArray) -> float:
    return float(np.linalg.norm(curve.sampled(0.01) - at, axis=1).min())


@settings(max_examples=40, deadline=None)
@given(st.floats(0.5, 8), st.floats(0.3, 1.0), st.sampled_from([threaded, hanging]))
def test_what_is_round_and_of_a_bead_s_size_becomes_one_and_nothing_else(radius, flat, drawn) -> None:  # type: ignore[no-untyped-def]
    sketch = drawn(radius, radius * flat)
    after, beads = beaded(sketch, LIMITS)
    size_mm = round(2 * (2 * radius * np.sqrt(flat))) / 2
    # At the bounds themselves either is right.
    if (
        abs(flat - 0.75) < 0.02
        or min(abs(2 * radius * np.sqrt(flat) - bound) for bound in (1.75, 10.25)) < 0.05
    ):
        return
    if flat < 0.75 or not SMALLEST_MM <= size_mm <= LARGEST_MM:
        assert beads == ()
        assert after.lines.keys() == sketch.lines.keys()
        return
    (bead,) = beads
    assert abs(bead.diameter_mm - 2 * radius * np.sqrt(flat)) <= 0.26
    assert bead.diameter_mm % 0.5 == 0
    (line,) = after.lines.values()
    assert bead.segment in after.lines
    assert far_of(line.curve, bead.at) < 0.02
    assert bends(headings_of(line.curve.points, np.array([0.0, 1.0])))[:-1].max(initial=0.0) < 0.05, (
        "it runs through smoothly"
    )
    (told,) = after.removed
    assert told.what == "bead"
    assert told.at == pytest.approx(tuple(bead.at))
    assert f"{bead.diameter_mm:g} mm" in told.reason


@settings(max_examples=30, deadline=None)
@given(
    st.floats(0.9, 5.3),
    st.floats(0.7, 1.0),
    st.floats(-3, 3),
    st.sampled_from(["threaded", "hanging"]),
)
def test_mirrored_loops_are_mirrored_beads(radius: float, flat: float, off: float, drawn: str) -> None:
    sketch = (
        threaded(radius, radius * flat, (20, off))
        if drawn == "threaded"
        else hanging(radius, radius * flat, (30, off))
    )
    after, beads = beaded(sketch, LIMITS)
    other, others = beaded(mirrored(sketch), LIMITS)
    assert [(bead.diameter_mm, bead.segment) for bead in beads] == [
        (bead.diameter_mm, bead.segment) for bead in others
    ]
    for bead, twin in zip(beads, others, strict=True):
        assert twin.at == pytest.approx(bead.at * (-1, 1), abs=1e-6)
    for number, line in mirrored(after).lines.items():
        assert other.lines[number].curve.points == pytest.approx(line.curve.points, abs=1e-6)


@settings(max_examples=30, deadline=None)
@given(st.floats(1.0, 5.0), st.floats(-0.02, 0.02), st.floats(-0.005, 0.005))
def test_a_pair_drawn_nearly_alike_is_a_pair_of_beads(radius: float, more: float, flatter: float) -> None:
    """Two rings at the ends of one line, as a tracer sees them: a little unlike, round or just not."""
    one = hanging(radius, 0.75 * radius).lines[0].curve
    two = arc(np.zeros(2), radius + more, (0.75 + flatter) * (radius + more), 0, 4)
    points = two.points.copy()
    points[-1, 3] = points[0, 0]
    shift = np.array([60.0, 0.0])
    right = BezierChain(points * (-1, 1) + shift)
    sketch = of_lines(
        {0: one.start, 1: right.start},
        [(0, 0, one), (1, 1, right), (0, 1, straight(one.start, right.start))],
    )
    _, beads = beaded(sketch, LIMITS)
    assert len(beads) in (0, 2)
    assert len({bead.diameter_mm for bead in beads}) <= 1


def test_the_wire_goes_on_beyond_a_bead_at_its_end() -> None:
    after, (bead,) = beaded(hanging(3), LIMITS)
    (line,) = after.lines.values()
    ends = np.array([line.curve.start, line.curve.end])
    assert np.linalg.norm(ends - bead.at, axis=1).min() == pytest.approx(3 + 2 + 0.5 * LIMITS.diameter_mm)
    assert bead.at == pytest.approx((0, 0), abs=0.01)


def test_a_ring_on_a_line_that_passes_is_a_bead_on_that_line() -> None:
    ring = hanging(3).lines[0].curve
    left, right = np.array([3.0, -30.0]), np.array([3.0, 30.0])
    sketch = of_lines(
        {0: ring.start, 1: left, 2: right},
        [(0, 0, ring), (0, 1, straight(ring.start, left)), (0, 2, straight(ring.start, right))],
    )
    after, (bead,) = beaded(sketch, LIMITS)
    assert bead.at == pytest.approx((3, 0))
    assert len(after.lines) == 1
    sharp = of_lines(
        {0: ring.start, 1: left, 2: np.array([30.0, -30.0])},
        [(0, 0, ring), (0, 1, straight(ring.start, left)), (0, 2, straight(ring.start, (30.0, -30.0)))],
    )
    assert beaded(sharp, LIMITS)[1] == (), "no straight hole goes round a corner"


def test_a_ring_closed_by_a_bead_stays_a_ring() -> None:
    sketch = threaded(3)
    left, right = sketch.nodes[1], sketch.nodes[2]
    away, below = np.array([50.0, 0.0]), np.array([50.0, -80.0])
    around = BezierChain(np.array([[left, left - away, right + below, right]]))
    ring = of_lines(
        {1: left, 2: right}, [(1, 2, around), (2, 1, sketch.lines[1].curve), (1, 2, sketch.lines[2].curve)]
    )
    after, (bead,) = beaded(ring, LIMITS)
    (line,) = after.lines.values()
    assert line.is_ring
    assert far_of(line.curve, bead.at) < 0.02


def test_lines_that_come_from_one_side_are_not_led_through() -> None:
    sketch = threaded(3)
    far = {**sketch.nodes, 3: np.array([20.0, 40.0])}
    quarter = arc(np.array([20.0, 0.0]), 3, 3, 0, 1)
    # The right node moves a quarter up: the lines meet at a right angle.
    top = quarter.end
    rest = arc(np.array([20.0, 0.0]), 3, 3, 1, 1)
    under = arc(np.array([20.0, 0.0]), 3, 3, 2, 3)
    rest = BezierChain(np.array([np.vstack([top, rest.points[0, 1:3], far[1]])]))
    under = BezierChain(
        np.array(
            [np.vstack([far[1], under.points[0, 1:]]), under.points[1], np.vstack([under.points[2, :3], top])]
        )
    )
    sketch = of_lines(
        {0: far[0], 1: far[1], 2: top, 3: far[3]},
        [(0, 1, sketch.lines[0].curve), (2, 1, rest), (1, 2, under), (2, 3, straight(top, far[3]))],
    )
    assert beaded(sketch, LIMITS)[1] == ()


def test_a_loop_about_something_is_no_bead() -> None:
    sketch = threaded(4)
    stub = np.array([20.0, 1.0])
    inside = {**sketch.lines, 4: Line(1, 4, straight(sketch.nodes[1], stub), frozenset((4,)))}
    assert beaded(Sketch({**sketch.nodes, 4: stub}, inside), LIMITS)[1] == ()
    assert beaded(sketch, LIMITS, places=[(20.5, 1.0)])[1] == ()
    assert len(beaded(sketch, LIMITS, places=[(40.0, 1.0)])[1]) == 1


def test_kept_loops_stay_and_a_large_one_is_the_piece_itself() -> None:
    assert beaded(threaded(3), LIMITS, kept=[1])[1] == ()
    assert beaded(hanging(4, stem=(8.0, 0.0)), LIMITS)[1] == ()


def test_two_loops_on_one_line_are_two_beads_on_one_wire() -> None:
    one, shift = threaded(2), np.array([60.0, 0.0])
    nodes = {**one.nodes, **{k + 3: p + shift for k, p in one.nodes.items() if k}}
    more = {
        k + 4: Line(a.start + 3, a.end + 3, a.curve.mapped(np.eye(2), shift), frozenset((k + 4,)))
        for k, a in one.lines.items()
    }
    after, beads = beaded(Sketch(nodes, {**one.lines, **more}), LIMITS)
    assert [bead.diameter_mm for bead in beads] == [4, 4]
    assert [after.lines[bead.segment].end for bead in beads if bead.segment is not None] == [3, 6]
    assert len(after.lines) == 2
    assert after.lines[0].origin >= {0, 3}


def test_the_passing_curve_is_the_nearest() -> None:
    curves = {3: straight((0, 0), (10, 0)), 5: straight((0, 2), (10, 2))}
    assert passing(Bead(np.array([5.0, 1.6]), 3.0).at, curves) == 5
    assert passing(np.array([5.0, 1.0]), curves) == 3, "the first of two as near"
