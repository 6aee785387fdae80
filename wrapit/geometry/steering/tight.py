"""Where a curve bends more tightly than a radius."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from wrapit.geometry.arrays import FloatArray, norms
from wrapit.geometry.bezier import BezierChain, derivative, evaluate, second_derivative

# A bend is tight from here, in shares of the bound: more than cubics make of arcs at a path's lock.
TIGHT: Final = 1.003
# A bend at a joint by more than this (rad) is a corner.
CORNER_RAD: Final = 1e-6
# Each cubic is looked at in so many places.
PLACES: Final = 33
# Tight places this near (in radii) to each other are one: their windows would meet anyway.
TOGETHER: Final = 0.3


@dataclass(frozen=True)
class Tight:
    """Lengths between which a curve is too tight, and by how much it turns there."""

    start: float
    end: float
    turn: float


def tight_places(curve: BezierChain, radius: float, closed: bool) -> list[Tight]:
    """Where a curve is too tight, in order; places nearer to each other than TOGETHER radii count as one."""
    return tight_places_of([curve], radius, closed)[0]


def tight_places_of(curves: Sequence[BezierChain], radius: float, closed: bool) -> list[list[Tight]]:
    """The same for each of many curves, looked at together: most of the work is the same for few cubics."""
    if not curves:
        return []
    counts = np.array([len(curve) for curve in curves])
    points = np.concatenate([curve.points for curve in curves])
    lengths = np.concatenate([curve.lengths for curve in curves])
    owner = np.repeat(np.arange(len(curves)), counts)
    lasts = np.cumsum(counts) - 1
    firsts = lasts - counts + 1
    ends = np.concatenate([np.cumsum(curve.lengths) for curve in curves])
    starts = np.concatenate([[0.0], ends[:-1]])
    starts[firsts] = 0.0
    t = np.linspace(0, 1, PLACES)
    xy = evaluate(points, t)
    steps = norms(np.diff(xy, axis=1))
    share = np.cumsum(steps, axis=1) / np.maximum(steps.sum(axis=1, keepdims=True), 1e-300)
    at = starts[:, None] + lengths[:, None] * np.concatenate([np.zeros((len(points), 1)), share], 1)
    headings = headings_of(points, t)
    turns = np.abs(wrapped(np.diff(headings, axis=1)))
    slack = TIGHT / radius
    # A cubic's end without a handle has no curvature of its own: what it turns by tells.
    between = turns > np.maximum(slack * 1.02 * np.diff(at, axis=1), 1e-9)
    bent = np.abs(curvatures(points, t)) > slack
    places: list[list[tuple[float, float, float]]] = [[] for _ in curves]
    for i, j in zip(*np.nonzero(between), strict=True):
        places[owner[i]].append((at[i, j], at[i, j + 1], turns[i, j]))
    for i, j in zip(*np.nonzero(bent), strict=True):
        places[owner[i]].append((at[i, j], at[i, j], 0.0))
    then = np.arange(1, len(points) + 1)
    then[lasts] = firsts
    corners = np.abs(wrapped(headings[then, 0] - headings[:, -1]))
    if not closed:
        corners[lasts] = 0.0
    for i in np.flatnonzero(corners > CORNER_RAD):
        places[owner[i]].append((ends[i], ends[i], corners[i]))
    return [grouped(sorted(each), TOGETHER * radius) for each in places]


def seam_rad(curve: BezierChain) -> float:
    """Bend from a curve's end to its start."""
    return float(bends(headings_of(curve.points, np.array([0.0, 1.0])))[-1])


def headings_of(points: FloatArray, t: FloatArray) -> FloatArray:
    """Directions of travel (n, m) at parameters from 0 to 1 of cubics (n, 4, 2)."""
    along = derivative(points, t)
    for row, control in ((0, points), (-1, -points[:, ::-1])):
        apart = control[:, 1:] - control[:, :1]
        far = norms(apart)
        first = np.argmax(far > 1e-9 * np.maximum(1.0, far.max(axis=1, keepdims=True)), axis=1)
        along[:, row] = apart[np.arange(len(points)), first]
    return np.asarray(np.arctan2(along[..., 1], along[..., 0]))


def grouped(places: list[tuple[float, float, float]], near: float) -> list[Tight]:
    """Places (start, end, turn) in order, neighbours nearer than `near` as one."""
    groups: list[Tight] = []
    for start, end, turn in places:
        if groups and start - groups[-1].end <= near:
            last = groups[-1]
            groups[-1] = Tight(last.start, max(last.end, end), last.turn + turn)
        else:
            groups.append(Tight(start, end, turn))
    return groups


def curvatures(points: FloatArray, t: FloatArray) -> FloatArray:
    """Curvatures (n, m) of cubics at parameters, 0 where they stand still."""
    d, dd = derivative(points, t), second_derivative(points, t)
    speed = norms(d)
    cross = d[..., 0] * dd[..., 1] - d[..., 1] * dd[..., 0]
    return np.divide(cross, speed**3, out=np.zeros_like(cross), where=speed > 1e-9)


def wrapped(angles: FloatArray) -> FloatArray:
    """Angles between half a turn to the right and half a turn to the left."""
    return np.asarray((angles + math.pi) % math.tau - math.pi)


def bends(headings: FloatArray) -> FloatArray:
    """By how much (n,) each cubic ends in another direction than the next, or the first, starts."""
    return np.abs(wrapped(np.roll(headings[:, 0], -1) - headings[:, -1]))
