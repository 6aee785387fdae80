"""Cubics that turn back on themselves: where they do, and cut there."""

from __future__ import annotations

import numpy as np

from wrapit.geometry.arrays import FloatArray
from wrapit.geometry.bezier import BezierChain, evaluate, split

# How much of a turn within next to nothing makes a corner? As much as a corner of a drawing is by default.
SHARP_RAD = np.pi / 3
# Shares of what lies before and behind a place where a cubic is looked at: densely next to it, for at a cusp
# it turns half round within a share of 1e-4, and around the place itself, for that is known to 1e-8 only.
_SHARES = np.concatenate([[0.0], np.geomspace(1e-7, 1.0, 64)])


def without_cusps(points: FloatArray, near: float) -> FloatArray:
    """Cubics (n, 4, 2) that follow one another, cut where one turns sharply within the length `near`.

    What lies within half of `near` of such a place becomes a corner at its tip; nothing else moves by more
    than that. Chains without such a place come back as they are.
    """
    doubtful = _turns_much(points)
    if not doubtful.any():
        return points
    parts = [
        _cut(cubic, near) if looked_at else cubic[None]
        for cubic, looked_at in zip(points, doubtful, strict=True)
    ]
    return np.concatenate(parts)


def sharp_places(cubic: FloatArray, near: float) -> list[tuple[float, float, float]]:
    """Where a cubic (4, 2) turns by more than `SHARP_RAD` within `near`: parameters before, of it, behind.

    A cubic is slow where it turns tightly, so that only the least speeds are looked at.
    """
    found: list[tuple[float, float, float]] = []
    if not _turns_much(cubic[None])[0]:
        return found
    for at in _slowest(cubic):
        before, behind = at * (1 - _SHARES[::-1]), at + (1 - at) * _SHARES[1:]
        t = np.concatenate([before, behind])
        steps = np.diff(evaluate(cubic[None], t)[0], axis=0)
        lengths = np.linalg.norm(steps, axis=1)
        ahead = np.concatenate([[0.0], np.cumsum(lengths)])
        ahead -= ahead[len(before) - 1]
        within = np.abs(ahead) <= near / 2
        low, high = float(t[within][0]), float(t[within][-1])
        inside = (np.abs(ahead[:-1]) <= near / 2) & (np.abs(ahead[1:]) <= near / 2) & (lengths > 0)
        # The steps that leave the stretch tell the directions in which it is left.
        inside |= np.roll(inside, 1) | np.roll(inside, -1)
        moves = steps[inside & (lengths > 0)]
        if _turned(moves) <= SHARP_RAD:
            continue
        if found and low <= found[-1][2]:
            found[-1] = (found[-1][0], found[-1][1], high)
        else:
            found.append((low, at, high))
    return found


def _turned(steps: FloatArray) -> float:
    """By how much a polyline's steps (m, 2) turn in all, to either side."""
    cross = steps[:-1, 0] * steps[1:, 1] - steps[:-1, 1] * steps[1:, 0]
    return float(np.abs(np.arctan2(cross, (steps[:-1] * steps[1:]).sum(axis=1))).sum())


def _turns_much(points: FloatArray) -> FloatArray:
    """Which cubics may turn by more than `SHARP_RAD`: where the legs of the control polygon do."""
    legs = np.diff(points, axis=1)
    size = np.linalg.norm(legs, axis=2)
    doubtful = np.zeros(len(points), dtype=bool)
    for one, other in ((0, 1), (1, 2), (0, 2)):
        product = (legs[:, one] * legs[:, other]).sum(axis=1)
        doubtful |= product < np.cos(SHARP_RAD) * size[:, one] * size[:, other]
    return doubtful


def _slowest(cubic: FloatArray) -> list[float]:
    """Parameters inside a cubic where its speed is least: roots of (|B'|²)', in order."""
    d = np.diff(cubic, axis=0)
    # B' / 3 = a + b t + c t²
    a, b, c = d[0], 2 * (d[1] - d[0]), d[0] - 2 * d[1] + d[2]
    slope = np.array([2 * c @ c, 3 * b @ c, b @ b + 2 * a @ c, a @ b])
    scale = float(np.abs(slope).max())
    if not scale > 0:
        return []
    # Double roots, as of a cusp that is all but one, part into two that are complex by rounding.
    roots = np.roots(np.where(np.abs(slope) > 1e-14 * scale, slope, 0.0))
    real = np.sort(roots.real[(np.abs(roots.imag) < 1e-5) & (roots.real > 0) & (roots.real < 1)])
    return [float(t) for t in real]


def _cut(cubic: FloatArray, near: float) -> FloatArray:
    """A cubic's parts (m, 4, 2) before, between and behind its sharp places; ends on the tips."""
    places = sharp_places(cubic, near)
    if not places:
        return cubic[None]
    tips = evaluate(cubic[None], np.array([at for _, at, _ in places]))[0]
    starts = [0.0, *(behind for _, _, behind in places)]
    ends = [*(before for before, _, _ in places), 1.0]
    parts: list[FloatArray] = []
    corners = [*tips, cubic[3]]
    for low, high, end in zip(starts, ends, corners, strict=True):
        part = _between(cubic, low, high) if high > low else None
        # A tip next to an end is that end.
        if part is None or BezierChain(part[None]).length < near:
            continue
        parts.append(_moved(part, parts[-1][3] if parts else cubic[0], end))
    if not parts:
        return cubic[None]
    parts[-1] = _moved(parts[-1], parts[-1][0], cubic[3])
    return np.stack(parts)


def _between(cubic: FloatArray, low: float, high: float) -> FloatArray:
    part = split(cubic[None], high)[0]
    return split(part, low / high)[1][0]


def _moved(cubic: FloatArray, start: FloatArray, end: FloatArray) -> FloatArray:
    """A cubic with its ends on two places, each handle along with its end."""
    return np.stack([start, cubic[1] + start - cubic[0], cubic[2] + end - cubic[3], end])
