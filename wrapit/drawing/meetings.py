"""Where exact curves meet: crossings, and ends that touch another curve."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from wrapit.geometry import FloatArray
from wrapit.geometry.bezier import evaluate

_SAMPLES = 24


@dataclass(frozen=True, eq=False)
class Contact:
    """A place where curves meet, and for each the curve's number and its parameter there.

    The whole part of a parameter counts the cubics before it.
    """

    point: FloatArray
    on: tuple[tuple[int, float], ...]


@dataclass(frozen=True, eq=False)
class _Steps:
    """All curves as short straight steps (m, 2, 2), with curve, parameters, and place in the curve."""

    ends: FloatArray
    curve: FloatArray
    start: FloatArray
    end: FloatArray


def crossings(curves: list[FloatArray], closed: list[bool]) -> list[Contact]:
    """All crossings of curves with each other and with themselves, exact to rounding."""
    from shapely import STRtree, linestrings

    steps = _steps(curves)
    lines = linestrings(steps.ends)
    first, second = STRtree(lines).query(lines)
    apart = first < second
    first, second = first[apart], second[apart]
    found: list[Contact] = []
    size = float(np.ptp(steps.ends.reshape(-1, 2), axis=0).max())
    for i, j in zip(first.tolist(), second.tolist(), strict=True):
        a, b = int(steps.curve[i]), int(steps.curve[j])
        if a == b and _adjacent(steps, i, j, len(curves[a]), closed[a]):
            continue
        hit = _crossing(curves, steps, i, j, size)
        if hit is None or (a == b and abs(hit[0] - hit[1]) < 1e-3):
            continue
        contact = Contact(_point(curves[a], hit[0]), ((a, hit[0]), (b, hit[1])))
        if not any(_same(contact, other) for other in found):
            found.append(contact)
    return found


def touches(curves: list[FloatArray], closed: list[bool], reach: float) -> list[Contact]:
    """Ends of open curves that come closer than `reach` to a curve (their own far part included)."""
    steps = _steps(curves)
    found = []
    for curve, (cubics, loop) in enumerate(zip(curves, closed, strict=True)):
        if loop:
            continue
        for at in (0.0, float(len(cubics))):
            end = _point(cubics, at)
            contact = _touch(curves, steps, curve, at, end, reach)
            if contact is not None:
                found.append(contact)
    return found


def _touch(
    curves: list[FloatArray], steps: _Steps, curve: int, at: float, end: FloatArray, reach: float
) -> Contact | None:
    a, d = steps.ends[:, 0], steps.ends[:, 1] - steps.ends[:, 0]
    share = np.clip(((end - a) * d).sum(axis=1) / np.maximum((d * d).sum(axis=1), 1e-18), 0, 1)
    distance = np.linalg.norm(a + share[:, None] * d - end, axis=1)
    own = steps.curve == curve
    if own.any():
        # Its own near part is no contact: what lies within a walk of three reaches.
        lengths = np.linalg.norm(d[own], axis=1)
        walk = lengths.cumsum()
        walk = walk - lengths if at == 0 else walk[-1] - walk
        distance[np.flatnonzero(own)[walk < 3 * reach]] = np.inf
    nearest = int(np.argmin(distance))
    if distance[nearest] > reach:
        return None
    other = int(steps.curve[nearest])
    t = float(steps.start[nearest] + share[nearest] * (steps.end[nearest] - steps.start[nearest]))
    t = _straight_on(curves[other], _foot(curves[other], t, end), curves[curve], at, reach)
    for tip in (0.0, float(len(curves[other]))):
        if np.linalg.norm(_point(curves[other], tip) - end) <= min(
            reach, 1.5 * distance[nearest] + 1e-9 * reach
        ):
            t = tip
    return Contact(_point(curves[other], t), ((other, t), (curve, at)))


def _steps(curves: list[FloatArray]) -> _Steps:
    t = np.linspace(0, 1, _SAMPLES + 1)
    ends, owner, start = [], [], []
    for index, cubics in enumerate(curves):
        points = evaluate(cubics, t)
        ends.append(np.stack([points[:, :-1], points[:, 1:]], axis=2).reshape(-1, 2, 2))
        owner.append(np.full(len(ends[-1]), index))
        start.append((np.arange(len(cubics))[:, None] + t[None, :-1]).ravel())
    first = np.concatenate(start)
    return _Steps(np.concatenate(ends), np.concatenate(owner), first, first + 1 / _SAMPLES)


def _adjacent(steps: _Steps, i: int, j: int, count: int, loop: bool) -> bool:
    gap = abs(steps.start[j] - steps.start[i])
    if loop:
        gap = min(gap, count - gap)
    return bool(gap < 1.5 / _SAMPLES)


def _crossing(
    curves: list[FloatArray], steps: _Steps, i: int, j: int, size: float
) -> tuple[float, float] | None:
    """Parameters of a true crossing near two steps, by Newton's method on the cubics."""
    p, q = steps.ends[i], steps.ends[j]
    d, e, gap = p[1] - p[0], q[1] - q[0], q[0] - p[0]
    det = d[0] * e[1] - d[1] * e[0]
    if abs(det) < 1e-9 * np.linalg.norm(d) * np.linalg.norm(e):
        return None
    s, t = (gap[0] * e[1] - gap[1] * e[0]) / det, (gap[0] * d[1] - gap[1] * d[0]) / det
    if not (-0.2 <= s <= 1.2 and -0.2 <= t <= 1.2):
        return None
    a, b = curves[int(steps.curve[i])], curves[int(steps.curve[j])]
    k, m = int(steps.start[i] + 1e-9), int(steps.start[j] + 1e-9)
    u = float(np.clip(steps.start[i] - k + s / _SAMPLES, 0, 1))
    v = float(np.clip(steps.start[j] - m + t / _SAMPLES, 0, 1))
    for _ in range(8):
        x, dx = _local(a[k], u)
        y, dy = _local(b[m], v)
        matrix = np.column_stack([dx, -dy])
        if abs(np.linalg.det(matrix)) < 1e-12 * max(float(np.linalg.norm(dx) * np.linalg.norm(dy)), 1e-300):
            return None
        step = np.linalg.solve(matrix, y - x)
        u, v = float(np.clip(u + step[0], 0, 1)), float(np.clip(v + step[1], 0, 1))
    if np.linalg.norm(_local(a[k], u)[0] - _local(b[m], v)[0]) > 1e-9 * size:
        return None
    return k + u, m + v


def _foot(cubics: FloatArray, at: float, point: FloatArray) -> float:
    """Parameter nearest to a point, starting near it."""
    for _ in range(6):
        k = min(int(at), len(cubics) - 1)
        on, d = _local(cubics[k], at - k)
        at = float(np.clip(at + (point - on) @ d / max(float(d @ d), 1e-18), 0, len(cubics)))
    return at


def _straight_on(other: FloatArray, foot: float, own: FloatArray, at: float, reach: float) -> float:
    """Parameter where a curve, carried on (or cut back) straight at one end, meets another near its foot."""
    k = min(int(at), len(own) - 1)
    end, slope = _local(own[k], at - k)
    length = float(np.linalg.norm(slope))
    if length < 1e-12:
        return foot
    s, t = 0.0, foot
    for _ in range(8):
        m = min(int(t), len(other) - 1)
        on, d = _local(other[m], t - m)
        matrix = np.column_stack([slope / length, -d])
        if abs(np.linalg.det(matrix)) < 0.2 * np.linalg.norm(d):
            return foot
        step = np.linalg.solve(matrix, on - end - s * slope / length)
        s, t = s + float(step[0]), float(np.clip(t + step[1], 0, len(other)))
    m = min(int(t), len(other) - 1)
    missed = np.linalg.norm(_local(other[m], t - m)[0] - end - s * slope / length)
    return t if abs(s) <= 1.5 * reach and missed < 1e-6 * reach else foot


def _point(cubics: FloatArray, at: float) -> FloatArray:
    k = min(int(at), len(cubics) - 1)
    return _local(cubics[k], at - k)[0]


def _local(cubic: FloatArray, t: float) -> tuple[FloatArray, FloatArray]:
    a, b, c, d = cubic
    s = 1 - t
    return (
        s**3 * a + 3 * s * s * t * b + 3 * s * t * t * c + t**3 * d,
        3 * (s * s * (b - a) + 2 * s * t * (c - b) + t * t * (d - c)),
    )


def _same(one: Contact, other: Contact) -> bool:
    return {curve for curve, _ in one.on} == {curve for curve, _ in other.on} and all(
        min(abs(at - there) for where, there in other.on if where == curve) < 1e-6 for curve, at in one.on
    )
