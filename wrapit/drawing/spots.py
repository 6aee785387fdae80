"""What is small, round and no line: dots of ink, discs, rings that touch nothing; a bead may stand for it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from wrapit.geometry import FloatArray, IntArray
from wrapit.geometry.bezier import evaluate

# Of the narrowest to the widest: an oval of 4 : 3 still reads as round, a square (0.71) doesn't.
ROUND: Final = 0.75
# Where each cubic of an outline is looked at: a circle of four is round to 0.1 % so.
_SHARES = np.linspace(0, 1, 17)


@dataclass(frozen=True)
class Spot:
    """Something round: its middle and its diameter, in the file's pixels."""

    at_px: tuple[float, float]
    diameter_px: float


def spots_of_outlines(outlines: Sequence[FloatArray]) -> list[Spot]:
    """The round ones among closed outlines of cubics (n, 4, 2) each."""
    found = []
    for cubics in outlines:
        points = evaluate(cubics, _SHARES).reshape(-1, 2)
        middle = (points.min(axis=0) + points.max(axis=0)) / 2
        away = np.hypot(*(points - middle).T)
        if np.array_equal(cubics[0, 0], cubics[-1, 3]) and 0 < ROUND * away.max() <= away.min():
            found.append(Spot((float(middle[0]), float(middle[1])), float(away.min() + away.max())))
    return found


def spots_of_ink(pixels: FloatArray, pairs: IntArray, distance: FloatArray) -> list[Spot]:
    """Round dots of ink, by its skeleton: pixels (n, 2), neighbours (m, 2), each one's distance to the edge.

    A dot's skeleton is hardly longer than a point beside its thickness.
    """
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    links = coo_array((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(len(pixels), len(pixels)))
    count, piece = connected_components(links, directed=False)
    low, high, thick = np.full((count, 2), np.inf), np.full((count, 2), -np.inf), np.zeros(count)
    np.minimum.at(low, piece, pixels)
    np.maximum.at(high, piece, pixels)
    np.maximum.at(thick, piece, 2 * distance)
    long = np.hypot(*(high - low).T)
    middles = (low + high) / 2
    return [
        Spot((float(middles[k, 0]), float(middles[k, 1])), float(thick[k] + long[k] / 2))
        for k in np.flatnonzero(ROUND * (thick + long) <= thick).tolist()
    ]
