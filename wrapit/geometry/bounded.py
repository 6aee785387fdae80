"""Curves made gentle: the nearest curve that nowhere bends more tightly than a radius."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Final

import numpy as np

from wrapit.geometry.arclength import piece
from wrapit.geometry.arrays import FloatArray, norms
from wrapit.geometry.bezier import BezierChain, derivative, evaluate, joined, second_derivative
from wrapit.geometry.steering import MOST_BEND, NEARLY, STEP, ComplexArray, Course, Held, Path, steered

# A bend is tight from here, in shares of the bound: above what cubics make of an arc at MOST_BEND.
TIGHT: Final = 1.003
# A bend at a joint by more than this (rad) is a corner.
CORNER_RAD: Final = 1e-6
# Each cubic is looked at in so many places.
PLACES: Final = 33
# How far a window goes to both sides of what is tight, in radii: so much, and so much more a radian of turn.
MARGIN, MARGIN_PER_RAD = 1.0, 1.0
# A window in which no path is found is widened by this, so often.
WIDER, TRIES = 1.4, 6
# A path that strays farther than this (in radii) is compared with that of a wider window.
FAR: Final = 1.0
# An end of a window this near (in radii) to a joint or to an end of the curve is put there: no short cubics.
SNAP: Final = 0.3
# One cubic for so much of an arc: its bends are within 0.2 % of the arc's.
ARC_RAD: Final = math.radians(50)
# Step (in radii) between points where distances are measured and crossings are looked for.
FINE: Final = 0.05


@dataclass(frozen=True, eq=False)
class Bounded:
    """The gentle curve; how far it and the old one lie apart at most; which lengths of the old one it replaces."""

    curve: BezierChain
    deviation: float
    spans: tuple[tuple[float, float], ...]


def bounded(
    curve: BezierChain, radius: float, start: Held = "pinned", end: Held = "pinned", closed: bool = False
) -> Bounded | None:
    """The curve with each tight place replaced by the nearest path of that least radius; None if there is none.

    An end that is pinned keeps its place and direction, one that is placed its place; a free one may move. A
    closed curve goes on smoothly over its start, which `start` holds (its direction only where there is no
    corner); `end` then means nothing. A curve that is gentle already is returned itself. ValueError for a closed
    curve with a gap.
    """
    if closed and not np.array_equal(curve.start, curve.end):
        raise ValueError("a closed curve ends where it starts")
    work = _Work(curve, radius, start, end, closed)
    tight = work.tight()
    if not tight:
        return Bounded(curve, 0.0, ())
    wide = np.ones(len(tight))
    paths: dict[tuple[float, float], _New | None] = {}
    best: Bounded | None = None
    for _ in range(TRIES):
        windows = work.windows(tight, wide)
        for window in windows:
            if window.ends not in paths:
                paths[window.ends] = work.replaced(window)
        new = {window: path for window in windows if (path := paths[window.ends]) is not None}
        unhappy = [window for window in windows if window not in new]
        if not unhappy:
            result = work.assembled(new)
            if _crossings(result.curve, radius) <= _crossings(curve, radius):
                if best is not None or result.deviation <= FAR * radius:
                    return result if best is None or result.deviation < best.deviation else best
                best = result
                unhappy = [window for window in windows if new[window].deviation > FAR * radius]
            else:
                unhappy = windows
        if all(window.length >= work.length for window in unhappy):
            break
        for window in unhappy:
            wide[list(window.spans)] *= WIDER
    return best


@dataclass(frozen=True)
class _Tight:
    """Lengths between which a curve is too tight, and by how much it turns there."""

    start: float
    end: float
    turn: float


@dataclass(frozen=True)
class _Window:
    """Lengths between which a curve is replaced; the end lies beyond the curve's where it goes over a seam."""

    start: float
    end: float
    spans: tuple[int, ...]

    @property
    def ends(self) -> tuple[float, float]:
        return self.start, self.end

    @property
    def length(self) -> float:
        return self.end - self.start


@dataclass(frozen=True, eq=False)
class _New:
    """What takes the place of a window, and how far the two lie apart at most."""

    curve: BezierChain
    deviation: float


@dataclass(frozen=True, eq=False)
class _Work:
    curve: BezierChain
    radius: float
    start: Held
    end: Held
    closed: bool

    @cached_property
    def reach(self) -> FloatArray:
        """Lengths at joints and ends, (n + 1,)."""
        return np.concatenate([[0.0], np.cumsum(self.curve.lengths)])

    @property
    def length(self) -> float:
        return float(self.reach[-1])

    @cached_property
    def _seam_rad(self) -> float:
        """Bend from the curve's end to its start."""
        return float(_bends(self._headings(np.array([0.0, 1.0])))[-1])

    def tight(self) -> list[_Tight]:
        """Where the curve is too tight; places nearer to each other than SNAP radii count as one."""
        points = self.curve.points
        t = np.linspace(0, 1, PLACES)
        xy = evaluate(points, t)
        steps = norms(np.diff(xy, axis=1))
        share = np.cumsum(steps, axis=1) / np.maximum(steps.sum(axis=1, keepdims=True), 1e-300)
        at = self.reach[:-1, None] + self.curve.lengths[:, None] * np.concatenate(
            [np.zeros((len(points), 1)), share], 1
        )
        headings = self._headings(t)
        turns = np.abs(_wrapped(np.diff(headings, axis=1)))
        slack = TIGHT / self.radius
        # A cubic's end without a handle has no curvature of its own: what it turns by tells.
        between = turns > np.maximum(slack * 1.02 * np.diff(at, axis=1), 1e-9)
        bends = np.abs(_curvatures(points, t)) > slack
        places: list[tuple[float, float, float]] = []
        for i, j in zip(*np.nonzero(between), strict=True):
            places.append((at[i, j], at[i, j + 1], turns[i, j]))
        for i, j in zip(*np.nonzero(bends), strict=True):
            places.append((at[i, j], at[i, j], 0.0))
        corners = _bends(headings)
        for i in np.flatnonzero(corners > CORNER_RAD):
            if i < len(points) - 1 or self.closed:
                places.append((self.reach[i + 1], self.reach[i + 1], corners[i]))
        return _grouped(sorted(places), SNAP * self.radius)

    def windows(self, tight: list[_Tight], wide: FloatArray) -> list[_Window]:
        """Tight places with room to both sides, those that meet as one."""
        found: list[_Window] = []
        for number, (span, factor) in enumerate(zip(tight, wide, strict=True)):
            margin = self.radius * factor * (MARGIN + MARGIN_PER_RAD * min(span.turn, math.pi))
            window = _Window(
                self._snapped(span.start - margin, -1), self._snapped(span.end + margin, 1), (number,)
            )
            found.append(window)
        found = _merged(sorted(found, key=lambda window: window.start))
        if self.closed:
            first, last = found[0], found[-1]
            over = last.end - self.length
            if len(found) > 1 and over >= first.start:
                found = _merged(
                    [
                        *found[1:-1],
                        _Window(last.start, max(last.end, first.end + self.length), first.spans + last.spans),
                    ]
                )
            found = [self._round(window) for window in found]
            over = max(window.end for window in found) > self.length
            if over and self.start != "free":
                # The start is held: a path through it has to go all round.
                every = tuple(number for window in found for number in window.spans)
                return [_Window(0.0, self.length, every)]
        return sorted(found, key=lambda window: window.start)

    def _round(self, window: _Window) -> _Window:
        """The window of a closed curve, started on it, and all of it if hardly anything is left."""
        if window.length >= self.length - SNAP * self.radius:
            return _Window(0.0, self.length, window.spans)
        laps = math.floor(window.start / self.length) * self.length
        return _Window(window.start - laps, window.end - laps, window.spans)

    def _snapped(self, at: float, side: int) -> float:
        """An end of a window, moved outward to a joint just beyond it; on an open curve, never beyond its ends."""
        near = SNAP * self.radius
        if not self.closed:
            if at < 2 * near:
                return 0.0
            if at > self.length - 2 * near:
                return self.length
        beyond = self.reach[(side * (self.reach - at) >= 0) & (side * (self.reach - at) <= near)]
        return float(beyond[0 if side > 0 else -1]) if len(beyond) else at

    def replaced(self, window: _Window) -> _New | None:
        """The nearest path with the window's ends; None if there is none."""
        old = self._part(window.start, window.end)
        ring = self.closed and window.length >= self.length
        start = self.start if ring or (window.start <= 0 and not self.closed) else "pinned"
        if ring and self._seam_rad > CORNER_RAD and start == "pinned":
            start = "placed"
        end = self.end if window.end >= self.length and not self.closed else "pinned"
        course = _course(old, self.radius, start, "free" if ring else end, ring)
        path = steered(course)
        if path is None:
            return None
        cubics = _cubics(path) * self.radius + old.start
        if start != "free":
            cubics[0, 0] = old.start
        if ring:
            cubics[-1, 3] = cubics[0, 0]
        elif end != "free":
            cubics[-1, 3] = old.end
        if start == "pinned":
            cubics[0, 1] = cubics[0, 0] + old.start_tangent * norms(cubics[0, 1] - cubics[0, 0])
        if end == "pinned" and not ring:
            cubics[-1, 2] = cubics[-1, 3] - old.end_tangent * norms(cubics[-1, 3] - cubics[-1, 2])
        new = BezierChain(cubics)
        gentle = np.abs(_curvatures(cubics, np.linspace(0, 1, PLACES))).max() * self.radius <= TIGHT
        if not gentle or _crossings(new, self.radius) > _crossings(old, self.radius):
            return None
        return _New(new, _apart(new, old, FINE * self.radius))

    def assembled(self, new: dict[_Window, _New]) -> Bounded:
        """What is gentle as it was, with the new paths between."""
        parts: list[BezierChain] = []
        at, stop, last = 0.0, self.length, None
        for window, path in new.items():
            if window.end > self.length and window.length < self.length:
                last, first = _divided(path.curve, self.curve.start)
                at, stop = window.end - self.length, window.start
                parts.append(first)
        for window, path in new.items():
            if window.start >= stop:
                continue
            if window.start > at:
                parts.append(piece(self.curve, at, window.start))
            parts.append(path.curve)
            at = window.end
        if stop > at:
            parts.append(piece(self.curve, at, stop))
        if last is not None:
            parts.append(last)
        deviation = max(path.deviation for path in new.values())
        spans = tuple((float(window.start), float(window.end)) for window in new)
        return Bounded(_chained(parts), deviation, spans)

    def _part(self, start: float, end: float) -> BezierChain:
        if end <= self.length:
            return piece(self.curve, start, end)
        return joined((piece(self.curve, start, self.length), piece(self.curve, 0.0, end - self.length)))

    def _headings(self, t: FloatArray) -> FloatArray:
        """Directions of travel at parameters of each cubic, (n, m)."""
        points = self.curve.points
        along = derivative(points, t)
        for row, control in ((0, points), (-1, -points[:, ::-1])):
            apart = control[:, 1:] - control[:, :1]
            far = norms(apart)
            first = np.argmax(far > 1e-9 * np.maximum(1.0, far.max(axis=1, keepdims=True)), axis=1)
            along[:, row] = apart[np.arange(len(points)), first]
        return np.asarray(np.arctan2(along[..., 1], along[..., 0]))


def _grouped(places: list[tuple[float, float, float]], near: float) -> list[_Tight]:
    """Places (start, end, turn) in order, neighbours nearer than `near` as one."""
    groups: list[_Tight] = []
    for start, end, turn in places:
        if groups and start - groups[-1].end <= near:
            last = groups[-1]
            groups[-1] = _Tight(last.start, max(last.end, end), last.turn + turn)
        else:
            groups.append(_Tight(start, end, turn))
    return groups


def _merged(windows: list[_Window]) -> list[_Window]:
    """Windows in order of their starts, those that meet as one."""
    merged: list[_Window] = []
    for window in windows:
        if merged and window.start <= merged[-1].end:
            last = merged[-1]
            merged[-1] = _Window(last.start, max(last.end, window.end), last.spans + window.spans)
        else:
            merged.append(window)
    return merged


def _course(old: BezierChain, radius: float, start: Held, end: Held, closed: bool) -> Course:
    """A curve as points at even lengths, seen from its start in radii, with its direction at each."""
    xy = evaluate(old.points, np.linspace(0, 1, PLACES)).reshape(-1, 2)
    dense = ((xy - old.start) / radius) @ np.array([1, 1j])
    chords = np.diff(dense)
    chords = chords[np.abs(chords) > 1e-9]
    ways = np.concatenate([[complex(*old.start_tangent)], chords, [complex(*old.end_tangent)]])
    turned = np.angle(ways[0]) + np.concatenate([[0.0], np.cumsum(np.angle(ways[1:] / ways[:-1]))])
    reach = np.concatenate([[0.0], np.cumsum(np.abs(chords))])
    length = float(reach[-1])
    middles = np.concatenate([[0.0], (reach[1:] + reach[:-1]) / 2, [length]])
    if closed:  # with half of the corner over the seam at either end
        seam = np.angle(ways[0] / ways[-1]) / 2
        turned[0], turned[-1] = turned[0] - seam, turned[-1] + seam
    even = np.linspace(0.0, length, 4 * max(2, math.ceil(length / STEP / 2)) + 1)
    points = np.concatenate([[0], np.cumsum(chords)])
    placed: ComplexArray = np.interp(even, reach, points.real) + 1j * np.interp(even, reach, points.imag)
    placed[-1] = complex(*((old.end - old.start) / radius))
    return Course(placed, np.interp(even, middles, turned), length, start, end, closed)


def _cubics(path: Path) -> FloatArray:
    """A path as cubics (n, 4, 2): one for each arc, arcs in a row at one full lock shared out evenly."""
    n = len(path.bends)
    cuts: list[float] = [0.0]
    first = 0
    while first < n:
        last = first
        locked = abs(path.bends[first]) > MOST_BEND - NEARLY
        while locked and last + 1 < n and abs(path.bends[last + 1] - path.bends[first]) < NEARLY:
            last += 1
        run = last + 1 - first
        count = max(1, math.ceil(run * path.step * abs(path.bends[first]) / ARC_RAD - 1e-9))
        cuts += [first + run * (k + 1) / count for k in range(count)]
        first = last + 1
    places = np.array(cuts)
    points, headings = path.on(places)
    middle = path.bends[path.arc((places[1:] + places[:-1]) / 2)]
    turn = middle * np.diff(places) * path.step
    handle = (
        np.diff(places)
        * path.step
        / 3
        * np.where(np.abs(turn) > 1e-6, 4 * np.tan(turn / 4) / np.where(turn == 0, 1, turn), 1.0)
    )
    way = np.exp(1j * headings)
    control = np.stack(
        [points[:-1], points[:-1] + handle * way[:-1], points[1:] - handle * way[1:], points[1:]], axis=1
    )
    return np.stack([control.real, control.imag], axis=-1)


def _curvatures(points: FloatArray, t: FloatArray) -> FloatArray:
    """Curvatures (n, m) of cubics at parameters, 0 where they stand still."""
    d, dd = derivative(points, t), second_derivative(points, t)
    speed = norms(d)
    cross = d[..., 0] * dd[..., 1] - d[..., 1] * dd[..., 0]
    return np.divide(cross, speed**3, out=np.zeros_like(cross), where=speed > 1e-9)


def _wrapped(angles: FloatArray) -> FloatArray:
    """Angles between half a turn to the right and half a turn to the left."""
    return np.asarray((angles + math.pi) % math.tau - math.pi)


def _bends(headings: FloatArray) -> FloatArray:
    """By how much (n,) each cubic's last direction differs from the first of the next, or of the first one."""
    return np.abs(_wrapped(np.roll(headings[:, 0], -1) - headings[:, -1]))


def _divided(path: BezierChain, near: FloatArray) -> tuple[BezierChain, BezierChain]:
    """A chain before and after its place nearest to a point."""
    from shapely import LineString, Point

    line = LineString(path.sampled(path.length / 2000))
    share = line.project(Point(near), normalized=True)
    at = float(np.clip(share, 0.01, 0.99)) * path.length
    return piece(path, 0.0, at), piece(path, at, path.length)


def _chained(parts: list[BezierChain]) -> BezierChain:
    """One chain of parts whose ends are the same but for rounding."""
    points = np.concatenate([part.points for part in parts])
    points[1:, 0] = points[:-1, 3]
    return BezierChain(points)


def _apart(one: BezierChain, other: BezierChain, step: float) -> float:
    """How far apart two curves lie at most, looked at from both."""
    import shapely

    points, others = one.sampled(step), other.sampled(step)
    there = shapely.distance(shapely.points(points), shapely.LineString(others))
    back = shapely.distance(shapely.points(others), shapely.LineString(points))
    return float(max(there.max(), back.max()))


def _crossings(curve: BezierChain, radius: float) -> int:
    """In how many parts a curve is cut where it crosses or touches itself; 0 if it does not."""
    from shapely import LineString, node

    points = curve.sampled(FINE * radius)
    line = LineString(points)
    if line.is_simple:
        return 0
    return len(node(line).geoms)
