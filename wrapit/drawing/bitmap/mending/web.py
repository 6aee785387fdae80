"""Joints close together, and the strokes between and around them: moved until their edges are the ink's.

What chains of sides are to crowds of corners, but with joints: each stroke is a parabola from a joint to
another one, or to where it stands alone. All points of them are linear in what moves.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np

from wrapit.drawing.bitmap.corners.edge_fit import nearest_of_all
from wrapit.geometry import FloatArray
from wrapit.geometry.polyline import total_length
from wrapit.geometry.polynomials import parabola_shares

# In how many steps is a parabola drawn?
_STEPS = 8
# In stroke widths.
# How far may a joint move? As far as thinning may pull it; 0.8 does as well.
_FARTHEST = 1.2
# From what on does an edge that is off say less and less? And how much is what moves held back, so that the
# sum is regular?
_DOUBTED = 0.08
_HELD = 0.02
# How much says an edge behind a corner, where there may be a mitre?
_MITRE = 0.2
# How far off may strokes that stay have edges in common with those that move?
_NEAR = 2.5
# Where between its joint and where it stands alone may a stroke bend? With 0.15 and 1 some end in a hook.
_BEND = (0.3, 0.7)
# When has it settled?
_SETTLED = 1e-3
_ROUNDS = 20


@dataclass(frozen=True, eq=False)
class Between:
    """A stroke between two joints (by their places in the list), which bends towards a point (2,)."""

    start: int
    end: int
    bend: FloatArray
    half_px: float


@dataclass(frozen=True, eq=False)
class Outward:
    """A stroke from a joint to where it stands alone: a place (2,), and its direction there."""

    joint: int
    to: FloatArray
    direction: FloatArray
    half_px: float


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
    """Joints (n, 2), some of them `corners`, with their strokes, and strokes near by that stay."""

    joints: FloatArray
    corners: list[int]
    between: list[Between]
    outward: list[Outward]
    still: list[Still]
    width_px: float

    @cached_property
    def drawn(self) -> FloatArray:
        """Points (n, 2) along the strokes that move, as they are."""
        return np.concatenate(parabola_shares(_STEPS) @ self._controls)

    @cached_property
    def near(self) -> list[Still]:
        """What stays, as far as it may have edges in common with that."""
        from scipy.spatial import cKDTree

        tree = cKDTree(self.drawn)
        parts = []
        for still in self.still:
            reached = tree.query(still.points, distance_upper_bound=_NEAR * self.width_px)[0] < np.inf
            bounds = [0, *(np.flatnonzero(np.diff(reached)) + 1), len(reached)]
            runs = [(first, last) for first, last in pairwise(bounds) if reached[first] and last - first > 1]
            parts += [still.part(*run) for run in runs]
        return parts

    def settled(self, edge: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """The joints (n, 2) and bends (m, 2), between and outward, with which edges (k, 2) fit best.

        By trust regions (scipy's); what is off by much counts as itself, not as its square.
        """
        from scipy.optimize import least_squares

        sides, held = self._sides(), _HELD * np.eye(self._count)
        free = np.full(2 * (len(self.joints) + len(self.between)), _FARTHEST)
        far = np.array([np.linalg.norm(out.to - self.joints[out.joint]) for out in self.outward])
        low, high = ((share - 0.5) * far / self.width_px for share in _BEND)
        x = least_squares(
            lambda x: np.concatenate([self._off(x, sides, edge)[0], held @ x]),
            np.zeros(self._count),
            lambda x: np.concatenate([self._off(x, sides, edge)[1], held]),
            bounds=(np.concatenate([-free, low]), np.concatenate([free, high])),
            loss="soft_l1",
            f_scale=_DOUBTED,
            ftol=_SETTLED,
            xtol=_SETTLED,
            max_nfev=_ROUNDS,
        ).x
        joints = self.joints + self.width_px * x[: self.joints.size].reshape(-1, 2)
        bends = self._controls[:, 1] + self._moves[:, 1] @ x
        return joints, bends[: len(self.between)], bends[len(self.between) :]

    @property
    def _count(self) -> int:
        """How many numbers move: x and y of joints and bends between, and how far bends outward are."""
        return 2 * (len(self.joints) + len(self.between)) + len(self.outward)

    @cached_property
    def _controls(self) -> FloatArray:
        """Start, bend and end (s, 3, 2) of each stroke that moves."""
        between = [(self.joints[each.start], each.bend, self.joints[each.end]) for each in self.between]
        outward = []
        for out in self.outward:
            start = self.joints[out.joint]
            outward.append((start, out.to - np.linalg.norm(out.to - start) / 2 * out.direction, out.to))
        return np.array([*between, *outward]).reshape(-1, 3, 2)

    @property
    def _halves(self) -> list[float]:
        """Half the width of each stroke that moves."""
        return [each.half_px for each in self.between] + [each.half_px for each in self.outward]

    @cached_property
    def _moves(self) -> FloatArray:
        """How those change (s, 3, 2, x) with what moves, which is in stroke widths."""
        moves = np.zeros((len(self._controls), 3, 2, self._count))
        for k, each in enumerate(self.between):
            for part, moving in enumerate((each.start, len(self.joints) + k, each.end)):
                moves[k, part, [0, 1], [2 * moving, 2 * moving + 1]] = self.width_px
        for k, out in enumerate(self.outward, len(self.between)):
            moves[k, 0, [0, 1], [2 * out.joint, 2 * out.joint + 1]] = self.width_px
            moves[k, 1, :, self._count - len(self._controls) + k] = -self.width_px * out.direction
        return moves

    def _sides(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """The sides (n, 2, 2) of all strokes, how these change (n, 2, 2, x), and half their widths (n,)."""
        shares = parabola_shares(_STEPS)
        lines = [*(shares @ self._controls), *(part.points for part in self.near)]
        moves = [*np.einsum("tp,spkx->stkx", shares, self._moves)]
        moves += [np.zeros((len(part.points), 2, self._count)) for part in self.near]
        halves = [np.full(_STEPS, half) for half in self._halves]
        halves += [part.halves[1:] for part in self.near]
        return (
            np.concatenate([np.stack([line[:-1], line[1:]], axis=1) for line in lines]),
            np.concatenate([np.stack([move[:-1], move[1:]], axis=1) for move in moves]),
            np.concatenate(halves),
        )

    def _off(
        self, x: FloatArray, sides: tuple[FloatArray, FloatArray, FloatArray], edge: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """How far outside (n,) of the strokes edges lie, in widths, and how that changes (n, x)."""
        places, moves, halves = sides
        placed = places + moves @ x
        side, share, gap = nearest_of_all(placed[:, 0], placed[:, 1] - placed[:, 0], edge)
        distance = np.linalg.norm(gap, axis=1)
        off = (distance - halves[side]) / self.width_px
        weight = np.ones(len(off))
        for corner in self.corners:
            at = self.joints[corner] + self.width_px * x[2 * corner : 2 * corner + 2]
            nearest = np.abs(np.linalg.norm(edge - at, axis=1) - distance) < 1e-6
            weight[nearest & (off > 0)] = _MITRE
        away = gap / np.maximum(distance, 1e-9)[:, None]
        shares = np.column_stack([1 - share, share])
        change = -np.einsum("nk,ne,nekx->nx", away, shares, moves[side], optimize=True) / self.width_px
        return weight * off, weight[:, None] * change
