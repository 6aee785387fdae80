"""The nearest place on any of several curves, against dense samples; folding and places."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.geometry.shapes import Motion, motions, points, tame_chains
from wrapit.geometry import BezierChain, joined, straight
from wrapit.geometry.curveset import CurveSet

sets = st.lists(tame_chains(), min_size=1, max_size=3)
some = st.lists(points, min_size=1, max_size=8).map(lambda found: np.array(found, float))


@settings(max_examples=40)
@given(sets, some)
def test_nearest_is_as_near_as_any_sample(chains: list[BezierChain], wanted: np.ndarray) -> None:
    near = CurveSet.of(chains).nearest(wanted, 200.0)
    dense = np.array(
        [[np.linalg.norm(chain.sampled(0.01) - p, axis=1).min() for chain in chains] for p in wanted]
    )
    assert (near.distance <= dense.min(axis=1) + 1e-9).all()
    assert (near.distance >= dense.min(axis=1) - 0.01).all()
    feet, tangents, _ = CurveSet.of(chains).frame(near.curve, near.at)
    assert np.allclose(np.linalg.norm(wanted - feet, axis=1), near.distance, atol=1e-9)
    assert np.allclose(np.linalg.norm(tangents, axis=1), 1.0)


@settings(max_examples=60)
@given(sets, some, st.sampled_from([0.7, 5.0, 200.0]))
def test_no_piece_that_is_left_out_would_have_won(
    chains: list[BezierChain], wanted: np.ndarray, reach_mm: float
) -> None:
    curves = CurveSet.of(chains)
    near = curves.nearest(wanted, reach_mm)
    index, piece, at, distance = curves.all_near(wanted, reach_mm)
    for point in range(len(wanted)):
        mine = index == point
        assert near.distance[point] == distance[mine].min(initial=np.inf)
        if mine.any():
            best = np.flatnonzero(mine & (distance == near.distance[point]))
            assert near.at[point] in (piece + at)[best]


@settings(max_examples=30)
@given(sets, some, motions)
def test_distances_stay_under_rigid_motion(
    chains: list[BezierChain], wanted: np.ndarray, motion: Motion
) -> None:
    moved = CurveSet.of([chain.mapped(motion.matrix, motion.shift) for chain in chains])
    before, after = CurveSet.of(chains).nearest(wanted, 200.0), moved.nearest(motion.of(wanted), 200.0)
    assert np.allclose(before.distance, after.distance, atol=1e-7)


def test_beyond_reach_is_nothing() -> None:
    near = CurveSet.of([straight((0, 0), (9, 0))]).nearest(np.array([(4.0, 2.0), (4.0, 1.0)]), 1.5)
    assert near.distance.tolist() == [np.inf, pytest.approx(1.0)]
    assert near.curve.tolist() == [-1, 0]


@given(sets)
def test_places_lead_back_to_the_own_cubics(chains: list[BezierChain]) -> None:
    curves = CurveSet.of(chains)
    for curve, chain in enumerate(chains):
        low, high = curves.start_of(curve), curves.end_of(curve)
        for at in np.linspace(low, high, 7):
            cubic, t = curves.cubic_place(curve, float(at))
            point, *_ = curves.frame(np.array([curve]), np.array([at]))
            own = BezierChain(curves.cubics[cubic][None])
            s = 1 - t
            p = own.points[0]
            assert np.allclose(
                point[0], s**3 * p[0] + 3 * s * s * t * p[1] + 3 * s * t * t * p[2] + t**3 * p[3], atol=1e-9
            )
        ends, *_ = curves.frame(np.array([curve, curve]), np.array([low, high]))
        assert np.allclose(ends, [chain.start, chain.end], atol=1e-9)


def test_corners_are_kinks() -> None:
    curves = CurveSet.of([joined([straight((0, 0), (5, 0)), straight((5, 0), (5, 5))])])
    places, angles = curves.kinks
    assert angles == pytest.approx([np.pi / 2])
    assert np.allclose(curves.frame(np.array([0]), places)[0], [[5.0, 0.0]])
