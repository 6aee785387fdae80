"""Drawings as rough.js and Excalidraw write them: each line as two wobbly strokes.

The formulas are those of rough.js 4.6 (renderer.js): random offsets of ends and handles, a bow in the middle,
and a second pass with half of it; ellipses through random points, the second pass from another angle.
"""

from __future__ import annotations

import itertools
import math

import numpy as np

from wrapit.geometry import FloatArray

# Its own settings.
OFFSET, FITTING, STEPS = 2.0, 0.95, 9


class Sketch:
    """Path data of shapes drawn by a hand of some roughness."""

    def __init__(self, seed: int, roughness: float, exact_ends: bool = False) -> None:
        self._rng, self._roughness, self._exact = np.random.default_rng(seed), roughness, exact_ends

    def _off(self, most: float) -> float:
        return self._roughness * most * float(self._rng.uniform(-1, 1))

    def line(self, a: tuple[float, float], b: tuple[float, float]) -> str:
        """One line, drawn twice."""
        return self._stroke(a, b, 1.0) + self._stroke(a, b, 0.5)

    def polyline(self, points: list[tuple[float, float]]) -> str:
        """Lines from point to point."""
        return "".join(self.line(a, b) for a, b in itertools.pairwise(points))

    def _stroke(self, a: tuple[float, float], b: tuple[float, float], part: float) -> str:
        length = math.dist(a, b)
        gain = 1.0 if length < 200 else max(0.4, 1.233334 - 0.0016668 * length)
        offset = gain * part * (OFFSET if length >= OFFSET * 10 else length / 10)
        share = self._rng.uniform(0.2, 0.4)
        bow = np.array(
            [self._off(gain * OFFSET * (b[1] - a[1]) / 200), self._off(gain * OFFSET * (a[0] - b[0]) / 200)]
        )
        start, end = np.array(a), np.array(b)

        def near(point: FloatArray, most: float) -> str:
            return f"{point[0] + self._off(most):.4f} {point[1] + self._off(most):.4f}"

        ends = 0.0 if self._exact else offset
        handles = [near(bow + start + (end - start) * k * share, offset) for k in (1, 2)]
        return f"M{near(start, ends)} C{', '.join(handles)}, {near(end, ends)} "

    def ellipse(self, x: float, y: float, rx: float, ry: float) -> str:
        """One ellipse, drawn twice."""
        way = math.sqrt(math.tau * math.sqrt((rx * rx + ry * ry) / 2))
        step = math.tau / math.ceil(max(STEPS, STEPS / math.sqrt(200) * way))
        rx, ry = rx + self._off(rx * (1 - FITTING)), ry + self._off(ry * (1 - FITTING))
        over = step * float(self._rng.uniform(0.1, 1.0)) * self._roughness
        return self._round(x, y, rx, ry, step, 1.0, over) + self._round(x, y, rx, ry, step, 1.5, 0.0)

    def _round(self, x: float, y: float, rx: float, ry: float, step: float, off: float, over: float) -> str:
        begin = self._off(0.5) - math.pi / 2
        turns = [(begin - step, 0.9)]
        turns += [(begin + k * step, 1.0) for k in range(math.ceil((math.tau - 0.01) / step))]
        turns += [(begin + math.tau + over / 2, 1.0), (begin + over, 0.98), (begin + over / 2, 0.9)]
        p = [
            np.array([self._off(off) + x + k * rx * math.cos(a), self._off(off) + y + k * ry * math.sin(a)])
            for a, k in turns
        ]
        text = f"M{p[1][0]:.4f} {p[1][1]:.4f} "
        for k in range(1, len(p) - 2):
            first, second = p[k] + (p[k + 1] - p[k - 1]) / 6, p[k + 1] + (p[k] - p[k + 2]) / 6
            text += f"C{first[0]:.4f} {first[1]:.4f}, {second[0]:.4f} {second[1]:.4f}, "
            text += f"{p[k + 1][0]:.4f} {p[k + 1][1]:.4f} "
        return text
