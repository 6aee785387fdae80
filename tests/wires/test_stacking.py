"""Wires are laid as the plain method lays them, one station after another, at a cost that grows with them."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial import cKDTree

from tests.jig.metal import scribble
from wrapit.geometry import BezierChain, BSpline, FloatArray, from_chain, straight
from wrapit.geometry.arclength import ArcLength
from wrapit.wires import nearness
from wrapit.wires.nearness import Neighbours
from wrapit.wires.stacking import SELF_DIAMETERS, SELF_ROUNDS, STEP_MM, _points, _ramped, lay_wires


def plainly_laid(splines: list[BSpline], d: float) -> list[tuple[tuple[float, float], ...]]:
    """The same heights by comparing each station with all that were laid before it."""
    profiles = []
    below, heights = np.empty((0, 2)), np.empty(0)
    for spline in splines:
        lengths = ArcLength(spline)
        at_mm = lengths.stations(STEP_MM)
        points = spline.at(lengths.parameter(at_mm))
        needed = np.array([on_top(point, below, heights, d) for point in points])
        profile = _ramped(needed, d)
        for _ in range(SELF_ROUNDS):
            for index, point in enumerate(points):
                far = at_mm[index] - at_mm > SELF_DIAMETERS * d
                needed[index] = max(needed[index], on_top(point, points[far], profile[far], d))
            raised = _ramped(needed, d)
            if np.array_equal(raised, profile):
                break
            profile = raised
        profiles.append(_points(at_mm, profile) if profile.max() > 1e-9 else ())
        below, heights = np.concatenate([below, points]), np.concatenate([heights, profile])
    return profiles


def on_top(point: FloatArray, others: FloatArray, heights: FloatArray, d: float) -> float:
    apart2 = ((others - point) ** 2).sum(axis=1)
    near = apart2 <= d**2
    return float((heights[near] + np.sqrt(np.maximum(d**2 - apart2[near], 0.0))).max(initial=0.0))


def star(wires: int, reach_mm: float = 3.0) -> list[BSpline]:
    """Straight wires through one place: thousands of stations within a diameter."""
    angles = np.pi * np.arange(wires) / wires
    ends = reach_mm * np.column_stack([np.cos(angles), np.sin(angles)])
    return [from_chain(straight(-end, end)) for end in ends]


def strewn(wires: int) -> list[BSpline]:
    """Short wires on a page that grows with them: as near to one another however many there are."""
    rng = np.random.default_rng(wires)
    starts = rng.uniform(0, 3 * math.sqrt(wires), (wires, 2))
    ends = starts + rng.uniform(-4, 4, (wires, 2))
    return [from_chain(straight(a, b)) for a, b in zip(starts, ends, strict=True)]


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 2**32 - 1), st.integers(1, 5), st.floats(3, 12), st.floats(0.2, 1.6))
def test_random_wires_are_laid_as_one_by_one(seed: int, wires: int, size_mm: float, d: float) -> None:
    rng = np.random.default_rng(seed)
    chains: list[BezierChain] = [scribble(rng, size_mm, 4) for _ in range(wires)]
    splines = [from_chain(chain) for chain in chains]
    new, plain = lay_wires(splines, d), plainly_laid(splines, d)
    assert [len(profile) for profile in new] == [len(profile) for profile in plain]
    for profile, other in zip(new, plain, strict=True):
        assert np.array(profile) == pytest.approx(np.array(other), abs=1e-6)


def test_many_wires_through_one_place_lie_upon_one_another() -> None:
    splines = star(12)
    profiles = lay_wires(splines, 1.0)
    assert profiles == plainly_laid(splines, 1.0)
    tops = [max((z for _, z in profile), default=0.0) for profile in profiles]
    assert tops == pytest.approx(np.arange(12.0), abs=0.02)


def test_nothing_to_lay() -> None:
    assert lay_wires([], 1.0) == []


def test_pairs_are_the_same_however_few_are_looked_at_together(monkeypatch: pytest.MonkeyPatch) -> None:
    points = np.random.default_rng(1).uniform(0, 6, (400, 2))
    cloud = Neighbours.of(points, 1.0)
    laid = slice(150, 400)

    def pairs() -> tuple[int, set[tuple[int, int]]]:
        parts = list(cloud.before(laid))
        found = [
            pair for near in parts for pair in zip(near.later.tolist(), near.earlier.tolist(), strict=True)
        ]
        assert len(found) == len(set(found))
        return len(parts), set(found)

    at_once, all_pairs = pairs()
    monkeypatch.setattr(nearness, "PAIRS_AT_ONCE", 500)
    apart, few_at_a_time = pairs()
    assert at_once == 1 < apart
    plain = {(int(b), int(a)) for a, b in cKDTree(points).query_pairs(1.0) if b >= 150}
    assert all_pairs == few_at_a_time == plain


def test_pairs_grow_with_the_wires(monkeypatch: pytest.MonkeyPatch) -> None:
    """Four times the wires on four times the page: four times the pairs, and each station sorted once."""
    counted: list[int] = []
    trees: list[int] = []
    looked, sorted_once = Neighbours._pairs, Neighbours.of

    def counting(self: Neighbours, stations: np.ndarray) -> nearness.Near:
        near = looked(self, stations)
        counted[-1] += len(near.later)
        return near

    def of(points: FloatArray, reach_mm: float) -> Neighbours:
        trees[-1] += len(points)
        return sorted_once(points, reach_mm)

    monkeypatch.setattr(Neighbours, "_pairs", counting)
    monkeypatch.setattr(Neighbours, "of", of)
    for wires in (100, 400):
        counted.append(0)
        trees.append(0)
        lay_wires(strewn(wires), 0.8)
    assert counted[1] < 5 * counted[0]
    assert trees[1] < 5 * trees[0]
