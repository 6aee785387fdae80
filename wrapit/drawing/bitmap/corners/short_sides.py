"""Corners in a crowd: several with short sides between them, found together from both edges of the ink."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from wrapit.drawing.bitmap.centre_lines import Line, edges
from wrapit.drawing.bitmap.corners.edge_fit import chain_of, missed
from wrapit.drawing.bitmap.corners.turning import LONGEST
from wrapit.drawing.bitmap.ink import Ink
from wrapit.geometry import FloatArray, unit
from wrapit.geometry.arrays import median
from wrapit.geometry.polyline import lengths, slopes

# In stroke widths, measured on the chains named in `edge_fit.py`.
# When does the middle line explain the ink, so that no corners need be looked for? Where nine points in ten
# of the edges miss it by less: three in five of the bends of real drawings, and one chain in thirty.
_MOSTLY = 90
_ENOUGH = 0.02
# Fewer points of the middle line than this say nothing: a chain of two sides has as many unknowns.
_FEWEST = 8
# When does a chain fit? Grey edges are off by 0.01 to 0.02, hard ones by up to a fifth of a pixel; with 0.02
# and 0.14 px 101 and 121 chains come out right instead of 123, with 0.036 and 0.26 px 127 and 127.
_GOOD = 0.028
_GOOD_PX = 0.2
# And when better than the line or the corners that are known? With 0.7, 119 come out right, with 0.9 127;
# these are on the strict side, as bends must not pass for corners.
_BETTER = 0.8
# How is the edge looked for? Across the line and, in radians, aslant of it, to see behind corners: across
# alone loses seven chains. The tip of a mitre may be farther than 1.3 widths, and says nothing new.
_LOOKS = (0.0, 0.6, -0.6)
_OUT = 1.3


@dataclass(frozen=True, eq=False)
class Chain:
    """Ends of straight sides (m, 2), instead of a line's points `first` to `last` - 1; their ink's width."""

    points: FloatArray
    first: int
    last: int
    width_px: float

    def side(self, k: int) -> Line:
        """The side from corner `k`, with points a little off both ends: sides point at their corners."""
        start, end = self.points[k : k + 2]
        length = float(np.linalg.norm(end - start))
        count = max(6, round(8 * length / self.width_px))
        share = np.linspace(0.1, 0.9, count)[:, None]
        points = start + share * (end - start)
        return Line(points, np.full(count, self.width_px), np.ones(count, dtype=np.bool_), lengths(points))


def stretch_of(line: Line, first: int, last: int, longest: float) -> tuple[FloatArray, float] | None:
    """The middle line (n, 2) from one point to another, and how wide its ink is.

    None where that is of too few points, or longer than `longest` widths.
    """
    if last - first < _FEWEST:
        return None
    width_px = median(line.width[first : last + 1][line.clean[first : last + 1]])
    if line.along[last] - line.along[first] > longest * width_px:
        return None
    return line.points[first : last + 1], width_px


def chain_between(line: Line, ink: Ink, start: int, end: int, known: list[FloatArray]) -> Chain | None:
    """The chain that fits the ink between two points of a line best.

    None where there is none that fits clearly better than the line itself, or `known` corners, do.
    """
    first, last = clean_from(line, start, -1), clean_from(line, end, 1)
    if first is None or last is None:
        return None
    stretch = stretch_of(line, first, last, LONGEST)
    if stretch is None:
        return None
    middle, width_px = stretch
    edge = edge_points(ink, middle, width_px)
    plain = missed(middle, edge, width_px)
    if np.percentile(np.abs(plain.outside), _MOSTLY) < _ENOUGH:
        return None
    best = plain.rms
    if known:
        best = min(best, missed(np.concatenate([middle[:1], *known, middle[-1:]]), edge, width_px).rms)
    chain = chain_of(middle, edge, width_px, min(max(_GOOD, _GOOD_PX / width_px), _BETTER * best))
    return None if chain is None else Chain(chain, first + 1, last, width_px)


def clean_from(line: Line, at: int, sign: int) -> int | None:
    """The nearest point from one on from where the line runs on clean for a bit."""
    run = line.clean[at:] if sign > 0 else line.clean[at::-1]
    steady = np.flatnonzero(run[:-2] & run[1:-1] & run[2:])
    return at + sign * int(steady[0]) if len(steady) else None


def edge_points(ink: Ink, middle: FloatArray, width_px: float) -> FloatArray:
    """Points (n, 2) of the ink's edges seen from a line: across it, and aslant to see behind corners."""
    return edges_from(ink, middle, width_px)[0]


def edges_from(ink: Ink, middle: FloatArray, width_px: float) -> tuple[FloatArray, NDArray[np.intp]]:
    """Points (n, 2) of the ink's edges seen from a line, and the point of the line (n,) each is seen from."""
    course = unit(slopes(middle))
    normal = np.column_stack([-course[:, 1], course[:, 0]])
    # Every other point tells as much.
    at = np.arange(0, len(middle), 2)
    middle, normal, course = middle[at], normal[at], course[at]
    rays = np.stack([math.cos(aslant) * normal + math.sin(aslant) * course for aslant in _LOOKS])
    origins = np.concatenate([middle] * len(_LOOKS))
    far = edges(ink, origins, rays.reshape(-1, 2), _OUT * width_px, max(0.5, width_px / 14))
    against, along = (side.reshape(len(_LOOKS), -1, 1) * rays for side in far)
    points = np.stack([middle - against, middle + along], axis=1).reshape(-1, 2)
    seen = np.isfinite(points).all(axis=1)
    return points[seen], np.tile(at, 2 * len(_LOOKS))[seen]
