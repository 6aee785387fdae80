"""From fitted curves in pixels to a `Drawing` in mm: scale, place, number."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from wrapit.drawing.changes import Change
from wrapit.drawing.model import Dot, Drawing, Junction, PixelFrame, Removal, Segment
from wrapit.drawing.spots import Spot
from wrapit.geometry import BezierChain, FloatArray


@dataclass(frozen=True, eq=False)
class Piece:
    """A fitted curve between two places, before numbering; `start` and `end` name places."""

    start: int
    end: int
    curve: BezierChain
    kind: str = "stroke"


@dataclass(frozen=True, eq=False)
class Placement:
    """x_mm = scale · x + offset, y likewise; `flip` where y grows downwards in the source."""

    scale: float
    offset: FloatArray
    flip: bool

    def points(self, points: FloatArray) -> FloatArray:
        """Places (..., 2) in mm."""
        factor = np.array([self.scale, -self.scale if self.flip else self.scale])
        return points * factor + self.offset


def bounds(curves: list[BezierChain]) -> tuple[FloatArray, FloatArray]:
    """Exact corners of the box around curves, (2,) each."""
    cubics = np.concatenate([curve.points for curve in curves])
    d = np.diff(cubics, axis=1)
    a, b, c = d[:, 0] - 2 * d[:, 1] + d[:, 2], 2 * (d[:, 1] - d[:, 0]), d[:, 0]
    root = np.sqrt(np.maximum(b * b - 4 * a * c, 0))
    with np.errstate(divide="ignore", invalid="ignore"):
        turns = np.stack([(-b - root) / (2 * a), (-b + root) / (2 * a), -c / b])
    # Each coordinate at its own turning points, which is all that its least and greatest value need.
    t = np.nan_to_num(np.clip(turns, 0, 1), nan=0.0)
    s = 1 - t
    p = cubics.transpose(1, 0, 2)
    inner = s**3 * p[0] + 3 * s * s * t * p[1] + 3 * s * t * t * p[2] + t**3 * p[3]
    points = np.concatenate([cubics[:, 0], cubics[:, 3], inner.reshape(-1, 2)])
    return points.min(axis=0), points.max(axis=0)


def placement(curves: list[BezierChain], size_mm: float | None, flip: bool, scale: float = 1.0) -> Placement:
    """Scales the longest side of the curves' box to `size_mm` (or by `scale`); lower left corner at 0."""
    low, high = bounds(curves)
    if size_mm is not None:
        scale = size_mm / max(float((high - low).max()), 1e-9)
    return Placement(scale, -scale * np.array([low[0], -high[1] if flip else low[1]]), flip)


def assemble(
    places: dict[int, FloatArray],
    pieces: list[Piece],
    place: Placement,
    *,
    width: float | None,
    changes: list[Change],
    pixel_frame: bool,
    spots: Sequence[Spot] = (),
) -> Drawing:
    """The drawing: junctions from top to bottom and left to right, segments by their junctions."""
    used = sorted({node for piece in pieces for node in (piece.start, piece.end)})
    point_of = {node: place.points(places[node]) for node in used}
    ranked = sorted(used, key=lambda node: (round(-point_of[node][1], 3), round(point_of[node][0], 3), node))
    number = {node: index for index, node in enumerate(ranked)}
    oriented = []
    for piece in pieces:
        start, end = number[piece.start], number[piece.end]
        points = place.points(piece.curve.points)
        points[0, 0], points[-1, 3] = point_of[piece.start], point_of[piece.end]
        curve = BezierChain(points)
        if start > end:
            start, end, curve = end, start, curve.reversed()
        oriented.append((start, end, curve, piece.kind))
    oriented.sort(key=lambda item: (item[0], item[1], *np.round(-item[2].points[0, 1, ::-1], 3)))
    return Drawing(
        tuple(Junction(index, point_of[node]) for index, node in enumerate(ranked)),
        tuple(
            Segment(index, start, end, curve, "bridge" if kind == "bridge" else "stroke")
            for index, (start, end, curve, kind) in enumerate(oriented)
        ),
        None if width is None else width * place.scale,
        PixelFrame(place.scale, (float(place.offset[0]), float(place.offset[1]))) if pixel_frame else None,
        tuple(_removal(change, place) for change in changes),
        tuple(_dot(spot, place) for spot in spots),
    )


def _removal(change: Change, place: Placement) -> Removal:
    x, y = place.points(np.array(change.at_px))
    return Removal(change.what, (float(x), float(y)), change.length_px * place.scale, change.reason)


def _dot(spot: Spot, place: Placement) -> Dot:
    x, y = place.points(np.array(spot.at_px))
    return Dot((float(x), float(y)), spot.diameter_px * place.scale)
