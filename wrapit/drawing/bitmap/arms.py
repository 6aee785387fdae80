"""Arms: the clean part of each stroke beside a junction, where no other ink disturbs it, as a curve."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from wrapit.drawing.bitmap.centre_lines import Line
from wrapit.drawing.bitmap.ink import Ink
from wrapit.drawing.bitmap.strand_graph import StrandGraph
from wrapit.geometry import FloatArray
from wrapit.geometry.arrays import median
from wrapit.geometry.polyline import lengths
from wrapit.geometry.polynomials import horner, polynomial

# Over how much of the stroke (in stroke widths) is an arm's quadratic fitted? On prototypes 2 to 4 were
# equally good, a straight line left tangents 4.3 degrees off at the 95th percentile.
_ARM = 3.0
# And on hard edges, where each point tells less? Of 26 thresholded drawings 11 are near their smooth twins;
# 9 with 3, and 9 with 5, which turns one of them 1.4 times as much.
_HARD_ARM = 4.0
# When does it look farther? Where it misses the points by more than 0.006 widths (the noise of a scan), it
# tries these reaches, as long as it misses no more than 1.1 times as much (and a thousandth of a width).
# Varied by 30 %, each moves the mean distance of the curves by less than 0.0002 widths.
_NOISY = 0.006
_FARTHER = (4.5, 6.5)
_SAME = 1.1
_SLACK = 0.001
# When does it look nearer? Where it misses the points by more than this, and half as much there: strokes that
# bend one way and back, or more and more. Their ends were half a width off; no picture of the corpus changes.
_BENT = 0.03
_NEARER = (2.0, 1.4)
_LESS = 0.5
# How far behind the first clean point does an arm start? The width is undisturbed there, the centre not yet
# quite: without the cut, tangents at junctions are 9 degrees off in the median.
_MARGIN = 0.1
# How far (in stroke widths) is a stroke's own width read, and from how many points at least? 30 % make no
# difference to ribbons.
_NEAR = 8.0
_FEWEST = 6


@dataclass(frozen=True, eq=False)
class Arm:
    """The clean part of a strand at one of its ends, walked outward; `cut` counts the points before it.

    `endings` remembers what `endings.place_end` found before it in an ink, as two steps ask for it.
    """

    strand: int
    end: int
    cut: int
    points: FloatArray
    width_px: float
    hard: bool = False
    endings: dict[Ink, Any] = field(default_factory=dict, repr=False)

    @cached_property
    def along(self) -> FloatArray:
        """Length from the first point, (n,)."""
        return lengths(self.points)

    @property
    def length(self) -> float:
        """Length in pixels."""
        return float(self.along[-1])

    def near(self, reach: float) -> tuple[FloatArray, FloatArray]:
        """Lengths and points up to `reach` from the cut, at least three."""
        count = max(3, int(np.searchsorted(self.along, reach, side="right")))
        return self.along[:count], self.points[:count]

    @property
    def model(self) -> FloatArray:
        """Coefficients (3, 2) of a quadratic in the length from the cut (negative towards the junction)."""
        return self._fit[0]

    @property
    def reach(self) -> float:
        """How far the model looks; farther where the stroke is noisy and bends no more for it."""
        return self._fit[1]

    @cached_property
    def _fit(self) -> tuple[FloatArray, float]:
        usual = _HARD_ARM if self.hard else _ARM
        best, rms = self._fitted(usual)
        for share in _NEARER if rms > _BENT * self.width_px else ():
            nearer, missed = self._fitted(share)
            if missed > _LESS * rms:
                break
            best, rms = nearer, missed
        for share in _FARTHER if best[1] == usual * self.width_px else ():
            if rms < _NOISY * self.width_px or self.length < 0.9 * best[1]:
                break
            farther, missed = self._fitted(share)
            if missed > _SAME * rms + _SLACK * self.width_px:
                break
            best, rms = farther, min(missed, rms)
        return best

    def _fitted(self, share: float) -> tuple[tuple[FloatArray, float], float]:
        """The quadratic over a reach (in stroke widths), that reach in pixels, and what is missed."""
        reach = share * self.width_px
        along, points = self.near(reach)
        if along[-1] <= 1.2 * self.width_px:
            return (np.vstack([polynomial(along, points, 1), np.zeros((1, 2))]), reach), 0.0
        a, b, c = model = polynomial(along, points, 2)
        x = along[:, None]
        missed = float(np.sqrt(((a + x * (b + x * c) - points) ** 2).sum() / len(points)))
        return (model, reach), missed

    def at(self, along: float) -> tuple[FloatArray, FloatArray]:
        """Place and outward unit direction on the model."""
        x, y, dx, dy = horner(self.terms, along)
        return np.array([x, y]), np.array([dx, dy])

    @cached_property
    def terms(self) -> list[list[float]]:
        return self.model.tolist()


def arm(line: Line, strand: int, end: int, width_px: float, *, hard: bool = False) -> Arm:
    """The arm of a strand at one end: from its first three clean points on, or its middle if it has none."""
    asked = strand, end, width_px, hard
    if asked not in line.arms:
        line.arms[asked] = _found(line, strand, end, width_px, hard)
    known: Arm = line.arms[asked]
    return known


def _found(line: Line, strand: int, end: int, width_px: float, hard: bool) -> Arm:
    points = line.points if end == 0 else line.points[::-1]
    clean = line.clean if end == 0 else line.clean[::-1]
    width = line.width if end == 0 else line.width[::-1]
    along = line.along if end == 0 else line.along[-1] - line.along[::-1]
    stop = len(points)
    run = clean[:-2] & clean[1:-1] & clean[2:]
    first = int(np.argmax(run)) if run.any() else -1
    if first >= 0:
        first = int(np.searchsorted(along, along[first] + _MARGIN * width_px))
        after = clean[first + 1 :]
        stop = first + 1 + (len(after) if after.all() else int(np.argmin(after)))
        if stop - first < 4 and first + 4 <= len(points):
            stop = first + 4
    # The apex of a gentle corner, which has no width, ends an arm: its quadratic can't follow that.
    apexes = np.flatnonzero(np.isnan(width[first:stop]) & clean[first:stop])
    if first >= 0 and len(apexes) and apexes[0] >= 3:
        stop = first + int(apexes[0]) + 1
    if first < 0 or stop - first < 4:
        first, stop = len(points) // 3, max(len(points) - len(points) // 3, len(points) // 3 + 2)
    return Arm(strand, end, first, points[first:stop], width_px, hard)


def arms_at(
    graph: StrandGraph, lines: Mapping[int, Line], node: int, width_px: float, *, hard: bool
) -> list[Arm]:
    """The arms of a node; those measured on `hard` edges look farther."""
    return [arm(lines[strand], strand, end, width_px, hard=hard) for strand, end in graph.ends_at(node)]


def widths_near(lines: dict[int, Line], arms: list[Arm], width_px: float) -> list[FloatArray]:
    """The widths of each arm's stroke near its end, where they are known."""
    widths = []
    for each in arms:
        line = lines[each.strand]
        away = line.along if each.end == 0 else line.length - line.along
        near = line.clean & (away < _NEAR * width_px) & np.isfinite(line.width)
        widths.append(line.width[near])
    return widths


def usual_width(widths: list[FloatArray], width_px: float) -> float:
    """The median of the widths beside a joint; the picture's where hardly any is known."""
    known = np.concatenate(widths)
    return median(known) if len(known) >= _FEWEST else width_px
