"""From millimetres with y up to an SVG page at true size with y down."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

from wrapit.geometry.arrays import FloatArray
from wrapit.geometry.bezier import BezierChain
from wrapit.geometry.outlines.loops import Arc, Edge, Line, Loop, Point, Region


@dataclass(frozen=True)
class SvgFrame:
    """A page whose viewBox counts millimetres; `left`, `top` is the drawing's point at its origin."""

    left: float
    top: float
    width_mm: float
    height_mm: float

    @classmethod
    def around(cls, low: FloatArray, high: FloatArray, margin_mm: float, below_mm: float = 0.0) -> SvgFrame:
        """The page around two corners with a margin, and `below_mm` more at the foot."""
        return cls(
            float(low[0] - margin_mm),
            float(high[1] + margin_mm),
            float(high[0] - low[0] + 2 * margin_mm),
            float(high[1] - low[1] + 2 * margin_mm + below_mm),
        )

    @property
    def view_box(self) -> str:
        """`0 0 width height`."""
        return f"0 0 {number(self.width_mm)} {number(self.height_mm)}"

    @property
    def size(self) -> str:
        """The attributes for true size."""
        return f'width="{number(self.width_mm)}mm" height="{number(self.height_mm)}mm"'

    def at(self, point: Iterable[float]) -> tuple[float, float]:
        """A point of the drawing on the page."""
        x, y = point
        return float(x) - self.left, self.top - float(y)

    def xy(self, point: Iterable[float]) -> str:
        """`x,y` on the page."""
        x, y = self.at(point)
        return f"{number(x)},{number(y)}"

    def path(self, chain: BezierChain) -> str:
        """Path data of a chain of Béziers, exact."""
        return f"M{self.xy(chain.start)}{self._beziers(chain)}"

    def polyline(self, points: FloatArray) -> str:
        """Path data of an open polyline (n, 2)."""
        return "M" + "L".join(self.xy(point) for point in points)

    def outline(self, loop: Loop) -> str:
        """Path data of a closed outline: lines, arcs and Béziers as they are."""
        return self.edges(loop.edges) + "Z"

    def edges(self, edges: tuple[Edge, ...]) -> str:
        """Path data of edges that follow one another."""
        first = edges[0]
        return f"M{self.xy(first.start)}" + "".join(self._edge(edge) for edge in edges)

    def region(self, region: Region) -> str:
        """Path data of a flat piece with its holes, to be filled with the rule `evenodd`."""
        return "".join(self.outline(loop) for loop in (region.outer, *region.holes))

    def _edge(self, edge: Edge) -> str:
        if isinstance(edge, Line):
            return f"L{self.xy(edge.end)}"
        if isinstance(edge, Arc):
            # An SVG arc can't close on itself, and near half a turn its centre hangs on its ends' last digit.
            parts = max(1, math.ceil(abs(edge.sweep_rad) / math.radians(120) - 1e-9))
            return "".join(self._arc(edge, (index + 1) / parts) for index in range(parts))
        return self._beziers(edge)

    def _arc(self, arc: Arc, share: float) -> str:
        angle = arc.start_rad + share * arc.sweep_rad
        end: Point = (
            arc.centre[0] + arc.radius_mm * math.cos(angle),
            arc.centre[1] + arc.radius_mm * math.sin(angle),
        )
        radius = number(arc.radius_mm)
        return f"A{radius},{radius} 0 0 {0 if arc.sweep_rad > 0 else 1} {self.xy(end)}"

    def _beziers(self, chain: BezierChain) -> str:
        return "".join("C" + " ".join(self.xy(point) for point in cubic[1:]) for cubic in chain.points)


def number(value: float) -> str:
    """At most four decimals, without trailing zeros."""
    text = f"{value:.4f}".rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text
