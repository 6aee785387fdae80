"""Places that are one, against slow plain code, and how few points are compared."""

from __future__ import annotations

import math

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from tests.drawing.svg.curves import FEW, SEEDS
from wrapit.drawing.svg import shared_places
from wrapit.drawing.svg.shared_places import Places
from wrapit.geometry import FloatArray


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


def test_points_in_the_grid_are_compared_with_few_others(monkeypatch):
    compared = []
    sqrt = math.sqrt
    monkeypatch.setattr(shared_places.math, "sqrt", lambda value: compared.append(1) or sqrt(value))
    rng = np.random.default_rng(6)
    known = shared_places.Places(1.0)
    for point in rng.uniform(0, 100, (20_000, 2)):
        known.find(point)
    # Points that are kept lie farther apart than the tolerance: at most 4 in a cell, 4 cells around each.
    assert len(compared) < 16 * 20_000
    assert len(known.all()) > 4_000
