"""Lengths along chains of points, and points at lengths."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.geometry.shapes import Motion, mirrorings, motions, points
from wrapit.geometry.arrays import median
from wrapit.geometry.polyline import (
    at_lengths,
    evenly,
    lengths,
    signed_area,
    slopes,
    steps,
    total_length,
)

chains = st.lists(points, min_size=3, max_size=12, unique=True).map(lambda found: np.array(found, float))


@given(chains, motions | mirrorings, st.floats(0, 1))
def test_lengths_add_up_and_stay_under_rigid_motion(chain: np.ndarray, motion: Motion, share: float) -> None:
    along = lengths(chain)
    assert np.allclose(np.diff(along), steps(chain))
    assert along[-1] == pytest.approx(total_length(chain))
    assert np.allclose(lengths(motion.of(chain)), along, atol=1e-9)
    at = np.array([share * along[-1]])
    assert np.allclose(
        at_lengths(motion.of(chain), along, at), motion.of(at_lengths(chain, along, at)), atol=1e-9
    )


@given(chains)
def test_points_at_their_own_lengths_are_the_points(chain: np.ndarray) -> None:
    along = lengths(chain)
    assert np.allclose(at_lengths(chain, along, along), chain, atol=1e-9)
    assert np.array_equal(at_lengths(chain, along, np.array([-5.0, 1e9])), chain[[0, -1]])


@given(chains, st.integers(2, 30))
def test_even_points_lie_on_the_chain(chain: np.ndarray, count: int) -> None:
    import shapely

    found = evenly(chain, count)
    assert len(found) == count
    assert np.allclose(found[[0, -1]], chain[[0, -1]])
    assert shapely.distance(shapely.LineString(chain), shapely.points(found)).max() < 1e-9


@given(chains, motions, mirrorings)
def test_the_area_is_signed(chain: np.ndarray, motion: Motion, mirroring: Motion) -> None:
    area = signed_area(chain)
    assert signed_area(motion.of(chain)) == pytest.approx(area, abs=1e-9)
    assert signed_area(mirroring.of(chain)) == pytest.approx(-area, abs=1e-9)
    assert signed_area(chain[::-1]) == pytest.approx(-area, abs=1e-9)


@given(chains)
def test_slopes_are_central_differences(chain: np.ndarray) -> None:
    assert np.array_equal(slopes(chain), np.gradient(chain, axis=0))


@given(st.lists(st.floats(-1e9, 1e9) | st.just(float("nan")), min_size=1, max_size=12).map(np.array))
def test_medians_are_those_of_numpy(values: np.ndarray) -> None:
    assert np.array_equal(median(values), np.median(values), equal_nan=True)
