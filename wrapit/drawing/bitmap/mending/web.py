"""Joints that lie close together, and the strokes between and around them: moved until their edges fit the ink.

As a chain of sides in a crowd of corners, but with joints: each stroke is a parabola, which ends in a joint
that moves or where the stroke stands alone. All points of them are linear in what moves.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from wrapit.drawing.bitmap.corners.edge_fit import nearest_of_all
from wrapit.geometry import FloatArray, IntArray
from wrapit.geometry.polyline import total_length

# In how many steps is a parabola drawn?
_STEPS = 8
# In stroke widths.
# How far may a joint move? As far as thinning may pull it.
_FARTHEST = 1.2
# What is off by more says less and less; and what moves is held back by a fiftieth, so that the sum is regular.
_DOUBTED = 0.08
_HELD = 0.02
# How much says ink beside a corner, or a tip, which may be a mitre's?
_MITRE = 0.2
# How far off may what stays as it is have edges in common with what moves?
_NEAR = 2.5
# How long may the bent part of a stroke be, in shares of the way from the joint to where it stands alone?
_BEND = (0.15, 1.0)
# When has it settled?
_SETTLED = 1e-3
_ROUNDS = 20


@dataclass(frozen=True, eq=False)
class Between:
    """A stroke between two joints (by their places in the list) by a point (2,) that it bends towards."""

    start: int
    end: int
    bend: FloatArray
    half: float


@dataclass(frozen=True, eq=False)
class Outward:
    """A stroke from a joint to where it stands alone: a place (2,), and its direction there."""

    joint: int
    to: FloatArray
    direction: FloatArray
    half: float


@dataclass(frozen=True, eq=False)
class Still:
    """A stroke as it is: points (n, 2) along it, and half its width (n,) there."""

    points: FloatArray
    halves: FloatArray

    @cached_property
    def length(self) -> float:
        """Length in pixels."""
        return total_length(self.points)

    @cached_property
    def _box(self) -> tuple[FloatArray, FloatArray]:
        return self.points.min(axis=0), self.points.max(axis=0)

    def reaches(self, low: FloatArray, high: FloatArray) -> bool:
        """Whether its box reaches into another, from `low` to `high` (2,)."""
        return bool((self._box[0] <= high).all() and (self._box[1] >= low).all())

    def part(self, first: int, last: int) -> Still:
        """From one of its points to before another."""
        return Still(self.points[first:last], self.halves[first:last])


@dataclass(frozen=True, eq=False)
class Web:
    """Joints (n, 2), some of them corners (n,), with their strokes, and those that stay as they are."""

    joints: FloatArray
    corners: FloatArray
    between: list[Between]
    outward: list[Outward]
    still: list[Still]
    width_px: float

    def settled(self, edge: FloatArray) -> tuple[FloatArray, list[FloatArray], list[FloatArray]]:
        """The joints (n, 2) and bends, between and outward, with which the strokes' edges lie at `edge` (m, 2)."""
        from scipy.optimize import least_squares

        model = self._model()
        low, high = self._bounds()

        def cost(x: FloatArray) -> FloatArray:
            return np.concatenate([model.off(x, edge)[0], _HELD * x])

        def slopes(x: FloatArray) -> FloatArray:
            return np.concatenate([model.off(x, edge)[1], _HELD * np.eye(len(x))])

        found = least_squares(
            cost,
            np.zeros(len(low)),
            slopes,
            bounds=(low, high),
            loss="soft_l1",
            f_scale=_DOUBTED,
            ftol=_SETTLED,
            xtol=_SETTLED,
            max_nfev=_ROUNDS,
        )
        return self._read(found.x)

    @cached_property
    def drawn(self) -> list[FloatArray]:
        """Points (n, 2) along each stroke that moves, as it is."""
        shares = parabola_shares(_STEPS)
        between = [(self.joints[each.start], each.bend, self.joints[each.end]) for each in self.between]
        outward = [(self.joints[out.joint], self._bend(out), out.to) for out in self.outward]
        return [shares @ np.stack(points) for points in (*between, *outward)]

    def _bounds(self) -> tuple[FloatArray, FloatArray]:
        ways = [
            float(np.linalg.norm(out.to - self.joints[out.joint])) / self.width_px for out in self.outward
        ]
        free = np.full(2 * (len(self.joints) + len(self.between)), _FARTHEST)
        shares = [np.array([(share - 0.5) * way for way in ways]) for share in _BEND]
        return np.concatenate([-free, shares[0]]), np.concatenate([free, shares[1]])

    def _read(self, x: FloatArray) -> tuple[FloatArray, list[FloatArray], list[FloatArray]]:
        moved = x[: 2 * (len(self.joints) + len(self.between))].reshape(-1, 2) * self.width_px
        joints = self.joints + moved[: len(self.joints)]
        between = [
            each.bend + step for each, step in zip(self.between, moved[len(self.joints) :], strict=True)
        ]
        outward = [
            self._bend(out) - length * self.width_px * out.direction
            for out, length in zip(self.outward, x[len(x) - len(self.outward) :], strict=True)
        ]
        return joints, between, outward

    def _bend(self, out: Outward) -> FloatArray:
        return out.to - float(np.linalg.norm(out.to - self.joints[out.joint])) / 2 * out.direction

    @cached_property
    def near(self) -> list[Still]:
        """What stays as it is, as far as it may have edges in common with what moves."""
        from scipy.spatial import cKDTree

        tree = cKDTree(np.concatenate(self.drawn))
        parts = []
        for still in self.still:
            near = np.isfinite(tree.query(still.points, distance_upper_bound=_NEAR * self.width_px)[0])
            changes = np.flatnonzero(np.diff(near)) + 1
            runs = zip(np.split(still.points, changes), np.split(still.halves, changes), strict=True)
            parts += [Still(*run) for run in list(runs)[0 if near[0] else 1 :: 2] if len(run[0]) > 1]
        return parts

    def _model(self) -> _Model:
        count = 2 * (len(self.joints) + len(self.between)) + len(self.outward)
        lines: list[tuple[FloatArray, FloatArray]] = []

        def free(k: int) -> FloatArray:
            moves = np.zeros((2, count))
            moves[0, 2 * k] = moves[1, 2 * k + 1] = self.width_px
            return moves

        still = np.zeros((2, count))
        for k, each in enumerate(self.between):
            points = np.stack([self.joints[each.start], each.bend, self.joints[each.end]])
            moves = np.stack([free(each.start), free(len(self.joints) + k), free(each.end)])
            lines.append((points, moves))
        for k, out in enumerate(self.outward):
            bend = still.copy()
            bend[:, count - len(self.outward) + k] = -self.width_px * out.direction
            points = np.stack([self.joints[out.joint], self._bend(out), out.to])
            lines.append((points, np.stack([free(out.joint), bend, still])))
        shares = parabola_shares(_STEPS)
        drawn = [(shares @ points, np.tensordot(shares, moves, 1)) for points, moves in lines]
        halves = [np.full(_STEPS, each.half) for each in (*self.between, *self.outward)]
        for part in self.near:
            drawn.append((part.points, np.zeros((len(part.points), 2, count))))
            halves.append(part.halves[1:])
        return _Model(
            np.concatenate([points[:-1] for points, _ in drawn]),
            np.concatenate([points[1:] for points, _ in drawn]),
            np.concatenate([moves[:-1] for _, moves in drawn]),
            np.concatenate([moves[1:] for _, moves in drawn]),
            np.concatenate(halves),
            np.flatnonzero(self.corners),
            self.joints,
            self.width_px,
        )


@dataclass(frozen=True, eq=False)
class _Model:
    """Sides from `starts` to `ends` (s, 2), each with its change (s, 2, x) by what moves; `corners` of joints."""

    starts: FloatArray
    ends: FloatArray
    start_moves: FloatArray
    end_moves: FloatArray
    halves: FloatArray
    corners: IntArray
    joints: FloatArray
    width_px: float

    def off(self, x: FloatArray, edge: FloatArray) -> tuple[FloatArray, FloatArray]:
        """How far outside (n,) of the strokes points of the ink's edge lie, in widths, and its slopes (n, x)."""
        starts = self.starts + self.start_moves @ x
        ends = self.ends + self.end_moves @ x
        side, share, gap = nearest_of_all(starts, ends - starts, edge)
        distance = np.linalg.norm(gap, axis=1)
        off = (distance - self.halves[side]) / self.width_px
        weight = np.ones(len(off))
        for corner in self.corners:
            at = self.joints[corner] + self.width_px * x[2 * corner : 2 * corner + 2]
            weight[(np.abs(np.linalg.norm(edge - at, axis=1) - distance) < 1e-6) & (off > 0)] = _MITRE
        away = gap / np.maximum(distance, 1e-9)[:, None]
        share = share[:, None, None]
        moves = (1 - share) * self.start_moves[side] + share * self.end_moves[side]
        slopes = -np.einsum("nk,nkx->nx", away, moves) / self.width_px
        return weight * off, weight[:, None] * slopes


def parabola_shares(steps: int) -> FloatArray:
    """What of its start, bend and end is in points (steps + 1, 3) along a parabola."""
    t = np.linspace(0, 1, steps + 1)
    return np.column_stack([(1 - t) ** 2, 2 * (1 - t) * t, t**2])
