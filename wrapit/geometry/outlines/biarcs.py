"""Curves as circular arcs or short lines within a tolerance, for machines that know nothing else."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence

import numpy as np

from wrapit.geometry.arrays import FloatArray
from wrapit.geometry.bezier import BezierChain, evaluate, split
from wrapit.geometry.outlines.loops import Arc, Edge, Line, point_of, reversed_edge

# Where cubics are compared with arcs, and arcs with cubics.
_CHECKS = np.linspace(0, 1, 18)[1:-1]
_INNER = np.linspace(0, 1, 9)[1:-1]
# A rounder arc is a line: over 100 mm it strays from one by 0.0125 mm. 7e4 or 1.3e5 change no outline of two
# of our drawings.
_LARGEST_RADIUS_MM = 1e5


def as_arcs(edges: Sequence[Edge], tolerance_mm: float) -> tuple[Line | Arc, ...]:
    """The edges with each curve as pairs of arcs that share tangents (biarcs), within the tolerance."""
    found: list[Line | Arc] = []
    for edge in edges:
        if isinstance(edge, BezierChain):
            found += _along(edge.points, tolerance_mm)
        else:
            found.append(edge)
    return tuple(found)


def as_lines(edges: Sequence[Edge], tolerance_mm: float) -> tuple[Line, ...]:
    """The edges as short lines whose ends lie on them, within the tolerance."""
    found: list[Line] = []
    for edge in edges:
        points = (
            _flattened(edge, tolerance_mm) if isinstance(edge, BezierChain) else edge.sampled(tolerance_mm)
        )
        found += [Line(point_of(a), point_of(b)) for a, b in itertools.pairwise(points)]
    return tuple(found)


def _flattened(chain: BezierChain, tolerance_mm: float) -> FloatArray:
    # A chord strays by at most an eighth of the largest second derivative over its step.
    bend = 6 * np.linalg.norm(np.diff(chain.points, n=2, axis=1), axis=2).max(axis=1)
    counts = np.maximum(1, np.ceil(np.sqrt(bend / (8 * tolerance_mm)))).astype(int)
    parts = [chain.start[None]]
    for cubic, count in zip(chain.points, counts, strict=True):
        parts.append(evaluate(cubic[None], np.arange(1, count + 1) / count)[0])
    return np.concatenate(parts)


def _along(cubics: FloatArray, tolerance_mm: float) -> list[Line | Arc]:
    """Biarcs that reach over as many cubics as the tolerance allows, found by doubling."""
    found: list[Line | Arc] = []
    first = 0
    while first < len(cubics):
        best: tuple[int, list[Line | Arc]] | None = None
        count = 2
        while first + count <= len(cubics):
            pair = _biarc(cubics[first, 0], cubics[first + count - 1, 3], *_tangents(cubics, first, count))
            if pair is None or _error(cubics[first : first + count], pair) > tolerance_mm:
                break
            best = count, pair
            count = min(2 * count, len(cubics) - first) if first + count < len(cubics) else len(cubics) + 1
        if best is None:
            found += _arcs(cubics[first], tolerance_mm)
            first += 1
        else:
            found += best[1]
            first += best[0]
    return found


def _tangents(cubics: FloatArray, first: int, count: int) -> tuple[FloatArray, FloatArray]:
    last = first + count - 1
    return BezierChain(cubics[first][None]).start_tangent, BezierChain(cubics[last][None]).end_tangent


def _arcs(cubic: FloatArray, tolerance_mm: float, depth: int = 0) -> list[Line | Arc]:
    pair = _biarc(cubic[0], cubic[3], *_tangents(cubic[None], 0, 1))
    if pair is not None and (depth >= 12 or _error(cubic[None], pair) <= tolerance_mm):
        return pair
    if depth >= 12:
        return [Line(point_of(cubic[0]), point_of(cubic[3]))]
    left, right = split(cubic[None], 0.5)
    return _arcs(left[0], tolerance_mm, depth + 1) + _arcs(right[0], tolerance_mm, depth + 1)


def _biarc(
    start: FloatArray, end: FloatArray, leaving: FloatArray, arriving: FloatArray
) -> list[Line | Arc] | None:
    """Two arcs with these ends and end tangents, and one tangent where they meet; None if there are none."""
    v, t = end - start, leaving + arriving
    if np.hypot(*v) < 1e-9:
        return None
    a, b, c = 2 * (1 - float(leaving @ arriving)), float(v @ t), float(v @ v)
    if abs(a) < 1e-9:
        along = 4 * float(v @ arriving)
        if along <= 1e-9:
            return None
        reach = c / along
    else:
        reach = (-b + math.sqrt(b * b + a * c)) / a
    middle = (start + end + reach * (leaving - arriving)) / 2
    first = _arc_from(start, leaving, middle)
    second = _arc_from(end, -arriving, middle)
    return [first, reversed_edge(second)]


def _arc_from(start: FloatArray, tangent: FloatArray, end: FloatArray) -> Line | Arc:
    """The arc (or line) that leaves along the tangent and reaches the end."""
    normal = np.array([-tangent[1], tangent[0]])
    v = end - start
    across = 2 * float(normal @ v)
    if abs(across) * _LARGEST_RADIUS_MM < float(v @ v):
        return Line(point_of(start), point_of(end))
    radius = float(v @ v) / across
    centre = start + radius * normal
    first, last = (math.atan2(p[1] - centre[1], p[0] - centre[0]) for p in (start, end))
    sweep = (last - first) % math.tau if radius > 0 else -((first - last) % math.tau)
    return Arc(point_of(centre), abs(radius), first, sweep)


def _error(cubics: FloatArray, pair: Sequence[Line | Arc]) -> float:
    """How far the cubics stray from both arcs, or the arcs from the cubics (by their chords)."""
    points = evaluate(cubics, _CHECKS).reshape(-1, 2)
    away = np.stack([_distance(points, edge) for edge in pair]).min(axis=0)
    ends = np.concatenate([cubics[:1, 0], points, cubics[-1:, 3]])
    back = np.concatenate([_to_chords(_inside(edge), ends) for edge in pair])
    return float(max(away.max(), back.max()))


def _distance(points: FloatArray, edge: Line | Arc) -> FloatArray:
    if isinstance(edge, Line):
        return _to_chords(points, np.array([edge.start, edge.end]))
    apart = points - np.array(edge.centre)
    along = np.arctan2(apart[:, 1], apart[:, 0]) - edge.start_rad
    within = np.mod(math.copysign(1.0, edge.sweep_rad) * along, math.tau) <= abs(edge.sweep_rad)
    beside = np.abs(np.linalg.norm(apart, axis=1) - edge.radius_mm)
    tips = np.array([edge.start, edge.end])
    return np.where(within, beside, np.linalg.norm(points[:, None] - tips, axis=2).min(axis=1))


def _inside(edge: Line | Arc) -> FloatArray:
    """Points (m, 2) between the ends."""
    if isinstance(edge, Line):
        return np.array(edge.start) + _INNER[:, None] * (np.array(edge.end) - np.array(edge.start))
    angles = edge.start_rad + _INNER * edge.sweep_rad
    return np.array(edge.centre) + edge.radius_mm * np.column_stack([np.cos(angles), np.sin(angles)])


def _to_chords(points: FloatArray, corners: FloatArray) -> FloatArray:
    """Distance (m,) of points (m, 2) from a polyline (n, 2)."""
    a, along = corners[:-1], np.diff(corners, axis=0)
    apart = points[:, None] - a
    share = (apart * along).sum(axis=2) / np.maximum((along**2).sum(axis=1), 1e-18)
    feet = np.clip(share, 0, 1)[:, :, None] * along
    return np.linalg.norm(apart - feet, axis=2).min(axis=1)
