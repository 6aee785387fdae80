"""Faces from exact outlines, against areas worked out on paper."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.jig.metal import arcs, circle
from wrapit.errors import KernelError
from wrapit.geometry import Arc, BezierChain, BSpline, Line, Loop, Region
from wrapit.geometry.outlines.polygons import loop_area_mm2
from wrapit.kernel.edges import edge_start, loop_edges, region_face, spline_curve, turned, wire_of
from wrapit.kernel.measures import is_valid
from wrapit.kernel.terraces import VOLUME_TOLERANCE

LENGTHS = st.floats(0.1, 100)


def test_faces_of_splines_have_the_right_area() -> None:
    face = region_face(Region(Loop((circle(7, (3.0, 1.0)),))))
    assert abs(_area(face)) == pytest.approx(49 * math.pi, rel=VOLUME_TOLERANCE)


@pytest.mark.parametrize("at_start", [True, False])
def test_slivers_in_an_outline_are_passed_over(at_start: bool) -> None:
    points = arcs((7.0, 0.0), math.pi / 2, (7.0, 180)).points
    sliver = np.arange(4)[:, None] * np.array([0.0, 2e-8])
    if at_start:
        points = np.concatenate([[points[0, 0] - sliver[::-1]], points])
    else:
        points = np.concatenate([points, [points[-1, 3] - sliver]])
    ends = [(float(x), float(y)) for x, y in (points[-1, 3], points[0, 0])]
    face = region_face(Region(Loop((BezierChain(points), Line(*ends)))))
    assert is_valid(face)
    assert abs(_area(face)) == pytest.approx(49 * math.pi / 2, rel=1e-6)


@given(width=LENGTHS, height=LENGTHS, hole=st.floats(0.05, 0.45), clockwise=st.booleans())
def test_faces_have_the_area_of_their_outlines(
    width: float, height: float, hole: float, clockwise: bool
) -> None:
    corners = [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)]
    outer = turned(polygon(corners), counter_clockwise=not clockwise)
    radius = hole * min(width, height)
    inner = Loop((Arc((width / 2, height / 2), radius, 0.3, 2 * math.pi),))
    face = region_face(Region(outer, (inner,)), 1.5)
    assert is_valid(face)
    assert _area(face) == pytest.approx(width * height - math.pi * radius**2, rel=1e-9)


@given(st.lists(st.tuples(LENGTHS, LENGTHS), min_size=3, max_size=9, unique=True), st.booleans())
def test_loops_turned_round_keep_their_points(corners: list[tuple[float, float]], way: bool) -> None:
    loop = polygon(corners)
    other = turned(loop, counter_clockwise=way)
    assert sorted(map(edge_start, other.edges)) == sorted(map(edge_start, loop.edges))
    assert (loop_area_mm2(other) > 0) == way or loop_area_mm2(loop) == 0


def test_a_curve_has_the_poles_and_knots_of_its_spline() -> None:
    poles = np.array([(0, 0), (1, 2), (3, 2), (4, 0), (5, -1)], dtype=float)
    spline = BSpline(3, poles, np.array([0, 0, 0, 0, 0.4, 1, 1, 1, 1]))
    curve = spline_curve(spline, np.arange(5.0))
    got = [curve.Pole(index) for index in range(1, curve.NbPoles() + 1)]
    assert [(p.X(), p.Y(), p.Z()) for p in got] == [(*pole, z) for z, pole in enumerate(poles.tolist())]
    for u in np.linspace(0, 1, 7):
        point = curve.Value(float(u))
        assert (point.X(), point.Y()) == pytest.approx(tuple(spline.at(np.array([u]))[0]), abs=1e-12)


def test_an_outline_that_doesnt_close_is_refused() -> None:
    apart = [*loop_edges(polygon([(0, 0), (1, 0), (1, 1)])), *loop_edges(polygon([(5, 5), (6, 5), (6, 6)]))]
    with pytest.raises(KernelError, match="doesn't close"):
        wire_of(apart)


def polygon(corners: Sequence[tuple[float, float]]) -> Loop:
    ends = [*corners[1:], corners[0]]
    return Loop(tuple(Line(a, b) for a, b in zip(corners, ends, strict=True)))


def _area(face: object) -> float:
    from OCP.BRepGProp import BRepGProp
    from OCP.GProp import GProp_GProps

    properties = GProp_GProps()
    BRepGProp.SurfaceProperties_s(face, properties)
    return float(properties.Mass())
