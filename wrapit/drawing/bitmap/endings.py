"""Where strokes end and meet: at the point that their clean parts point at, or at the edge of the ink."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from wrapit.drawing.bitmap.arms import Arm
from wrapit.drawing.bitmap.ends.caps import find_cap
from wrapit.drawing.bitmap.ends.merges import Merge, find_merge
from wrapit.drawing.bitmap.ink import Ink
from wrapit.drawing.bitmap.pairing import Through, through
from wrapit.geometry import FloatArray, unit
from wrapit.geometry.polynomials import angle, horner, nearest_along, parabola_shares

# When does a single arm leave along the stroke that goes through? Branches of curls and leaves are drawn
# tangentially, and the arm alone doesn't tell 10 degrees from none; 14 or 26 make no difference.
SNAP_RAD = math.radians(20)
# How much do a pair's curve, a single arm and the skeleton's own place say about where a junction is? Single
# arms are extrapolated, a pair is interpolated; the place only keeps the sum regular, and hardly that where
# two curves fix the point already, even at an acute angle.
_PAIR_WEIGHT, _SINGLE_WEIGHT = 1.0, 0.3
_PRIOR_OF_ONE, _PRIOR_OF_TWO = 0.01, 1e-4
# And about a place that is known? From 1.4 to 3 the same 25 of 28 hard-edged pictures are near their smooth
# twins or the truth; with 1 a whale's corner stays off by 1.9 px, with 4.5 a heart's moves by 0.9.
_PRIOR_OF_KNOWN = 2.0
# Where do strokes meet nowhere? Farther than this from the skeleton's place, in stroke widths: of 1111 joints
# on real drawings the farthest is 3.1, while nearly parallel strokes "met" a hundred widths off.
_ASTRAY = 4.0
# When does a single arm miss the junction? By more than this, in stroke widths: then it bends there over so
# many times what it misses by, as an S in the little ink between would be none that a pen drew.
_MISSED = 0.1
_GENTLY = 5.0
# In what steps is it drawn? A point every quarter of the width tells a curve as well as one every eighth.
_FINE = 0.25


@dataclass(frozen=True, eq=False)
class Ending:
    """How a strand leaves a junction: outward unit tangent, points that lead to the cut, and the cut."""

    tangent: FloatArray
    lead: FloatArray
    cut: int


def place(
    arms: list[Arm], around: FloatArray, pairs: list[tuple[int, int]], ink: Ink, *, known: bool = False
) -> tuple[FloatArray, list[Ending]]:
    """The point where the arms meet, and how each leaves it; `pairs` of arms continue each other.

    The point minimises the weighted squared distance to one curve through each pair of arms (weight 1),
    to the extrapolated single arms (0.3), and weakly to `around`; strongly where that is `known`.
    """
    merge = find_merge(arms, ink) if len(arms) == 3 else None
    if merge is not None:
        pairs = [merge.pair]
    curves = [through(arms[i], arms[j]) for i, j in pairs]
    single = [k for k in range(len(arms)) if not any(k in pair_ for pair_ in pairs)]
    lone = [arms[k] for k in single]
    # Two curves fix the point, even where they cross at an acute angle.
    prior = _PRIOR_OF_KNOWN if known else _PRIOR_OF_ONE if len(curves) < 2 else _PRIOR_OF_TWO
    point, feet = _met(curves, lone, around, prior)
    if np.linalg.norm(point - around) > _ASTRAY * max(each.width_px for each in arms):
        # Nearly parallel strokes meet nowhere.
        point, feet = _met(curves, lone, around, _PRIOR_OF_KNOWN)
    if merge is not None:
        point = merge.point
    endings: dict[int, Ending] = {}
    for (i, j), curve, foot in zip(pairs, curves, feet, strict=True):
        foot_now = curve.foot(point, foot)
        direction = curve.at(foot_now)[1]
        offset = point - curve.at(foot_now)[0]
        for k, sign in ((i, -1), (j, 1)):
            lead = _lead(curve, foot_now, sign * curve.gap / 2, offset, arms[k])
            tangent = sign * direction
            endings[k] = Ending(tangent, lead, arms[k].cut + passed(arms[k], point, tangent))
    through_tangents = [endings[k].tangent for k in endings]
    for k in single:
        endings[k] = (
            _single_ending(arms[k], point, through_tangents)
            if merge is None
            else _merged_ending(arms[k], merge, through_tangents)
        )
    return point, [endings[k] for k in range(len(arms))]


def _met(
    curves: list[Through], lone: list[Arm], around: FloatArray, prior: float
) -> tuple[FloatArray, list[float]]:
    """The point nearest to all curves and arms, and its foot on each curve."""
    point: FloatArray = around
    feet = [0.0] * len(curves)
    for _ in range(3):
        pulls = []
        for k, curve in enumerate(curves):
            feet[k] = curve.foot(point, feet[k])
            pulls.append((_PAIR_WEIGHT, *horner(curve.terms, feet[k])))
        for each in lone:
            along = nearest_along(each.terms, point, 0.0, -4 * each.width_px, 0.0)
            pulls.append((_SINGLE_WEIGHT, *horner(each.terms, along)))
        point = _pulled(point, prior, pulls)
    return point, feet


def _pulled(
    point: FloatArray, prior: float, pulls: list[tuple[float, float, float, float, float]]
) -> FloatArray:
    """The point nearest to lines, each with a weight, a place and a direction, and weakly to itself."""
    xx = yy = prior
    xy, right_x, right_y = 0.0, prior * float(point[0]), prior * float(point[1])
    for weight, x, y, dx, dy in pulls:
        across = weight * (dx * y - dy * x)
        xx, xy, yy = xx + weight * dy * dy, xy - weight * dx * dy, yy + weight * dx * dx
        right_x, right_y = right_x - dy * across, right_y + dx * across
    determinant = xx * yy - xy * xy
    return np.array([yy * right_x - xy * right_y, xx * right_y - xy * right_x]) / determinant


def _extrapolated(single: Arm, point: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Place and direction of the arm's model nearest to a point before its cut."""
    return single.at(nearest_along(single.terms, point, 0.0, -4 * single.width_px, 0.0))


def _single_ending(single: Arm, point: FloatArray, tangents: list[FloatArray]) -> Ending:
    on, direction = _extrapolated(single, point)
    behind = passed(single, point, direction)
    for tangent in tangents:
        if angle(tangent, direction) < SNAP_RAD:
            return Ending(tangent, np.zeros((0, 2)), single.cut + behind)
    missed = float(np.linalg.norm(on - point))
    if missed < _MISSED * single.width_px:
        return Ending(direction, np.zeros((0, 2)), single.cut + behind)
    gently = int(np.searchsorted(single.along, min(_GENTLY * missed, single.length / 2, 3 * single.width_px)))
    first = max(behind, gently)
    to, (_, direction) = single.points[first], single.at(float(single.along[first]))
    return bent_ending(single, first, point, to - float(np.linalg.norm(to - point)) / 2 * direction)


def _merged_ending(single: Arm, merge: Merge, tangents: list[FloatArray]) -> Ending:
    """Along the arc between the joint and the arm; tangentially to the other stroke where it is nearly so."""
    tangent = min(tangents, key=lambda along: angle(along, merge.direction))
    if angle(tangent, merge.direction) > SNAP_RAD:
        tangent = merge.direction
    return Ending(tangent, merge.lead, single.cut)


def bent_ending(arm: Arm, first: int, point: FloatArray, bend: FloatArray) -> Ending:
    """A parabola from the junction, towards a place (2,) where it bends, to one of an arm's points."""
    to = arm.points[first]
    steps = max(3, int(np.linalg.norm(to - point) / (_FINE * arm.width_px)))
    lead = parabola_shares(steps)[1:-1] @ np.stack([point, bend, to])
    return Ending(unit(bend - point), lead, arm.cut + first)


def passed(arm: Arm, point: FloatArray, tangent: FloatArray) -> int:
    """How many of an arm's first points lie behind the junction, where a stroke would have to double back.

    A junction lies inside an arm where the others pull it there; at most half the arm makes way.
    """
    most = min(len(arm.points) - 1, int(np.searchsorted(arm.along, arm.length / 2)))
    ahead = (arm.points[: most + 1] - point) @ tangent > 0
    return int(np.argmax(ahead)) if ahead.any() else most


def _lead(curve: Through, foot: float, cut: float, offset: FloatArray, to: Arm) -> FloatArray:
    """Points on the curve between the junction and the cut, the junction's offset fading out."""
    count = int(abs(cut - foot) / max(to.width_px / 4, 1.0))
    if count < 2 or (cut - foot) * cut <= 0:
        return np.zeros((0, 2))
    share = np.arange(1, count) / count
    powers = (foot + share * (cut - foot))[:, None] ** np.arange(len(curve.coefficients))
    return powers @ curve.coefficients + (1 - share)[:, None] * offset


def place_end(arm: Arm, ink: Ink) -> tuple[FloatArray, Ending]:
    """The end point of a stroke, and its outward (into the stroke) tangent.

    A round cap ends half the stroke's own width behind the edge of its ink, a flat one at the edge: the
    side of the picture cuts strokes flat, too.
    """
    if ink not in arm.endings:
        arm.endings[ink] = _end_in(arm, ink)
    known: tuple[FloatArray, Ending] = arm.endings[ink]
    return known


def _end_in(arm: Arm, ink: Ink) -> tuple[FloatArray, Ending]:
    a, b, _ = arm.model
    # The curve goes on as its tangent, a quadratic would curl.
    start, slope = a, unit(b)
    cap = find_cap(start, -slope, arm.width_px, ink)
    if cap is None:
        return start, Ending(slope, np.zeros((0, 2)), arm.cut)
    back = cap.edge_px - (0.0 if cap.flat else cap.width_px / 2)
    if back >= 0:
        return start - back * slope, Ending(slope, np.zeros((0, 2)), arm.cut)
    inside = min(-back, arm.length / 2)
    first = int(np.searchsorted(arm.along, inside, side="right"))
    place, direction = arm.at(inside)
    return place, Ending(direction, np.zeros((0, 2)), arm.cut + first)
