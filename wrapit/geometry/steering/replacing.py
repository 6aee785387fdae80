"""A part of a curve replaced by the path nearest to it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Final

import numpy as np

from wrapit.geometry.arrays import FloatArray, norms
from wrapit.geometry.bezier import BezierChain, evaluate
from wrapit.geometry.steering.locks import NEARLY
from wrapit.geometry.steering.paths import ComplexArray, Course, Held, Path
from wrapit.geometry.steering.steer import MOST_BEND, STEP, steered
from wrapit.geometry.steering.tight import CORNER_RAD, PLACES, TIGHT, curvatures, seam_rad

# One cubic for so much of an arc: its bends are within 0.2 % of the arc's.
ARC_RAD: Final = math.radians(50)
# Step (in radii) between points where distances are measured and crossings are looked for.
FINE: Final = 0.05


@dataclass(frozen=True, eq=False)
class New:
    """What takes the place of a window, and how far the two lie apart at most."""

    curve: BezierChain
    deviation: float


def replaced(old: BezierChain, radius: float, start: Held, end: Held, ring: bool) -> New | None:
    """The nearest path with ends as held, closed smoothly if it is a ring; None if none is found.

    Nor may it cross itself where the old curve does not.
    """
    if ring and start == "pinned" and seam_rad(old) > CORNER_RAD:
        start = "placed"  # there are two directions to keep
    course = course_of(old, radius, start, "free" if ring else end, ring)
    path = steered(course)
    if path is None:
        return None
    cubics = cubics_of(path) * radius + old.start
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
    gentle = np.abs(curvatures(cubics, np.linspace(0, 1, PLACES))).max() * radius <= TIGHT
    if not gentle or crossings(new, radius) > crossings(old, radius):
        return None
    return New(new, apart(new, old, FINE * radius))


def course_of(old: BezierChain, radius: float, start: Held, end: Held, closed: bool) -> Course:
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


def cubics_of(path: Path) -> FloatArray:
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


def apart(one: BezierChain, other: BezierChain, step: float) -> float:
    """How far apart two curves lie at most, looked at from both."""
    import shapely

    points, others = one.sampled(step), other.sampled(step)
    there = shapely.distance(shapely.points(points), shapely.LineString(others))
    back = shapely.distance(shapely.points(others), shapely.LineString(points))
    return float(max(there.max(), back.max()))


def crossings(curve: BezierChain, radius: float) -> int:
    """In how many parts a curve is cut where it crosses or touches itself; 0 if it does not."""
    from shapely import LineString, node

    points = curve.sampled(FINE * radius)
    line = LineString(points)
    if line.is_simple:
        return 0
    return len(node(line).geoms)
