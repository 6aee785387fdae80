"""Two runs along the same lines lie side by side, smoothly, and turn back where the metal can."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence

import numpy as np
import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st
from scipy.spatial import cKDTree

from tests.exports.pieces_for_tests import arc_chain
from tests.wires.pieces import drawing_of, solution_of
from wrapit import draw_wires
from wrapit.config import Config
from wrapit.errors import Finding
from wrapit.fit.limits import corner_radius_mm, least_radius_mm
from wrapit.geometry import BezierChain, FloatArray
from wrapit.geometry.arclength import ArcLength, piece
from wrapit.kernel.measures import volume_mm3
from wrapit.kernel.round_wires.sweeps import round_wire
from wrapit.wires.beside.bulb import bulb, bulb_reach_mm
from wrapit.wires.beside.stage import APART
from wrapit.wires.mirror import mirrored
from wrapit.wires.model import DoubleRun, Wire

CONFIG = Config(drawing="drawing.svg")
GAUGE_MM = CONFIG.wire.gauge
APART_MM = APART * GAUGE_MM
Step = tuple[int, bool]
Edge = tuple[int, int, BezierChain | None]


def laid(
    points: Sequence[tuple[float, float]], edges: Sequence[Edge], trails: Sequence[Sequence[Step]]
) -> tuple[tuple[Wire, ...], tuple[Finding, ...]]:
    return draw_wires(solution_of(drawing_of(points, edges), trails), CONFIG)


def turned(trail: Sequence[Step]) -> list[Step]:
    return [(segment, not back) for segment, back in reversed(trail)]


def course(points: Sequence[tuple[float, float]], bends: Sequence[float]) -> list[Edge]:
    """Edges from point to point; each an arc that turns by so much (rad), or straight."""
    edges: list[Edge] = []
    for index, ((a, b), bend) in enumerate(zip(itertools.pairwise(points), bends, strict=True)):
        way = np.array(b) - np.array(a)
        if abs(bend) < 0.02:
            edges.append((index, index + 1, None))
            continue
        radius = float(np.linalg.norm(way)) / 2 / math.sin(abs(bend) / 2)
        left = np.array([-way[1], way[0]]) / np.linalg.norm(way)
        centre = (np.array(a) + np.array(b)) / 2 + math.copysign(1, bend) * left * radius * math.cos(bend / 2)
        out = np.array(a) - centre
        chain = arc_chain(tuple(centre), radius, math.atan2(out[1], out[0]), bend).points.copy()
        chain[0, 0], chain[-1, 3] = a, b
        edges.append((index, index + 1, BezierChain(chain)))
    return edges


@st.composite
def forks(draw: st.DrawFn) -> tuple[list[tuple[float, float]], list[Edge], int]:
    """A stretch of one to three segments, straight or bent, with two lines more at each end."""
    count = draw(st.integers(1, 3))
    heading, points = 0.0, [(0.0, 0.0)]
    for _ in range(count):
        heading += draw(st.floats(-0.9, 0.9))
        length = draw(st.floats(9, 20))
        x, y = points[-1]
        points.append((x + length * math.cos(heading), y + length * math.sin(heading)))
    edges = course(points, [draw(st.floats(-1.2, 1.2)) for _ in range(count)])
    (x, y), last = points[-1], len(points) - 1
    for turn in (draw(st.floats(0.4, 1.0)), -draw(st.floats(0.4, 1.0))):
        points.append((x + 15 * math.cos(heading + turn), y + 15 * math.sin(heading + turn)))
        edges.append((last, len(points) - 1, None))
    for turn in (draw(st.floats(0.4, 1.0)), -draw(st.floats(0.4, 1.0))):
        points.append((-15 * math.cos(turn), -15 * math.sin(turn)))
        edges.append((0, len(points) - 1, None))
    return points, edges, count


def run_points(wire: Wire, run: DoubleRun) -> FloatArray:
    return piece(wire.centreline.chain, run.start_mm, run.end_mm).sampled(0.05)


def apart_mm(wires: Sequence[Wire], wire: Wire, run: DoubleRun) -> FloatArray:
    """Distances of a double run, but for its ends, from the other runs."""
    others = [
        run_points(other, each)
        for other in wires
        if other.name == run.other
        for each in other.doubles
        if each.first != run.first
    ]
    margin = 2 * APART_MM
    inner = piece(wire.centreline.chain, run.start_mm + margin, run.end_mm - margin).sampled(0.1)
    return np.asarray(cKDTree(np.concatenate(others)).query(inner)[0])


def is_smooth(wire: Wire) -> bool:
    """One tangent at each joint: a clamped cubic has no triple knot inside."""
    repeats = np.unique(wire.centreline.knots[4:-4], return_counts=True)[1]
    return bool((repeats <= 2).all())


def crossings(one: FloatArray, other: FloatArray) -> int:
    import shapely

    met = shapely.LineString(one).intersection(shapely.LineString(other))
    return 0 if met.is_empty else len(shapely.get_parts(met))  # an empty line has one part


@settings(max_examples=40, deadline=None, phases=[Phase.generate])
@given(forks(), st.booleans(), st.booleans())
def test_two_wires_along_a_stretch_lie_side_by_side(
    fork: tuple[list[tuple[float, float]], list[Edge], int], opposed: bool, crossed: bool
) -> None:
    points, edges, count = fork
    stretch = [(index, False) for index in range(count)]
    above, below = (count, False), (count + 1, False)
    # Of the lines behind, the first goes left and down in the drawing's own turn.
    behind = [(count + 2, True), (count + 3, True)]
    one = [behind[0], *stretch, above]
    other = [behind[1], *stretch, below]
    if crossed:
        one[-1], other[-1] = other[-1], one[-1]
    wires, findings = laid(points, edges, [one, turned(other) if opposed else other])
    assert not [each for each in findings if each.code in ("tight-double", "tight-bend")]
    # behind[0] comes from below (its turn is seen backwards), so without a cross it goes on below.
    lines = [wire.centreline.chain.sampled(0.05) for wire in wires]
    assert crossings(*lines) == (0 if crossed else 1)
    assert max(wire.layers for wire in wires) == (1 if crossed else 2)
    for wire, other_wire in itertools.permutations(wires):
        assert is_smooth(wire)
        (run,) = wire.doubles
        assert (run.other, run.opposed) == (other_wire.name, opposed)
        assert apart_mm(wires, wire, run) == pytest.approx(APART_MM, rel=0.02)
        assert wire.min_bend_radius_mm >= 0.99 * least_radius_mm(CONFIG)
        assert wire.max_deviation_from_drawing_mm >= APART_MM / 2
        lengths = ArcLength(wire.centreline)
        for (_, end), (start, _) in itertools.pairwise(wire.segment_spans_mm):
            assert end == start
        assert wire.segment_spans_mm[0][0] == 0
        assert wire.segment_spans_mm[-1][1] == pytest.approx(lengths.total_mm, abs=1e-6)
        first, last = wire.traversals[0], wire.traversals[-1]
        for step, at, end in ((first, 0, not first.reversed), (last, -1, last.reversed)):
            corner = edges[step.segment][0 if end else 1]
            assert np.allclose(wire.ends[at], points[corner], atol=1e-9)
    assert {run.first for wire in wires for run in wire.doubles} == {True, False}


@settings(max_examples=40, deadline=None, phases=[Phase.generate])
@given(st.floats(14, 30), st.floats(-1.2, 1.2), st.floats(1.1, 2.0), st.booleans())
def test_a_leaf_is_run_out_and_back_round_a_bulb(
    length: float, bend: float, angle: float, left: bool
) -> None:
    """A line that passes a junction, and takes in a leaf there."""
    tip = (length * math.cos(angle), length * math.sin(angle) * (1 if left else -1))
    points = [(-25.0, 0.0), (0.0, 0.0), (25.0, 0.0), tip]
    (leaf,) = course([points[1], tip], [bend])
    edges: list[Edge] = [(0, 1, None), (1, 2, None), (1, 3, leaf[2])]
    (wire,), findings = laid(points, edges, [[(0, False), (2, False), (2, True), (1, False)]])
    assert not [each for each in findings if each.code in ("tight-double", "hairpin-short")]
    assert is_smooth(wire)
    assert wire.layers == 1
    import shapely

    assert shapely.LineString(wire.centreline.chain.sampled(0.05)).is_simple
    out, back = wire.doubles
    assert out.opposed
    assert back.opposed
    assert out.first
    assert not back.first
    assert out.side == back.side
    for run in (out, back):
        if run.end_mm - run.start_mm > 4.5 * APART_MM:
            assert apart_mm([wire], wire, run) == pytest.approx(APART_MM, rel=0.02)
    # The middle of the hairpin is where one passage of the leaf ends and the other begins, near its end.
    middle = wire.segment_spans_mm[1][1]
    assert middle == wire.segment_spans_mm[2][0]
    at = wire.centreline.at(ArcLength(wire.centreline).parameter(np.array([middle])))[0]
    assert np.linalg.norm(at - tip) <= 0.5 * bulb_reach_mm(APART_MM / 2, corner_radius_mm(CONFIG))


def test_a_straight_leaf_ends_where_it_ended() -> None:
    (wire,), _ = laid(
        [(-25, 0), (0, 0), (25, 0), (0, 20)],
        [(0, 1, None), (1, 2, None), (1, 3, None)],
        [[(0, False), (2, False), (2, True), (1, False)]],
    )
    assert wire.centreline.chain.sampled(0.01)[:, 1].max() == pytest.approx(20, abs=1e-3)
    assert wire.min_bend_radius_mm == pytest.approx(corner_radius_mm(CONFIG), rel=0.01)
    assert mirrored([wire])[0].doubles[0].side != wire.doubles[0].side


def test_a_short_leaf_turns_back_beyond_its_end_and_says_so() -> None:
    (wire,), findings = laid(
        [(-25, 0), (0, 0), (25, 0), (0, 3)],
        [(0, 1, None), (1, 2, None), (1, 3, None)],
        [[(0, False), (2, False), (2, True), (1, False)]],
    )
    (said,) = [each for each in findings if each.code == "hairpin-short"]
    beyond_mm = wire.centreline.chain.sampled(0.01)[:, 1].max() - 3
    assert f"{beyond_mm:.1f} mm beyond" in said.message
    assert wire.min_bend_radius_mm >= 0.99 * least_radius_mm(CONFIG)
    assert wire.max_deviation_from_drawing_mm >= beyond_mm - 1e-3


@given(st.floats(0.2, 3), st.floats(0.2, 3), st.booleans())
def test_a_bulb_turns_from_one_run_to_the_other_with_one_radius(
    half: float, radius: float, left: bool
) -> None:
    shift = half if left else -half
    chain = bulb(np.zeros(2), np.array([1.0, 0.0]), shift, radius)
    assert np.allclose(chain.start, (0, shift))
    assert np.allclose(chain.end, (0, -shift), atol=1e-9)
    assert np.allclose(chain.start_tangent, (1, 0))
    assert np.allclose(chain.end_tangent, (-1, 0), atol=1e-9)
    points = chain.sampled(0.002)
    assert points[:, 0].max() == pytest.approx(bulb_reach_mm(half, radius), abs=1e-3)
    turn = np.abs(np.diff(np.unwrap(np.arctan2(*np.diff(points, axis=0).T[::-1]))))
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    bends = turn / ((steps[:-1] + steps[1:]) / 2)
    assert bends.max() <= 1.02 / max(radius, min(half, radius))


def test_solids_of_a_hairpin_and_of_two_wires_do_not_overlap() -> None:
    (wire,), _ = laid(
        [(-25, 0), (0, 0), (25, 0), (0, 20)],
        [(0, 1, None), (1, 2, None), (1, 3, None)],
        [[(0, False), (2, False), (2, True), (1, False)]],
    )
    made = round_wire(wire.centreline, GAUGE_MM, wire.lifts, wire.name)
    assert made.solid is not None, made.flaw
    # Metal that lay in itself would make a smaller solid than its length asks for.
    volume = wire.length_mm * math.pi * GAUGE_MM**2 / 4
    assert volume_mm3(made.solid) == pytest.approx(volume, rel=2e-3)
