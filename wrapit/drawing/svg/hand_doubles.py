"""Lines drawn twice by hand, as sketching programs do: two wobbly strokes become their mean.

Two strokes are one line where each lies within a stroke width of the other all along. rough.js and Excalidraw
draw them farther apart, one right after the other and in the same direction: a drawing nearly all of whose
strokes come in such pairs is one of theirs.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from wrapit.drawing.svg.cutting import moved
from wrapit.drawing.svg.hand_means import mean_line, mean_loop
from wrapit.drawing.svg.planar import Curve
from wrapit.geometry import FloatArray
from wrapit.geometry.bezier import evaluate
from wrapit.geometry.polyline import total_length

# In sizes of the drawing and in lengths of the stroke: how far apart do the two strokes of such a program
# get? With its own settings (roughness up to 1.5) by 5 px in drawings of 300, and by a fifth of short ones.
_APART_OF_SIZE = 0.02
_APART_OF_LENGTH = 0.25
# And in stroke widths: small drawings wobble as many px as large ones; and nobody takes strokes for one that
# have room for several more between them.
_LEAST_WIDTHS, _APART_WIDTHS = 3.0, 6.0
# Which share of all length has to come in pairs? All of it does in these programs, but for what fills areas.
_SHARE = 0.7
# In widths: shorter strokes are marks, of which two side by side are meant.
_SHORTEST = 3.0
# In widths: strokes that lie nearer to each other all along are one stroke to the eye (duplicates.py).
_ONE_INK = 0.3
# In widths: ends so near to each other are in one place on purpose.
_SAME_PLACE = 0.1
# In distances of the strokes: how far apart the ends of two means lie in one corner, each off by half a
# distance and a little more.
_CORNER = 1.5
# Two lines are parallel on purpose where their distance changes by less than this share of it.
_CONSTANT = 0.15
# A loop drawn by hand overshoots its beginning by up to an eighth of its length, or misses it by as much
# as it wobbles.
_OVERSHOOT = 0.2
# Steps of a cubic: at a quarter circle they are a thousandth of its radius off, less than any hand wobbles.
_STEPS = 12


@dataclass(frozen=True, eq=False)
class Doubles:
    """Curves with one in place of each pair; the pairs' places and lengths; how far apart they lay."""

    curves: list[Curve]
    pairs: list[tuple[FloatArray, float]]
    apart: float


@dataclass(frozen=True, eq=False)
class _Line:
    points: FloatArray
    length: float
    line: Any


def without_hand_doubles(
    curves: list[Curve], owners: Sequence[int], width: float, size: float, by_program: bool
) -> Doubles:
    """Curves, of which each pair drawn as one line is their mean.

    `owners` are the numbers of the shapes that they belong to, `width` the usual width of strokes.
    `by_program` says that a sketching program made the file, whose strokes may share their ends exactly.
    """
    lines = [_line_of(curve) for curve in curves]
    wide = float(np.clip(_APART_OF_SIZE * size, _LEAST_WIDTHS * width, _APART_WIDTHS * width))
    sketched = [
        (k, k + 1)
        for k in range(len(curves) - 1)
        if owners[k] == owners[k + 1] and _is_sketched(lines[k], lines[k + 1], wide, width, by_program)
    ]
    sketched = _disjoint(sketched)
    paired = sum(lines[k].length + lines[m].length for k, m in sketched)
    is_sketch = paired >= _SHARE * sum(line.length for line in lines)
    pairs, most = (sketched, wide) if is_sketch else (_close(lines, width), width)
    if not pairs:
        return Doubles(curves, [], 0.0)
    second = {m for _, m in pairs}
    merged = {k: _mean(curves[k], curves[m], lines[k], lines[m], most) for k, m in pairs}
    apart = max(_distance(lines[k], lines[m]) for k, m in pairs)
    kept = [merged.get(k, curve) for k, curve in enumerate(curves) if k not in second]
    told = [(lines[k].points[len(lines[k].points) // 2], lines[k].length) for k, _ in pairs]
    return Doubles(_met(kept, set(map(id, merged.values())), apart), told, apart)


def _line_of(curve: Curve) -> _Line:
    import shapely

    points = evaluate(curve.cubics, np.linspace(0, 1, _STEPS + 1))
    chain = np.concatenate([points[:, :-1].reshape(-1, 2), points[-1:, -1]])
    return _Line(chain, total_length(chain), shapely.LineString(chain))


def _disjoint(pairs: list[tuple[int, int]]) -> list[tuple[int, int]]:
    """The pairs without those that share a member with an earlier one."""
    used: set[int] = set()
    kept = []
    for pair in pairs:
        if used.isdisjoint(pair):
            used.update(pair)
            kept.append(pair)
    return kept


def _is_sketched(one: _Line, other: _Line, apart: float, width: float, by_program: bool) -> bool:
    """Whether two strokes, one after the other, are a wobbly pair in the same direction."""
    apart = max(width, min(apart, _APART_OF_LENGTH * min(one.length, other.length)))
    if _distance(one, other) > apart:
        return False
    if _is_loop(one, apart) and _is_loop(other, apart):
        return True
    ends = np.linalg.norm(other.points[[0, -1]] - one.points[[0, -1]], axis=1)
    if ends.max() > apart:
        return False
    # The two sides of a leaf meet in its ends.
    is_leaf = ends.max() < _SAME_PLACE * width and not by_program
    return _distance(one, other) <= width or not (is_leaf or _is_parallel(one, other))


def _is_parallel(one: _Line, other: _Line) -> bool:
    """Whether two strokes keep their distance all along, so that both are meant."""
    import shapely

    shares = np.linspace(0, 1, 9)
    a, b = (shapely.line_interpolate_point(line.line, shares, normalized=True) for line in (one, other))
    offsets = shapely.get_coordinates(b) - shapely.get_coordinates(a)
    mean = offsets.mean(axis=0)
    largest = float(np.linalg.norm(offsets, axis=1).max())
    wobble = float(np.linalg.norm(offsets - mean, axis=1).max())
    return wobble < _CONSTANT * largest


def _is_loop(line: _Line, apart: float) -> bool:
    """Whether a stroke comes back to where it began, perhaps overshooting."""
    far = np.linalg.norm(line.points - line.points[0], axis=1)
    late = far[int((1 - _OVERSHOOT) * len(far)) :]
    return bool(late.min() <= apart and far.max() > 2 * apart)


def _distance(one: _Line, other: _Line) -> float:
    """How far a point of one of two strokes lies from the other at most (Hausdorff)."""
    import shapely

    return float(shapely.hausdorff_distance(one.line, other.line))


def _close(lines: list[_Line], width: float) -> list[tuple[int, int]]:
    """Pairs of strokes within a width of each other all along, whose ends meet or which are both loops.

    Strokes that lie on each other are no such pairs: their ink is that of one.
    """
    from scipy.spatial import cKDTree

    if len(lines) < 2:
        return []
    corners = np.array([np.concatenate([line.points.min(axis=0), line.points.max(axis=0)]) for line in lines])
    # Boxes of strokes within a width of each other differ by less than a width on each side.
    near = cKDTree(corners).query_pairs(width, p=np.inf, output_type="ndarray")
    found = []
    for k, m in sorted(map(tuple, near.tolist())):
        one, other = lines[k], lines[m]
        if min(one.length, other.length) < _SHORTEST * width or _distance(one, other) > width:
            continue
        ends = one.points[[0, -1]]
        ahead, back = (np.linalg.norm(ends - other.points[way], axis=1).max() for way in ([0, -1], [-1, 0]))
        if min(ahead, back) <= width or (_is_loop(one, width) and _is_loop(other, width)):
            found.append((k, m))
    wobbly = [pair for pair in found if _distance(lines[pair[0]], lines[pair[1]]) > _ONE_INK * width]
    return _disjoint(found) if wobbly else []


def _mean(one: Curve, other: Curve, line: _Line, beside: _Line, most: float) -> Curve:
    """The mean of two strokes that lie at most so far apart."""
    apart = _distance(line, beside)
    if _is_loop(line, most) and _is_loop(beside, most):
        return Curve(mean_loop(line.points, beside.points, apart), closed=True)
    ends = line.points[[0, -1]]
    ahead = np.linalg.norm(ends - beside.points[[0, -1]], axis=1).max()
    back = np.linalg.norm(ends - beside.points[[-1, 0]], axis=1).max()
    turned = other.cubics if ahead <= back else other.cubics[::-1, ::-1]
    if len(turned) == len(one.cubics):
        return Curve((one.cubics + turned) / 2, closed=False)
    points = beside.points if ahead <= back else beside.points[::-1]
    return Curve(mean_line(line.points, points, apart), closed=False)


def _met(curves: list[Curve], merged: set[int], apart: float) -> list[Curve]:
    """Curves whose merged ends within the wobble of each other meet in one place, as drawn corners."""
    from scipy.cluster.hierarchy import fcluster, linkage

    open_ones = [k for k, curve in enumerate(curves) if id(curve) in merged and not curve.closed]
    if not open_ones:
        return curves
    ends = np.concatenate([curves[k].cubics[[0, -1], [0, -1]] for k in open_ones])
    group = fcluster(linkage(ends, "complete"), _CORNER * apart, "distance") if len(ends) > 1 else np.ones(1)
    places = {name: ends[group == name].mean(axis=0) for name in set(group.tolist())}
    found = list(curves)
    for row, k in enumerate(open_ones):
        start, end = places[group[2 * row]], places[group[2 * row + 1]]
        if group[2 * row] != group[2 * row + 1]:
            found[k] = Curve(moved(curves[k].cubics, start, end).points, closed=False)
    return found
