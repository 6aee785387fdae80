"""Curves cut into a planar graph: against exact arithmetic, Euler's formula, and slow plain code."""

from __future__ import annotations

import itertools
import math
from collections import Counter
from collections.abc import Iterator
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from shapely import LineString, Point, get_parts, polygonize

from tests.drawing.svg.curves import FEW, SEEDS, drawing, line, through
from wrapit.config import TracingConfig
from wrapit.drawing.stage import trace
from wrapit.drawing.svg import intersections
from wrapit.drawing.svg.planar import Curve, Planar, planar
from wrapit.drawing.svg.tidying import rejoined
from wrapit.errors import DrawingError
from wrapit.geometry import BezierChain, FloatArray

CORNER_RAD = 0.6


def components(graph: Planar) -> int:
    group = {node: {node} for piece in graph.pieces for node in (piece.start, piece.end)}
    for piece in graph.pieces:
        if group[piece.start] is not group[piece.end]:
            group[piece.start] |= group[piece.end]
            for node in group[piece.end]:
                group[node] = group[piece.start]
    return len({id(members) for members in group.values()})


def nodes(graph: Planar) -> list[int]:
    return sorted({node for piece in graph.pieces for node in (piece.start, piece.end)})


def shape(graph: Planar) -> tuple[int, int, int, list[int]]:
    """Numbers of nodes, pieces and components, and how many ends meet at each node."""
    ends = [node for piece in graph.pieces for node in (piece.start, piece.end)]
    return (
        len(set(ends)), len(graph.pieces), components(graph), sorted(ends.count(node) for node in set(ends))
    )  # fmt: skip


def exact_crossing(one: FloatArray, other: FloatArray) -> tuple[Fraction, Fraction] | None:
    """Where two segments with whole coordinates cross, in rational numbers."""
    (ax, ay), (bx, by) = one.tolist()
    (cx, cy), (dx, dy) = other.tolist()
    det = (bx - ax) * (dy - cy) - (by - ay) * (dx - cx)
    if det == 0:
        return None
    s = Fraction((cx - ax) * (dy - cy) - (cy - ay) * (dx - cx), det)
    t = Fraction((cx - ax) * (by - ay) - (cy - ay) * (bx - ax), det)
    return (ax + s * (bx - ax), ay + s * (by - ay)) if 0 < s < 1 and 0 < t < 1 else None


@FEW
@given(SEEDS, st.integers(2, 14))
def test_random_lines_cross_where_rational_arithmetic_says(seed, count):
    ends = np.random.default_rng(seed).integers(0, 10**5, (count, 2, 2))
    exact = [p for a, b in itertools.combinations(ends, 2) if (p := exact_crossing(a, b)) is not None]
    places = np.array([*ends.reshape(-1, 2).tolist(), *([float(x), float(y)] for x, y in exact)])
    reach = 1e-2
    # General position: nothing else within reach of an end or of a crossing.
    gaps = np.linalg.norm(places[:, None] - places, axis=2)
    assume(gaps[~np.eye(len(places), dtype=bool)].min() > 1)
    assume(all(LineString(a).distance(Point(p)) > 1 for a, p in _others(ends)))
    graph = planar([through(points.astype(float)) for points in ends], reach, CORNER_RAD)
    assert len(graph.places) == 2 * count + len(exact)
    assert len(graph.pieces) == count + 2 * len(exact)
    found = np.array([graph.places[node] for node in nodes(graph)])
    away = np.linalg.norm(found[:, None] - places, axis=2).min(axis=0)
    assert away.max() < 1e-8


def _others(ends: FloatArray) -> Iterator[tuple[FloatArray, FloatArray]]:
    for k, points in enumerate(ends):
        for other in np.delete(ends, k, axis=0).reshape(-1, 2):
            yield points, other


@FEW
@given(SEEDS)
def test_faces_follow_eulers_formula_and_pieces_end_on_their_nodes(seed):
    graph = planar(drawing(np.random.default_rng(seed)), 1e-6, CORNER_RAD)
    for piece in graph.pieces:
        assert np.array_equal(piece.curve.start, graph.places[piece.start])
        assert np.array_equal(piece.curve.end, graph.places[piece.end])
    # Sampled pieces lie beside the true ones by less than 1e-6; where two run closer they may cross.
    lines = [LineString(piece.curve.sampled(0.02)) for piece in graph.pieces]
    assume(all(_apart(a, b) for a, b in itertools.combinations(lines, 2)))
    faces = len(get_parts(polygonize(lines))) + 1
    assert len(nodes(graph)) - len(graph.pieces) + faces == 1 + components(graph)


def _apart(one: LineString, other: LineString) -> bool:
    """Whether two lines meet at ends of both only."""
    met = one.intersection(other)
    ends = {one.coords[0], one.coords[-1]} & {other.coords[0], other.coords[-1]}
    return met.is_empty or all(
        part.geom_type == "Point" and part.coords[0] in ends for part in get_parts(met)
    )


@FEW
@given(SEEDS)
def test_the_graph_is_the_same_however_the_curves_are_ordered_and_placed(seed):
    rng = np.random.default_rng(seed)
    curves = drawing(rng)
    graph = planar(curves, 1e-4, CORNER_RAD)
    order = rng.permutation(len(curves))
    angle, scale, offset = rng.uniform(0, 2 * math.pi), 10 ** rng.uniform(-2, 2), rng.uniform(-500, 500, 2)
    turn = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    there = [Curve(scale * curves[k].cubics @ turn.T + offset, curves[k].closed) for k in order]
    again = planar(there, 1e-4 * scale, CORNER_RAD)
    assert shape(again) == shape(graph)
    first = np.array([graph.places[node] for node in nodes(graph)])
    second = (np.array([again.places[node] for node in nodes(again)]) - offset) @ turn / scale
    assert np.linalg.norm(first[:, None] - second, axis=2).min(axis=1).max() < 1e-6


@FEW
@given(SEEDS, st.integers(3, 12))
def test_lines_through_one_point_share_one_node(seed, count):
    rng = np.random.default_rng(seed)
    angles = (np.arange(count) + rng.uniform(-0.2, 0.2, count)) * math.pi / count
    middle = rng.uniform(-1000, 1000, 2)
    along = 40 * np.column_stack([np.cos(angles), np.sin(angles)])
    graph = planar([through([middle - d, middle + d]) for d in along], 0.5, CORNER_RAD)
    assert shape(graph) == (2 * count + 1, 2 * count, 1, [*[1] * 2 * count, 2 * count])


@FEW
@given(SEEDS, st.booleans(), st.integers(2, 16))
def test_a_stroke_drawn_in_parts_becomes_one_however_they_lie(seed, closed, count):
    rng = np.random.default_rng(seed)
    t = np.linspace(0, 2 * math.pi if closed else 5, count + 1)
    points = 50 * np.column_stack([np.cos(t), np.sin(t)])
    if closed:
        assume(count > 12)
        points[-1] = points[0]
    parts = [line(a, b)[None] for a, b in itertools.pairwise(points)]
    drawn = [
        Curve(part if rng.integers(2) else part[:, ::-1][::-1], closed=False)
        for part in (parts[k] for k in rng.permutation(count))
    ]
    turn = 1.1 * 2 * math.pi / count
    (piece,) = planar(drawn, 0.01, turn).pieces
    assert len(piece.curve) == count
    assert piece.curve.length == pytest.approx(sum(BezierChain(part).length for part in parts))
    assert (piece.start == piece.end) is closed
    assert rejoined([piece], turn) == [piece]


def test_an_end_touches_a_curve_that_stands_still_there():
    still = np.array([[[10, 90], [10, 90], [10, 10], [90, 10]]], dtype=float)
    graph = planar([Curve(still, closed=False), through([(10, 90.5), (90, 95)])], 1.0, CORNER_RAD)
    assert shape(graph) == (3, 2, 1, [1, 1, 2])


def test_too_many_crossings_are_refused_with_place_and_remedy(monkeypatch, tmp_path):
    monkeypatch.setattr(intersections, "MOST_CONTACTS", 80)
    rows = "".join(f"M0 {k}H20M{k} 0V20" for k in range(1, 11))
    path = tmp_path / "hatched.svg"
    lines = '<path stroke="black" stroke-width=".1" fill="none" d="{}"/>'
    picture = f'<svg xmlns="http://www.w3.org/2000/svg">{lines}</svg>'
    path.write_text(picture.format(rows))
    with pytest.raises(
        DrawingError, match=r"in more than 80 places, many of them near \(\d+\.\d, \d+\.\d\) px"
    ) as refused:
        trace(path, TracingConfig(), 40.0)
    assert refused.value.remedy
    assert len(str(refused.value).splitlines()) == 1
    path.write_text(picture.format("".join(f"M0 {k}H20M{k} 0V20" for k in range(1, 9))))
    drawing, _ = trace(path, TracingConfig(), 40.0)
    assert len(drawing.junctions) == 64 + 32


def test_lines_that_run_close_beside_each_other_too_often_are_refused(monkeypatch):
    hatching = [through(np.array([[k, 0], [k + 200, 200.0]])) for k in range(60)]
    assert shape(planar(hatching, 0.1, CORNER_RAD))[:3] == (120, 60, 60)
    monkeypatch.setattr(intersections, "MOST_PAIRS", 1000)
    with pytest.raises(
        DrawingError, match=r"^hatching\.svg: the lines cross, or run close beside each other"
    ):
        planar(hatching, 0.1, CORNER_RAD, "hatching.svg")


@given(
    beyond=st.floats(-0.25, 0.25),
    ways=st.tuples(st.floats(60, 120), st.floats(60, 120)),
    tilt=st.floats(0, 360),
    parts=st.booleans(),
)
def test_two_strokes_that_begin_in_one_point_beside_a_third_begin_on_it(beyond, ways, tilt, parts):
    # A line, and on either side of it a stroke; both begin in one point, `beyond` widths beside the line.
    def at(x, y):
        turned = np.exp(1j * math.radians(tilt)) * complex(x, y)
        return np.array([turned.real, turned.imag])

    def leg(angle_deg):
        angle = math.radians(angle_deg)
        return at(0, beyond), at(20 * math.cos(angle), beyond + 20 * math.sin(angle))

    left, right = leg(ways[0]), leg(-ways[1])
    strokes = [through([at(-20, 0), at(20, 0)])]
    strokes += [through(left), through(right)] if parts else [through([left[1], left[0], right[1]])]
    graph = planar(strokes, 1.0, CORNER_RAD)
    degree = sorted(Counter(node for p in graph.pieces for node in (p.start, p.end)).values())
    assert degree == [1, 1, 1, 1, 4]
    assert all(piece.curve.length > 10 for piece in graph.pieces)
