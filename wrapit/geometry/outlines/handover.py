"""Where one parallel hands over to the next along an outline."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from wrapit.geometry.arrays import FloatArray
from wrapit.geometry.curveset import CurveSet
from wrapit.geometry.outlines.parallels import Parallel, Round, Side

# How far a handover may lie from the polygon's corner (three of its steps); how near two ends are one point
# (what rounding leaves); how far along its curve a run may be led to an end; how much nearer than its own
# distance a point may lie and still be on the outline. None of them decides: each a third more or less leaves
# every edge of two of our drawings as it is.
NEAR_MM = 0.3
SAME_MM = 2e-6
REACH_PIECES = 2.0
VISIBLE_MM = 2e-7
_NEWTON_STEPS = 30  # only a bound: with 21 the outlines are the same


@dataclass(frozen=True, eq=False)
class Run:
    """Neighbouring points of a polygon on one parallel (None: on none), and their places on it."""

    parallel: Parallel | None
    points: FloatArray
    place: FloatArray


@dataclass(frozen=True, eq=False)
class Stop:
    """A place on a run and the point there."""

    place: float
    point: FloatArray


@dataclass(frozen=True, eq=False)
class Meeting:
    """Where the run before stops and the run after starts; `bridged` when the points differ."""

    leaving: Stop
    entering: Stop
    bridged: bool = False


def meet(before: Run, after: Run, curves: CurveSet, distance_mm: float) -> Meeting:
    """The handover from one run to the next."""
    if before.parallel is None and after.parallel is None:
        middle = (before.points[-1] + after.points[0]) / 2
        return Meeting(Stop(math.nan, middle), Stop(math.nan, middle))
    if before.parallel is None:
        stop = _visible(after, 0, curves, distance_mm)
        return Meeting(Stop(math.nan, stop.point), stop)
    if after.parallel is None:
        stop = _visible(before, -1, curves, distance_mm)
        return Meeting(stop, Stop(math.nan, stop.point))
    return (
        _at_joint(before, after)
        or _crossing(before, after, curves, distance_mm)
        or _bridge(before, after, curves, distance_mm)
    )


def _bridge(before: Run, after: Run, curves: CurveSet, distance_mm: float) -> Meeting:
    leaving = _visible(before, -1, curves, distance_mm)
    entering = _visible(after, 0, curves, distance_mm)
    return Meeting(leaving, entering, bridged=True)


def _visible(run: Run, end: int, curves: CurveSet, distance_mm: float) -> Stop:
    """The outermost place of the run, from its first (0) or last (-1) point, that no other curve covers."""
    assert run.parallel is not None
    places = run.place if end == 0 else run.place[::-1]
    points = run.parallel.at(places)[0]
    for count in (4, len(points)):
        near = curves.nearest(points[:count], distance_mm)
        clear = np.flatnonzero(near.distance >= distance_mm - VISIBLE_MM)
        if len(clear):
            return Stop(float(places[clear[0]]), points[clear[0]])
    return Stop(float(places[0]), points[0])


def _at_joint(before: Run, after: Run) -> Meeting | None:
    """Runs that touch at the end of a curve: two curves with one tangent, or a curve and its round end."""
    a, b = before.parallel, after.parallel
    assert a is not None
    assert b is not None
    for place_a, place_b in _joints(before, after):
        point_a, point_b = (p.at(np.array([s]))[0][0] for p, s in ((a, place_a), (b, place_b)))
        if (
            _within_reach(a, place_a, before.place[-1])
            and _within_reach(b, place_b, after.place[0])
            and np.linalg.norm(point_a - point_b) <= SAME_MM
            and np.linalg.norm(point_a - before.points[-1]) <= NEAR_MM
            and np.linalg.norm(point_b - after.points[0]) <= NEAR_MM
        ):
            return Meeting(
                Stop(_unwound(a, place_a, before.place[-1]), point_a),
                Stop(_unwound(b, place_b, after.place[0]), point_a),
            )
    return None


def _joints(before: Run, after: Run) -> list[tuple[float, float]]:
    """Places where both could meet: the end of a curve that its run is nearer to, and what touches it."""
    a, b = before.parallel, after.parallel
    if isinstance(a, Side):
        s = min(a.bounds, key=lambda place: abs(place - before.place[-1]))
        if isinstance(b, Side):
            return [(s, min(b.bounds, key=lambda place: abs(place - after.place[0])))]
        if isinstance(b, Round):
            return [(s, _angle(b, a.at(np.array([s]))[0][0]))]
    if isinstance(a, Round) and isinstance(b, Side):
        t = min(b.bounds, key=lambda place: abs(place - after.place[0]))
        return [(_angle(a, b.at(np.array([t]))[0][0]), t)]
    return []


def _within_reach(parallel: Parallel, place: float, run_end: float) -> bool:
    """Whether the parallel leads from the run's end to the place, not far and without folding back."""
    if isinstance(parallel, Round):
        return True
    folds = parallel.folds(np.array([place]), np.array([run_end]))[0]
    return abs(place - run_end) <= REACH_PIECES and not folds


def _angle(circle: Round, point: FloatArray) -> float:
    return math.atan2(point[1] - circle.centre[1], point[0] - circle.centre[0])


def _unwound(parallel: Parallel, place: float, like: float) -> float:
    """An angle as the one within half a turn of `like`; other places as they are."""
    if isinstance(parallel, Side):
        return place
    return place + 2 * math.pi * round((like - place) / (2 * math.pi))


def _crossing(before: Run, after: Run, curves: CurveSet, distance_mm: float) -> Meeting | None:
    """The point common to both parallels near the handover, if there is a clear one."""
    a, b = before.parallel, after.parallel
    assert a is not None
    assert b is not None
    s, t = float(before.place[-1]), float(after.place[0])
    for _ in range(_NEWTON_STEPS):
        pa, da = a.at(np.array([s]))
        pb, db = b.at(np.array([t]))
        gap = pb[0] - pa[0]
        if np.hypot(*gap) < 1e-10:
            break
        cross = da[0, 0] * db[0, 1] - da[0, 1] * db[0, 0]
        if abs(cross) < 1e-4 * np.hypot(*da[0]) * np.hypot(*db[0]) or cross == 0:
            return None
        step_a = (gap[0] * db[0, 1] - gap[1] * db[0, 0]) / cross
        step_b = (gap[0] * da[0, 1] - gap[1] * da[0, 0]) / cross
        s = min(max(s + max(-0.3, min(0.3, step_a)), a.bounds[0]), a.bounds[1])
        t = min(max(t + max(-0.3, min(0.3, step_b)), b.bounds[0]), b.bounds[1])
    else:
        return None
    point = pa[0]
    near = all(np.linalg.norm(point - p) <= NEAR_MM for p in (before.points[-1], after.points[0]))
    ahead = (
        np.dot(point - before.points[0], before.points[-1] - before.points[0]) >= 0 or len(before.points) < 4
    )
    clear = curves.nearest(point[None], distance_mm).distance[0] >= distance_mm - VISIBLE_MM
    return Meeting(Stop(s, point), Stop(t, point)) if near and ahead and clear else None
