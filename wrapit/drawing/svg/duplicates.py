"""Strokes drawn on top of each other, as where two shapes share an edge: one of them is enough."""

from __future__ import annotations

import itertools
import math

import numpy as np
from numpy.typing import NDArray

from wrapit.drawing.svg.cutting import moved
from wrapit.drawing.svg.neighbours import Boxes, Parallels, Polyline
from wrapit.drawing.svg.planar import Curve, stretch
from wrapit.geometry import FloatArray, unit
from wrapit.geometry.bezier import evaluate
from wrapit.geometry.polyline import lengths, total_length

# All in stroke widths. Varied by 30 % each, lengths and angles make no difference to the drawings of the
# tests (shared edges, shapes drawn twice, crossings at acute angles).
# When do two strokes coincide? Closer than 0.3 their ink is one line; over less than 2.5 they only cross, as
# at 15 degrees they are that close over 0.3 · 2 / sin 15° = 2.3.
_NEAR = 0.3
_LEAST = 2.5
_PARALLEL = math.sin(math.radians(15))
# Where does one part from the other? Strokes that touch are closer than 0.003: the steps' own error is 0.002
# on an arc of four widths. A tangent of 6 widths' radius is that far off 0.2 after the touch, 0.3 after 1.9.
# Circles of 20 widths that only touch do so over less than 0.5.
_TOUCHING = 0.003
_TOUCH = 0.5
# Strokes that take longer to part are one to the eye for most of that; 10 widths' radius takes 2.4.
_PARTING = 2.5
# What is left beside them and too short to be a stroke?
_REST = 0.6
# How finely is that looked at? In steps of a quarter of a width; where a stretch ends is then halved twelve
# times, to less than a ten-thousandth of a width.
_FINE = 0.25
_BISECTIONS = 12


def without_coincident(
    curves: list[Curve], width: float
) -> tuple[list[Curve], list[tuple[FloatArray, float]]]:
    """The curves without stretches that lie on an earlier one; middle and length of each such stretch.

    Strokes coincide where they run less than 0.3 stroke widths apart for more than 2.5.
    """
    laid = _Laid(curves, width)
    kept: list[Curve] = []
    doubles: list[tuple[FloatArray, float]] = []
    for index, curve in enumerate(curves):
        spans = laid.spans(index)
        rest = [curve]
        if spans:
            spans = _united(spans)
            doubles += [_middle(curve, span) for span in spans]
            rest = _rest(curve, spans, laid)
        laid.keep(index, rest)
        kept += rest
    return kept, doubles


class _Laid:
    """The curves looked at so far, and what is kept of each, as polylines."""

    def __init__(self, curves: list[Curve], width: float) -> None:
        self.width = width
        self._curves = curves
        # Twice a width: a rest's ends move by less than one, and what is near counts within a third of one.
        self._boxes = Boxes([curve.cubics for curve in curves], 2 * width)
        self._apart = self._boxes.apart()
        self._kept: dict[int, list[Polyline]] = {}
        self._parallels = Parallels(_NEAR * width, _PARALLEL)
        self._latest: tuple[Curve, Polyline] | None = None

    def spans(self, index: int) -> list[tuple[float, float]]:
        """Where a curve runs on earlier ones, as parameters."""
        if index in self._apart:
            return []
        curve = self._curves[index]
        polyline = self._polyline(curve)
        others = self._parallels.beside(polyline)
        return [span for other in others for span in _spans(curve, polyline, other, self.width)]

    def keep(self, index: int, rest: list[Curve]) -> None:
        """Says what is kept of a curve: all of it, parts, or nothing."""
        if index not in self._apart:
            self._kept[index] = [self._polyline(part) for part in rest]
            for polyline in self._kept[index]:
                self._parallels.add(polyline)

    def onto(self, point: FloatArray) -> FloatArray:
        """The nearest point on the curves kept so far, if it lies under the same ink."""
        feet = []
        for polyline in (polyline for k in self._boxes.around(point) for polyline in self._kept.get(k, [])):
            signed, foot, _ = _offsets(point[None], polyline)
            feet.append((abs(float(signed[0])), foot[0]))
        far, foot = min(feet, key=lambda item: item[0], default=(np.inf, point))
        return foot if far < 2 * _NEAR * self.width else point

    def _polyline(self, curve: Curve) -> Polyline:
        # Mostly the curve just looked at, which is kept whole.
        if self._latest is None or self._latest[0] is not curve:
            self._latest = curve, _polyline(curve, self.width)
        return self._latest[1]


def _polyline(curve: Curve, width: float) -> Polyline:
    points, at = [], []
    for k, cubic in enumerate(curve.cubics):
        hull = total_length(cubic)
        t = np.linspace(0, 1, int(np.clip(hull / (_FINE * width), 4, 400)) + 1)
        last = k == len(curve.cubics) - 1
        points.append(evaluate(cubic[None], t)[0][: None if last else -1])
        at.append((k + t)[: None if last else -1])
    chain = np.concatenate(points)
    along = lengths(chain)
    return Polyline(chain, np.concatenate(at), along)


def _offsets(points: FloatArray, other: Polyline) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Signed distance of points from a polyline, the feet, and the polyline's directions there."""
    _, nearest = other.tree.query(points)
    best = np.full(len(points), np.inf)
    signed, feet = np.zeros(len(points)), np.zeros_like(points)
    directions = np.zeros_like(points)
    for step in (nearest - 1, nearest):
        first = np.clip(step, 0, len(other.points) - 2)
        a = other.points[first]
        d = other.points[first + 1] - a
        share = np.clip(((points - a) * d).sum(axis=1) / np.maximum((d * d).sum(axis=1), 1e-18), 0, 1)
        foot = a + share[:, None] * d
        away = points - foot
        far = np.linalg.norm(away, axis=1)
        side = np.where(d[:, 0] * away[:, 1] - d[:, 1] * away[:, 0] < 0, -1.0, 1.0)
        better = far < best
        best = np.where(better, far, best)
        signed = np.where(better, side * far, signed)
        feet[better], directions[better] = foot[better], unit(d)[better]
    return signed, feet, directions


def _spans(curve: Curve, polyline: Polyline, other: Polyline, width: float) -> list[tuple[float, float]]:
    """Parameters from and to which a curve runs on another; over the end of a closed one they go on."""
    low, high = other.box[0] - width, other.box[1] + width
    if ((polyline.points < low) | (polyline.points > high)).any(axis=1).all():
        return []
    signed, _, directions = _offsets(polyline.points, other)
    sine = polyline.directions[:, 0] * directions[:, 1] - polyline.directions[:, 1] * directions[:, 0]
    near = np.abs(signed) < _NEAR * width
    found = []
    for first, last in _runs(near, curve.closed):
        inside = np.arange(first, last + 1) % len(near)
        length = polyline.covered(first, last)
        # At corners the direction means nothing.
        parallel = (np.abs(sine[inside]) < _PARALLEL).mean() > 0.7
        crosses = _changes_sides(signed[inside], 0.5 * _NEAR * width)
        if length < _LEAST * width or not parallel or crosses:
            continue
        found.append(_span(curve, polyline, other, np.abs(signed), (first, last), width))
    return found


def _span(
    curve: Curve, polyline: Polyline, other: Polyline, apart: FloatArray, run: tuple[int, int], width: float
) -> tuple[float, float]:
    """Parameters of a run that lies on another: from touch to touch where they do, else while near."""
    touching = np.arange(run[0], run[1] + 1)
    touching = touching[apart[touching % len(apart)] < _TOUCHING * width]
    ends = [(run[0], _NEAR), (run[1], _NEAR)]
    if len(touching) and polyline.covered(touching[0], touching[-1]) >= _TOUCH * width:
        if polyline.covered(run[0], int(touching[0])) < _PARTING * width:
            ends[0] = (int(touching[0]), _TOUCHING)
        if polyline.covered(touching[-1], run[1]) < _PARTING * width:
            ends[1] = (int(touching[-1]), _TOUCHING)
    start, end = (
        _edge(curve, polyline, other, index, step, near * width)
        for (index, near), step in zip(ends, (-1, 1), strict=True)
    )
    return start, end


def _changes_sides(signed: FloatArray, least: float) -> bool:
    """Whether a run leads from one side to the other: a crossing, however acute."""
    early, late = signed[int(0.15 * len(signed))], signed[int(0.85 * len(signed))]
    return bool(early * late < 0 and min(abs(early), abs(late)) > least)


def _runs(near: NDArray[np.bool_], closed: bool) -> list[tuple[int, int]]:
    """First and last index of each run of flags; runs over the seam of a closed polyline go on beyond it."""
    if near.all():
        return [(0, len(near) - 1)]
    bounds = np.flatnonzero(np.diff(np.concatenate([[False], near, [False]]).astype(np.int8)))
    runs = [(int(a), int(b) - 1) for a, b in zip(bounds[::2], bounds[1::2], strict=True)]
    if closed and len(runs) > 1 and runs[0][0] == 0 and runs[-1][1] == len(near) - 1:
        runs = [*runs[1:-1], (runs[-1][0], len(near) + runs[0][1])]
    return runs


def _edge(curve: Curve, polyline: Polyline, other: Polyline, index: int, step: int, near: float) -> float:
    """The parameter up to which a curve stays nearer than `near`, as it is at `index`."""
    count, turns = len(polyline.at), len(curve.cubics)
    inside = float(polyline.at[index % count]) + turns * (index // count)
    beyond = index + step
    if not curve.closed and not 0 <= beyond < count:
        return inside
    outside = float(polyline.at[beyond % count]) + turns * (beyond // count)
    for _ in range(_BISECTIONS):
        middle = (inside + outside) / 2
        point = _point(curve, middle)
        if abs(float(_offsets(point[None], other)[0][0])) < near:
            inside = middle
        else:
            outside = middle
    return inside


def _united(spans: list[tuple[float, float]]) -> list[tuple[float, float]]:
    joined: list[tuple[float, float]] = []
    for start, end in sorted(spans):
        if joined and start <= joined[-1][1] + 1e-6:
            joined[-1] = (joined[-1][0], max(end, joined[-1][1]))
        else:
            joined.append((start, end))
    return joined


def _rest(curve: Curve, spans: list[tuple[float, float]], laid: _Laid) -> list[Curve]:
    """What is left of a curve beside the spans; its new ends lie on the curves that they ran on."""
    count = float(len(curve.cubics))
    ends = [(end, after[0]) for (_, end), after in itertools.pairwise(spans)]
    if curve.closed:
        ends.append((spans[-1][1], spans[0][0] + count))
        cut = [(True, True)] * len(ends)
    else:
        ends = [(0.0, spans[0][0]), *ends, (spans[-1][1], count)]
        cut = [(k > 0, k < len(ends) - 1) for k in range(len(ends))]
    rest = []
    for (start, end), (at_start, at_end) in zip(ends, cut, strict=True):
        cubics = stretch(curve, start, end) if end > start else None
        if cubics is None:
            continue
        first = laid.onto(cubics[0, 0]) if at_start else cubics[0, 0]
        last = laid.onto(cubics[-1, 3]) if at_end else cubics[-1, 3]
        chain = moved(cubics, first, last)
        if chain.length > _REST * laid.width:
            rest.append(Curve(chain.points, closed=False))
    return rest


def _middle(curve: Curve, span: tuple[float, float]) -> tuple[FloatArray, float]:
    cubics = stretch(curve, *span)
    length = 0.0 if cubics is None else float(moved(cubics, cubics[0, 0], cubics[-1, 3]).length)
    return _point(curve, (span[0] + span[1]) / 2), length


def _point(curve: Curve, at: float) -> FloatArray:
    at = at % len(curve.cubics) if curve.closed else at
    k = min(max(int(at), 0), len(curve.cubics) - 1)
    return evaluate(curve.cubics[k][None], np.array([at - k]))[0, 0]
