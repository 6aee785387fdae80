"""A pen that draws subpaths of cubic Béziers: lines, quadratics, cubics and arcs of ellipses."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from wrapit.geometry import FloatArray

# The largest angle that one cubic stands for. A cubic errs by (2/27) (sin(a/4))^6 / cos(a/4)^2 of the radius
# (Goldapp 1991): 3.7e-7 at 30 degrees, 4.2e-6 at 45.
_WIDEST_ARC_RAD = math.pi / 6

Point = tuple[float, float]


@dataclass(frozen=True, eq=False)
class Subpath:
    """Cubics (n, 4, 2) that follow one another from a start, in user units."""

    cubics: FloatArray
    closed: bool


@dataclass
class Pen:
    """Where it is, where its subpath began, and how many parts it has drawn."""

    at: Point = (0.0, 0.0)
    start: Point = (0.0, 0.0)
    drawn: int = 0
    _moved: bool = False
    _done: list[Subpath] = field(default_factory=list)
    _cubics: list[tuple[Point, Point, Point, Point]] = field(default_factory=list)

    def move(self, to: Point) -> None:
        """Begins a subpath."""
        self._finish(closed=False)
        self.at = self.start = to
        self.drawn += 1
        self._moved = True

    def line(self, to: Point) -> None:
        """A straight line."""
        (x, y), (p, q) = self.at, to
        self.cubic((x + (p - x) / 3, y + (q - y) / 3), (p - (p - x) / 3, q - (q - y) / 3), to)

    def quadratic(self, handle: Point, to: Point) -> None:
        """A quadratic Bézier, as the cubic that it is."""
        first, last = (
            (p[0] + 2 / 3 * (handle[0] - p[0]), p[1] + 2 / 3 * (handle[1] - p[1])) for p in (self.at, to)
        )
        self.cubic(first, last, to)

    def cubic(self, first: Point, last: Point, to: Point) -> None:
        """A cubic Bézier with its two handles."""
        self._cubics.append((self.at, first, last, to))
        self.at = to
        self.drawn += 1

    def close(self) -> None:
        """A line back to where the subpath began; also if that is all, which is a dot."""
        if self._cubics or self._moved:
            self.line(self.start)
        self._finish(closed=True)

    def arc(self, rx: float, ry: float, tilt_deg: float, large: bool, sweep: bool, to: Point) -> None:
        """An arc of an ellipse by its end; SVG 2 (B.2.4, B.2.5): too small radii grow, none is a line."""
        if self.at == to:
            return
        rx, ry = abs(rx), abs(ry)
        if not rx or not ry:
            self.line(to)
            return
        tilt = math.radians(tilt_deg % 360.0)
        cos, sin = math.cos(tilt), math.sin(tilt)
        half = ((self.at[0] - to[0]) / 2, (self.at[1] - to[1]) / 2)
        # In the frame in which the ellipse is the unit circle.
        u = (cos * half[0] + sin * half[1]) / rx, (cos * half[1] - sin * half[0]) / ry
        reach = math.hypot(*u)
        if not math.isfinite(reach) or not reach:
            self.line(to)
            return
        if reach > 1:
            rx, ry, u = rx * reach, ry * reach, (u[0] / reach, u[1] / reach)
        off = math.sqrt(max(0.0, 1.0 - u[0] ** 2 - u[1] ** 2)) / math.hypot(*u)
        off = -off if large == sweep else off
        centre = off * u[1], -off * u[0]
        begin = math.atan2(u[1] - centre[1], u[0] - centre[0])
        turn = (math.atan2(-u[1] - centre[1], -u[0] - centre[0]) - begin) % (2 * math.pi)
        turn = turn if sweep else turn - 2 * math.pi
        if not math.isfinite(turn):
            # Numbers beyond all bounds; what comes of them is refused by name.
            self.line(to)
            return
        middle = (self.at[0] + to[0]) / 2, (self.at[1] + to[1]) / 2

        def placed(x: float, y: float) -> Point:
            x, y = rx * (x + centre[0]), ry * (y + centre[1])
            return middle[0] + cos * x - sin * y, middle[1] + sin * x + cos * y

        count = max(1, math.ceil(abs(turn) / _WIDEST_ARC_RAD - 1e-9))
        k = 4 / 3 * math.tan(turn / count / 4)
        for index in range(count):
            one, other = begin + turn * index / count, begin + turn * (index + 1) / count
            end = to if index == count - 1 else placed(math.cos(other), math.sin(other))
            self.cubic(
                placed(math.cos(one) - k * math.sin(one), math.sin(one) + k * math.cos(one)),
                placed(math.cos(other) + k * math.sin(other), math.sin(other) - k * math.cos(other)),
                end,
            )

    def subpaths(self) -> list[Subpath]:
        """All that is drawn."""
        self._finish(closed=False)
        return self._done

    def _finish(self, closed: bool) -> None:
        if self._cubics:
            self._done.append(Subpath(np.array(self._cubics, dtype=np.float64), closed))
            self._cubics = []
        self._moved = False
        if closed:
            self.at = self.start
