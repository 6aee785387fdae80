"""Many stretches cut at once, against one by one."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given

from tests.drawing.svg.curves import FEW, SEEDS, wavy
from wrapit.drawing.svg.cutting import stretches
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
