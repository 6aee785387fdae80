"""The parts of cutting curves into a planar graph, each against slow plain code."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.drawing.test_planar import FEW, SEEDS, wavy
from wrapit.drawing.svg.cutting import stretches
from wrapit.drawing.svg.shared_places import Places
from wrapit.geometry import FloatArray
from wrapit.geometry.bezier import evaluate, split


class PlainPlaces:
    """What `Places` says, said plainly: all points compared, all numbers rewritten."""

    def __init__(self, tolerance: float) -> None:
        self.tolerance, self.points, self.owner, self.place, self.settled = tolerance, [], [], {}, set()

    def find(self, point: FloatArray) -> int:
        if self.points:
            far = np.linalg.norm(np.array(self.points) - point, axis=1)
            if far.min() <= self.tolerance:
                return self.owner[int(np.argmin(far))]
        self.points.append(point)
        self.owner.append(len(self.owner))
        self.place[self.owner[-1]] = point
        return self.owner[-1]

    def join(self, points: list[FloatArray], place: FloatArray) -> None:
        found = sorted({self.find(point) for point in points})
        self.owner = [found[0] if owner in found else owner for owner in self.owner]
        if not self.settled & set(found):
            self.place[found[0]] = place
        for other in found[1:]:
            self.place.pop(other)
        self.settled.add(found[0])


@FEW
@given(SEEDS, st.sampled_from([1e-9, 0.01, 0.3, 1.0, 50.0]), st.sampled_from([0.0, -1e6, 1e12]))
def test_places_by_grid_are_those_of_comparing_all(seed, tolerance, offset):
    rng = np.random.default_rng(seed)
    # Whole multiples of the tolerance lie exactly at the edge of cells and of reach.
    points = offset + rng.choice([tolerance * rng.integers(-4, 5, (60, 2)), rng.normal(0, 5, (60, 2))])
    quick, plain = Places(tolerance), PlainPlaces(tolerance)
    for k, point in enumerate(points):
        some = [point, *points[rng.integers(len(points), size=rng.integers(0, 3))]]
        if k % 3:
            assert quick.find(point) == plain.find(point)
        else:
            quick.join(some, point)
            plain.join(some, point)
    assert [quick.find(point) for point in points] == [plain.find(point) for point in points]
    assert list(quick.all()) == list(plain.place)
    assert all(np.array_equal(quick.place(number), place) for number, place in plain.place.items())


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
