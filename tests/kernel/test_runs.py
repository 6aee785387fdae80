"""Long edges in the place of many cubics: as near, exact for whoever integrates along them."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.interpolate import CubicSpline

from wrapit.geometry import BezierChain, FloatArray, Line, Loop, Region
from wrapit.kernel.measures import is_valid
from wrapit.kernel.runs import MOST_TURNING_RAD, RUN_TOLERANCE_MM, between_corners, smooth_runs
from wrapit.kernel.terraces import Terrace, terraced_solid


def waves(seed: int, count: int, step_mm: float) -> FloatArray:
    """A smooth line of cubics (count, 4, 2) that rolls up and down, above y = 10."""
    rng = np.random.default_rng(seed)
    x = np.cumsum(rng.uniform(0.5, 1.5, count + 1)) * step_mm
    y = 20 + rng.uniform(-0.7, 0.7, size=count + 1) * step_mm
    u = np.concatenate([[0], np.cumsum(np.hypot(np.diff(x), np.diff(y)))])
    spline, third = CubicSpline(u, np.column_stack([x, y])), np.diff(u)[:, None] / 3
    points, along = spline(u), spline(u, 1)
    ends = points[:-1], points[1:]
    return np.stack([ends[0], ends[0] + along[:-1] * third, ends[1] - along[1:] * third, ends[1]], axis=1)


@settings(max_examples=40)
@given(st.integers(0, 10**6), st.integers(1, 40), st.floats(0.05, 2))
def test_runs_follow_their_cubics(seed: int, count: int, step_mm: float) -> None:
    cubics = waves(seed, count, step_mm)
    runs = smooth_runs(cubics)
    assert len(runs) <= count
    assert np.array_equal(runs[0].poles[0], cubics[0, 0])
    assert np.array_equal(runs[-1].poles[-1], cubics[-1, 3])
    line = shapely.LineString(BezierChain(cubics).sampled(step_mm / 400))
    for before, after in itertools.pairwise(runs):
        assert np.array_equal(before.poles[-1], after.poles[0])
        a, b = before.poles[-1] - before.poles[-2], after.poles[1] - after.poles[0]
        assert abs(a[0] * b[1] - a[1] * b[0]) < 1e-9 * math.hypot(*a) * math.hypot(*b) + 1e-15
    for run in runs:
        assert len(run.breaks) == 2
        assert np.linalg.norm(np.diff(run.poles, axis=0), axis=1).sum() <= 1.5 * run.domain[1]
        points = run.at(np.linspace(*run.domain, 200))
        sagitta = 1e-5 * step_mm
        assert shapely.distance(shapely.points(points), line).max() < 1.5 * RUN_TOLERANCE_MM + sagitta
        assert run.domain[1] > 0


@pytest.mark.parametrize("seed", range(6))
def test_the_kernels_own_volume_is_that_of_the_outline(seed: int) -> None:
    chain = BezierChain(waves(seed, 40, 1.0))
    (x0, y0), (x1, y1) = chain.start.tolist(), chain.end.tolist()
    sides = (Line((x1, y1), (x1, 0.0)), Line((x1, 0.0), (x0, 0.0)), Line((x0, 0.0), (x0, y0)))
    assert shapely.LineString(chain.sampled(0.01)).is_simple
    made = terraced_solid(Loop((chain, *sides)), 0.0, 3.0, [], [], "plate")  # which proves the volume
    assert is_valid(made.solid)
    assert made.plain == ()


@pytest.mark.parametrize("seed", range(4))
def test_terraces_with_slack_keep_within_it_in_fewer_faces(seed: int) -> None:
    chain = BezierChain(waves(seed, 40, 1.0))
    (x0, y0), (x1, y1) = chain.start.tolist(), chain.end.tolist()
    sides = (Line((x1, y1), (x1, 1.0)), Line((x1, 1.0), (x0, 1.0)), Line((x0, 1.0), (x0, y0)))
    corners = [(x0 - 2, 0.0), (x1 + 2, 0.0), (x1 + 2, 30.0), (x0 - 2, 30.0)]
    rim = Loop(tuple(Line(a, b) for a, b in zip(corners, [*corners[1:], corners[0]], strict=True)))
    region = Region(Loop((chain, *sides)))
    made = [
        terraced_solid(rim, 0.0, 3.0, [Terrace(region, 5.0, slack_mm=slack)], [], "plate")
        for slack in (RUN_TOLERANCE_MM, 0.009)
    ]
    assert len(smooth_runs(chain.points, 0.009)) < len(smooth_runs(chain.points))
    assert abs(made[0].volume_mm3 - made[1].volume_mm3) < 0.009 * chain.length * 2
    line = shapely.LineString(chain.sampled(1e-3))
    for run in smooth_runs(chain.points, 0.009):
        assert shapely.distance(shapely.points(run.at(np.linspace(*run.domain, 300))), line).max() < 0.0095


def test_corners_stay_and_no_run_turns_further_than_it_may() -> None:
    turn = np.linspace(0, 3 * math.pi, 31)
    points = np.column_stack([np.cos(turn), np.sin(turn)]) * 5
    along = np.column_stack([-np.sin(turn), np.cos(turn)]) * 5 * 4 / 3 * math.tan(turn[1] / 4)
    spiral = np.stack([points[:-1], points[:-1] + along[:-1], points[1:] - along[1:], points[1:]], axis=1)
    assert len(between_corners(spiral)) == 1
    assert len(smooth_runs(spiral)) >= 3 * math.pi / MOST_TURNING_RAD
    away = np.array([points[-1] + share * np.array([3.0, 3.0]) for share in (0, 1 / 3, 2 / 3, 1)])
    assert len(between_corners(np.concatenate([spiral, away[None]]))) == 2
