"""How well do strokes, drawn again, explain the ink around a stretch that several of them may share?"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from wrapit.drawing.bitmap.arms import Arm
from wrapit.drawing.bitmap.endings import place
from wrapit.drawing.bitmap.ink import Ink
from wrapit.drawing.bitmap.pairing import pair, unkinked
from wrapit.geometry import FloatArray
from wrapit.geometry.polyline import at_lengths, lengths

# How far around is the ink compared, and how finely? In stroke widths: a stroke's edge lies at 0.5; what is
# farther away is others' ink, the same for all answers.
_AROUND = 0.9
_PLACES = 0.1
_POINTS = 0.05
# How far are arms drawn?
_ARM = 1.0


@dataclass(frozen=True, eq=False)
class Surroundings:
    """Places (n, 2) around a stretch of ink, how dark each is (n,) from 0 to 1, and how much ink each is for.

    `share` is the area of one place in squared stroke widths.
    """

    places: FloatArray
    dark: FloatArray
    share: float
    width_px: float

    def misfit(self, strokes: Iterable[FloatArray]) -> float:
        """The ink that these strokes (n, 2) have too much and too little, in squared stroke widths."""
        away = _distances(self.places, strokes, _POINTS * self.width_px)
        drawn = np.clip(self.width_px / 2 - away + 0.5, 0.0, 1.0)
        return float(np.abs(drawn - self.dark).sum()) * self.share


def surroundings(
    ink: Ink, points: FloatArray, heads: Sequence[Arm], tails: Sequence[Arm], width_px: float
) -> Surroundings:
    """Those of a stretch (n, 2) and of the disturbed ink between it and the arms at either end.

    `width_px` is how broad the strokes are here.
    """
    step = max(1, int(_PLACES * width_px))
    around = _ways(points, heads, tails)
    cloud = np.vstack(around)
    height, width = ink.grey.shape
    low = np.maximum(np.floor(cloud.min(axis=0) - _AROUND * width_px).astype(int), 0)
    high = np.minimum(np.ceil(cloud.max(axis=0) + _AROUND * width_px).astype(int) + 1, (width, height))
    x, y = np.meshgrid(np.arange(low[0], high[0], step), np.arange(low[1], high[1], step))
    places = np.column_stack([x.ravel(), y.ravel()])
    places = places[_distances(places, around, _POINTS * width_px) < _AROUND * width_px]
    grey = ink.grey[places[:, 1], places[:, 0]].astype(np.float64)
    dark = np.clip((ink.paper - grey) / (ink.paper - ink.ink), 0.0, 1.0)
    return Surroundings(places, dark, (step / width_px) ** 2, width_px)


def _ways(points: FloatArray, heads: Sequence[Arm], tails: Sequence[Arm]) -> list[FloatArray]:
    """A stretch and the straight ways from its ends to the arms there."""
    starts = [(arm, points[0]) for arm in heads] + [(arm, points[-1]) for arm in tails]
    return [points, *(np.vstack([end, arm.points[0]]) for arm, end in starts)]


def joint(arms: list[Arm], around: FloatArray, pairs: list[tuple[int, int]], ink: Ink) -> list[FloatArray]:
    """The strokes from where these arms meet."""
    point, endings = place(arms, around, pairs, ink)
    return [
        np.vstack([point, ending.lead, arm.near(_ARM * arm.width_px)[1][max(ending.cut - arm.cut, 0) :]])
        for arm, ending in zip(arms, endings, strict=True)
    ]


def meeting(arms: list[Arm], around: FloatArray, ink: Ink) -> list[FloatArray]:
    """The same where it is not known which arms continue each other."""
    return joint(arms, around, unkinked(arms, pair(arms)), ink)


def two_joints(
    points: FloatArray, heads: list[Arm], tails: list[Arm], stretch: tuple[Arm, Arm], ink: Ink
) -> list[FloatArray]:
    """The strokes at both ends of a stretch (n, 2) that is one of its own; `stretch` are its arms."""
    first, last = [*heads, stretch[0]], [*tails, stretch[1]]
    before, after = meeting(first, points[0], ink), meeting(last, points[-1], ink)
    # What is nearest to both joints is bent by thinning.
    inner = points[len(points) // 4 : -(len(points) // 4)]
    return [*before[:-1], *after[:-1], np.vstack([before[-1][:1], inner, after[-1][:1]])]


def _distances(places: FloatArray, strokes: Iterable[FloatArray], step: float) -> FloatArray:
    """How far each place is from the nearest stroke, to a thousandth of the width."""
    from scipy.spatial import cKDTree

    dense = []
    for stroke in strokes:
        along = lengths(stroke)
        dense.append(at_lengths(stroke, along, np.linspace(0, along[-1], max(2, int(along[-1] / step) + 1))))
    return np.asarray(cKDTree(np.vstack(dense)).query(places)[0], dtype=np.float64)
