"""Many stretches cut at once, against one by one."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given

from tests.drawing.svg.curves import FEW, SEEDS, wavy
from wrapit.drawing.svg.cutting import cut_at_tips, stretches
from wrapit.geometry import BezierChain
from wrapit.geometry.bezier import evaluate, split


@FEW
@given(SEEDS)
def test_stretches_cut_at_once_are_those_cut_one_by_one(seed):
    rng = np.random.default_rng(seed)
    cubics = wavy(rng, closed=True).cubics
    count = len(cubics)
    starts = rng.choice([rng.uniform(0, count, 8), rng.integers(0, count, 8).astype(float)])
    ends = starts + rng.choice([0, 1e-8, 0.3, 1, 2.5, count], 8)
    for start, end, found in zip(starts, ends, stretches(cubics, starts, ends), strict=True):
        if end - start <= 1e-7:
            assert found is None
            continue
        assert found is not None
        assert np.array_equal(found[1:, 0], found[:-1, 3])
        for at, point in ((start, found[0, 0]), (end, found[-1, 3])):
            k = math.floor(at)
            assert evaluate(cubics[k % count][None], np.array([at - k]))[0, 0] == pytest.approx(point)
        if math.floor(start) + 1 >= end:
            low, high = start - math.floor(start), end - math.floor(start)
            left = split(cubics[math.floor(start) % count][None], high)[0] if high < 1 else None
            whole = cubics[math.floor(start) % count][None] if left is None else left
            assert np.array_equal(found, split(whole, low / high)[1] if low > 0 else whole)


@pytest.mark.parametrize(
    ("cubic", "lengths"),
    [
        ([[0, 0], [60, 40], [0, 40], [60, 0]], [43.2, 43.2]),  # a cusp
        ([[0, 0], [60.05, 40], [-0.05, 40], [60, 0]], [43.2, 43.2]),  # all but one
        ([[0, 0], [20, 0], [60, 0], [40, 0]], [45.45]),  # beyond its end and back on its own ink
        ([[40, 0], [60, 0], [20, 0], [0, 0]], [45.45]),
        ([[0, 0], [-20, 0], [80, 0], [40, 0]], [52.21]),  # beyond both ends
        ([[0, 0], [1.5, 0], [-0.6, 0], [0.9, 0]], [1.4]),  # a slip that ink hides
        ([[0, 0], [0, 0], [40, 20], [40, 20]], [44.7]),  # handles of no length
    ],
)
def test_a_cubic_that_turns_back_is_cut_and_runs_once_over_its_own_ink(
    cubic: list[list[float]], lengths: list[float]
) -> None:
    runs = cut_at_tips(np.array([cubic], dtype=float), False, 1.0)
    found = np.concatenate([BezierChain(cubics).lengths for cubics, _ in runs])
    assert found == pytest.approx(lengths, abs=0.1)
    assert not any(closed for _, closed in runs)


def test_a_ring_that_comes_back_on_its_own_ink_opens_there() -> None:
    """Round the corner to (40, 0), on to 45 and back: what follows begins on the line where it came back."""
    straight = [[0, 0], [20, 0], [60, 0], [40, 0]]
    others = [[[40, 0], [40, 10], [40, 20], [20, 30]], [[20, 30], [0, 20], [0, 10], [0, 0]]]
    for ring in ([straight, *others], [others[1], straight, others[0]]):
        ((chain, closed),) = cut_at_tips(np.array(ring, dtype=float), True, 1.0)
        assert not closed
        assert chain[0, 0] == pytest.approx((40, 0))
        assert chain[-1, 3] == pytest.approx((45.4, 0), abs=0.1)
        assert np.array_equal(chain[1:, 0], chain[:-1, 3])
