"""Exact outlines from polygons: the parts of a polygon that follow a parallel become that parallel.

A polygon operation (union, difference, opening) is robust but only about right; here it decides what
meets what, and the curves it was sampled from decide where, to 5e-5 mm. Where two parallels meet, their
common point is found by Newton's method; where they run together too closely for one (tangent wires),
a short straight edge joins them, on the polygon's side of both.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from wrapit.geometry.arrays import FloatArray
from wrapit.geometry.curveset import CurveSet
from wrapit.geometry.outlines.closing import closed_up
from wrapit.geometry.outlines.handover import Run, meet
from wrapit.geometry.outlines.loops import Arc, Edge, Line, Loop, Region, as_chain, point_of
from wrapit.geometry.outlines.parallels import Parallel, Round, Side
from wrapit.geometry.outlines.polygons import fitted_edges
from wrapit.geometry.polyline import signed_area

# How close together a polygon's points are, when its sides are recognised: a third more or less moves the
# area of 16 walls (2250 mm²) by 0.02 mm².
STEP_MM = 0.1
# Between two marks there are so many steps at least. Marks are the ring's sharp corners, the places beside
# curves' ends, and where it begins. A short side with points at its ends alone would be lost: those are its
# neighbours' as well.
CORNER_RAD = math.radians(6)
BETWEEN_MARKS = 4
SAME_PLACE_MM = 1e-7
SIDEWAYS = 0.02  # a foot more oblique than this (sine) is at a corner or an end
# How near free sides are to the polygon; nothing rests on them. At 0.0035 they have 7 % more cubics.
# Nearer only where a curve is that they must not come too near to.
FREE_TOLERANCES_MM = (0.005, 0.001)
FEWEST_POINTS = 12


@dataclass(frozen=True, eq=False)
class Outliner:
    """Replaces a polygon's sides at one of the distances from an edge, within `slack_mm`, by exact curves.

    `distances_mm` rise, and are further apart than twice the slack.
    """

    edges: tuple[Edge, ...]
    curves: CurveSet
    distances_mm: tuple[float, ...]
    slack_mm: float

    @staticmethod
    def of(edges: Sequence[Edge], distances_mm: Iterable[float], slack_mm: float) -> Outliner:
        """An outliner for the parallels of these edges at each of the distances."""
        curves = CurveSet.of([as_chain(edge) for edge in edges])
        return Outliner(tuple(edges), curves, tuple(sorted(set(distances_mm))), slack_mm)

    @cached_property
    def _joints(self) -> Any:
        """The ends of all curves, as shapely's points."""
        import shapely

        chains = [as_chain(edge) for edge in self.edges]
        return shapely.points([end for chain in chains for end in (chain.start, chain.end)])

    def region(self, polygon: Any) -> Region:
        """The exact region of a polygon whose outer ring is counter-clockwise, holes clockwise."""
        from shapely.geometry.polygon import orient

        polygon = orient(polygon)
        return Region(self.loop(polygon.exterior), tuple(self.loop(ring) for ring in polygon.interiors))

    def loop(self, ring: Any) -> Loop:
        """The exact loop of one ring."""
        runs, endless = self._runs(_sampled(ring, self._joints, self.distances_mm[-1] + self.slack_mm))
        if endless:
            return Loop(tuple(self._whole(runs[0])))
        ends = [
            meet(before, after, self.curves, self.distances_mm[0])
            for before, after in zip(runs, runs[1:] + runs[:1], strict=True)
        ]
        edges: list[Edge] = []
        for index, run in enumerate(runs):
            start, finish = ends[index - 1].entering, ends[index].leaving
            edges += self._edges(run, start.place, finish.place, start.point, finish.point)
            if ends[index].bridged:
                edges.append(Line(point_of(finish.point), point_of(ends[index].entering.point)))
        return Loop(tuple(closed_up(edges)))

    def _runs(self, points: FloatArray) -> tuple[list[Run], bool]:
        """The ring's runs in order, and whether it is one run without beginning or end."""
        near = self.curves.nearest(points, self.distances_mm[-1] + self.slack_mm)
        apart = np.abs(near.distance[:, None] - np.array(self.distances_mm))
        which = apart.argmin(axis=1)
        on = apart.min(axis=1) <= self.slack_mm
        key = np.full(len(points), -1, dtype=np.int64)
        place = np.full(len(points), np.nan)
        feet, tangents, _ = self.curves.frame(near.curve[on], near.at[on])
        away = points[on] - feet
        across = tangents[:, 0] * away[:, 1] - tangents[:, 1] * away[:, 0]
        which = which[on]
        distance = np.array(self.distances_mm)[which]
        oblique = np.abs((tangents * away).sum(axis=1)) > SIDEWAYS * distance
        number = np.empty(len(away), dtype=np.int64)
        # Points beside one curve, on one of its sides and at one distance are on one parallel.
        curve, level = near.curve[on], np.where(np.signbit(across), -1, 1) * (which + 1)
        beside = np.flatnonzero(~oblique)
        name = curve * (2 * len(self.distances_mm) + 1) + level
        _, first, number[beside] = np.unique(name[beside], return_index=True, return_inverse=True)
        sides = [(int(curve[at]), math.copysign(distance[at], level[at])) for at in beside[first].tolist()]
        parallels: dict[int, Parallel] = {
            n: Side(self.curves, self.edges[index], index, mm) for n, (index, mm) in enumerate(sides)
        }
        centres = _Points()
        rounds: dict[tuple[int, float], int] = {}
        for at in np.flatnonzero(oblique).tolist():
            round_end = (centres.index(feet[at].tolist()), float(distance[at]))
            number[at] = rounds.setdefault(round_end, len(sides) + len(rounds))
        parallels |= {n: Round(centres.points[centre], mm) for (centre, mm), n in rounds.items()}
        key[on] = number
        place[on] = np.where(oblique, np.arctan2(away[:, 1], away[:, 0]), near.at[on])
        return _grouped(points, key, place, parallels)

    def _whole(self, run: Run) -> list[Edge]:
        """A ring that is one run: a full circle, a closed parallel without seam in sight, or free."""
        if isinstance(run.parallel, Round):
            turn = math.copysign(2 * math.pi, signed_area(run.points))
            return [Arc(run.parallel.centre, run.parallel.radius_mm, float(run.place[0]), turn)]
        if run.parallel is None:
            half = int(np.linalg.norm(run.points - run.points[0], axis=1).argmax())
            back = np.concatenate([run.points[half:], run.points[:1]])
            return closed_up(self._free(run.points[: half + 1]) + self._free(back))
        start, end = float(run.place[0]), float(run.place[-1])
        ends = run.parallel.at(np.array([start, end]))[0]
        return closed_up([run.parallel.between(start, end), Line(point_of(ends[1]), point_of(ends[0]))])

    def _edges(self, run: Run, start: float, end: float, first: FloatArray, last: FloatArray) -> list[Edge]:
        if run.parallel is None:
            # A point this near to the handover may lie behind it and would fold the outline back.
            apart = np.minimum(*(np.linalg.norm(run.points - end, axis=1) for end in (first, last)))
            inner = run.points[apart > 3 * self.slack_mm]
            return self._free(np.concatenate([first[None], inner, last[None]]))
        if np.linalg.norm(first - last) < 1e-7 and abs(end - start) < 1e-5:
            return []
        return [run.parallel.between(start, end)]

    def _free(self, points: FloatArray) -> list[Edge]:
        """Fitted edges; ever shorter ones where one would come too near a curve, at last straight ones."""
        for tolerance_mm in FREE_TOLERANCES_MM:
            edges = fitted_edges(points, tolerance_mm)
            if all(self._clear(edge, points) for edge in edges):
                return edges
        if len(points) >= FEWEST_POINTS:
            half = len(points) // 2
            return [*self._free(points[: half + 1]), *self._free(points[half:])]
        thinned = _without_needless(points)
        return [Line(point_of(a), point_of(b)) for a, b in itertools.pairwise(thinned)]

    def _clear(self, edge: Edge, points: FloatArray) -> bool:
        """Whether an edge keeps the largest distance from any curve, or as much of it as the polygon."""
        import shapely

        if isinstance(edge, Line):
            return True
        sampled = edge.sampled(0.02)
        near = self.curves.nearest(sampled, self.distances_mm[-1]).distance
        if (near < self.distances_mm[0] - 1e-7).any():
            return False
        between = shapely.points(sampled[near < self.distances_mm[-1] - 1e-7])
        apart = shapely.distance(between, shapely.LineString(points))
        return bool(apart.max(initial=0.0) <= self.slack_mm)


def _sampled(ring: Any, joints: Any, far_mm: float) -> FloatArray:
    """The ring's corners (n, 2) with points between them at most STEP_MM apart, more between near marks.

    `joints` are the ends of curves (shapely points); those within `far_mm` of the ring are marks.
    """
    import shapely

    corners = np.asarray(ring.coords)
    along = np.diff(corners, axis=0)
    place = np.concatenate([[0.0], np.cumsum(np.linalg.norm(along, axis=1))])
    before = np.roll(along, 1, axis=0)
    cross = before[:, 0] * along[:, 1] - before[:, 1] * along[:, 0]
    sharp = np.abs(np.arctan2(cross, (before * along).sum(axis=1))) > CORNER_RAD
    beside = shapely.line_locate_point(ring, joints[shapely.dwithin(joints, ring, far_mm)])
    marks = np.unique(np.concatenate([place[[0, -1]], place[:-1][sharp], beside]))
    steps = np.diff(marks) / BETWEEN_MARKS
    inner = (marks[:-1] + np.arange(1, BETWEEN_MARKS)[:, None] * steps)[:, steps < STEP_MM]
    every = np.unique(np.concatenate([place, marks, inner.ravel()]))
    every = every[np.concatenate([[True], np.diff(every) > SAME_PLACE_MM])]
    pieces = np.ceil(np.diff(every) / STEP_MM).astype(int)
    which = np.repeat(np.arange(len(pieces)), pieces)
    share = (np.arange(len(which)) - np.repeat(np.cumsum(pieces) - pieces, pieces)) / pieces[which]
    at = every[which] + share * np.diff(every)[which]
    return np.column_stack([np.interp(at, place, corners[:, axis]) for axis in (0, 1)])


class _Points:
    """Numbers points; points within 1e-6 of one another get the same number."""

    def __init__(self) -> None:
        self.points: list[tuple[float, float]] = []
        self._known: dict[tuple[int, int], int] = {}

    def index(self, point: Sequence[float]) -> int:
        key = (round(point[0] * 1e6), round(point[1] * 1e6))
        if key not in self._known:
            near = [self._known.get((key[0] + i, key[1] + j)) for i in (-1, 0, 1) for j in (-1, 0, 1)]
            found = next((n for n in near if n is not None), None)
            if found is None:
                found = len(self.points)
                self.points.append(point_of(point))
            self._known[key] = found
        return self._known[key]


def _grouped(
    points: FloatArray, key: np.ndarray, place: FloatArray, parallels: dict[int, Parallel]
) -> tuple[list[Run], bool]:
    """Runs of neighbouring points on one parallel; single points between two parallels are left out."""
    key = key.copy()
    jump = _jumps(points, key, place, parallels)
    keep = np.ones(len(points), dtype=bool)
    for index in np.flatnonzero(jump & np.roll(jump, 1)).tolist():
        neighbours = key[index - 1], key[(index + 1) % len(points)]
        if min(neighbours) >= 0:
            keep[index] = False
        else:
            key[index] = -1
    points, key, place = points[keep], key[keep], place[keep]
    jump = _jumps(points, key, place, parallels)
    cuts = np.flatnonzero(jump) + 1
    if not len(cuts):
        return [Run(parallels.get(int(key[0])), points, _unwrapped(key[0], place, parallels))], True
    order = np.roll(np.arange(len(points)), -int(cuts[0] % len(points)))
    starts = np.concatenate([[0], np.cumsum(np.diff(cuts)), [len(points)]])
    runs = []
    for a, b in itertools.pairwise(starts):
        which = order[a:b]
        name = int(key[which[0]])
        runs.append(Run(parallels.get(name), points[which], _unwrapped(name, place[which], parallels)))
    return runs, False


def _jumps(
    points: FloatArray, key: np.ndarray, place: FloatArray, parallels: dict[int, Parallel]
) -> np.ndarray:
    """Whether the run ends between point i and the next: another parallel, or a leap along the same one."""
    jump = key != np.roll(key, -1)
    steps = np.linalg.norm(np.roll(points, -1, axis=0) - points, axis=1)
    for name, parallel in parallels.items():
        if isinstance(parallel, Side):
            mine = np.flatnonzero((key == name) & ~jump)
            start, end = place[mine], np.roll(place, -1)[mine]
            # A piece is at most about 1 mm long; inside a tight bend a parallel moves slower than its curve.
            leap = np.abs(end - start) > 6 * steps[mine] + 0.6
            jump[mine[leap | parallel.folds(start, end)]] = True
    return jump


def _unwrapped(name: int, place: FloatArray, parallels: dict[int, Parallel]) -> FloatArray:
    return np.unwrap(place) if isinstance(parallels.get(int(name)), Round) else place


def _without_needless(points: FloatArray) -> FloatArray:
    """The points without those on the straight line between their neighbours."""
    a, b = np.diff(points[:-1], axis=0), np.diff(points[1:], axis=0)
    bent = np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) > 1e-9
    return points[np.concatenate([[True], bent, [True]])]
