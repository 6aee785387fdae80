"""Drawings with exactly known centre lines and crossings, rendered as ink."""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from wrapit.drawing.model import Drawing

Points = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Crossing:
    """Where strokes meet, how many arms leave, and the smallest angle between their lines."""

    at: Points
    degree: int
    angle_deg: float


def render(curves: list[Points], width_px: float, shape: tuple[int, int]) -> NDArray[np.uint8]:
    """Ink with antialiased edges and round caps around polylines (n, 2), black on white."""
    height, width = shape
    nearest = np.full(shape, 1e9)
    margin = width_px / 2 + 2
    for curve in curves:
        for a, b in itertools.pairwise(curve):
            low = np.maximum(np.floor(np.minimum(a, b) - margin).astype(int), 0)
            high = np.minimum(np.ceil(np.maximum(a, b) + margin).astype(int), [width - 1, height - 1])
            if (high < low).any():
                continue
            x = np.arange(low[0], high[0] + 1)[None] - a[0]
            y = np.arange(low[1], high[1] + 1)[:, None] - a[1]
            d = b - a
            t = np.clip((x * d[0] + y * d[1]) / max(float(d @ d), 1e-12), 0, 1)
            patch = nearest[low[1] : high[1] + 1, low[0] : high[0] + 1]
            np.minimum(patch, np.hypot(x - t * d[0], y - t * d[1]), out=patch)
    return (255 * np.clip(nearest - width_px / 2 + 0.5, 0, 1) + 0.5).astype(np.uint8)


def random_curve(rng: np.random.Generator, size_px: float, harmonics: int = 4) -> Points:
    """A smooth closed curve of random harmonics that fills a square with a margin, closed exactly."""
    amplitude = rng.normal(size=(2, 2, harmonics)) / np.arange(1, harmonics + 1) ** 0.8
    curve = np.einsum("ijk,jkt->ti", amplitude, _waves(harmonics))
    curve[-1] = curve[0]
    low, high = curve.min(axis=0), curve.max(axis=0)
    return (curve - low) / (high - low).max() * 0.86 * size_px + 0.07 * size_px


@cache
def _waves(harmonics: int) -> NDArray[np.float64]:
    angles = np.outer(np.arange(1, harmonics + 1), np.linspace(0, 2 * np.pi, 801))
    return np.stack([np.cos(angles), np.sin(angles)])


def crossings(curves: list[Points]) -> list[Crossing]:
    """All proper crossings of closed or open polylines, themselves included."""
    start = np.concatenate([curve[:-1] for curve in curves])
    step = np.concatenate([np.diff(curve, axis=0) for curve in curves])
    found = []
    for i in range(len(start)):
        rest = slice(i + 1, None)
        d, e, gap = step[i], step[rest], start[rest] - start[i]
        det = d[0] * e[:, 1] - d[1] * e[:, 0]
        safe = np.where(np.abs(det) < 1e-12, np.inf, det)
        s = (gap[:, 0] * e[:, 1] - gap[:, 1] * e[:, 0]) / safe
        t = (gap[:, 0] * d[1] - gap[:, 1] * d[0]) / safe
        for j in np.flatnonzero((s > 0) & (s < 1) & (t > 0) & (t < 1)):
            angle = abs(np.arctan2(det[j], e[j] @ d))
            found.append(Crossing(start[i] + s[j] * d, 4, float(np.degrees(min(angle, np.pi - angle)))))
    return found


def smallest_radius(curve: Points) -> float:
    """Smallest radius of curvature along a closed polyline."""
    d = np.gradient(curve[:-1], axis=0)
    dd = np.gradient(d, axis=0)
    speed = np.linalg.norm(d, axis=1)
    curvature = np.abs(d[:, 0] * dd[:, 1] - d[:, 1] * dd[:, 0]) / speed**3
    return float(1 / curvature[2:-2].max())


def degrees(drawing: Drawing) -> list[int]:
    """How many segment ends meet at each junction, ascending."""
    return sorted(len(ends) for ends in drawing.half_edges())
