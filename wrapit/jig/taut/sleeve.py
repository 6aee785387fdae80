"""The sleeve of a path: which triangles it passes, in order, with every step that it takes back left out."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

from wrapit.geometry import FloatArray
from wrapit.jig.taut.triangles import OUTSIDE, Triangles

Row = tuple[int, int, int]
# Of a side a, b, c with a x + b y + c >= 0 on the triangle's side of it.
Line = tuple[float, float, float]


@dataclass(frozen=True)
class Portal:
    """A side that a path crosses: the points (numbers of `Triangles.points`) on its left and on its right."""

    left: int
    right: int


@dataclass(frozen=True, eq=False)
class Walker:
    """`Triangles` as plain numbers: a walk takes one step at a time, where arrays are slow."""

    xs: list[float]
    ys: list[float]
    corners: list[Row]
    neighbours: list[Row]
    sides: list[tuple[Line, Line, Line]]

    @classmethod
    def over(cls, triangles: Triangles) -> Walker:
        """For walks over `triangles`."""
        start = triangles.points[triangles.corners]
        along = start[:, [1, 2, 0]] - start
        a, b = -along[..., 1], along[..., 0]
        c = -(a * start[..., 0] + b * start[..., 1])
        rows = zip(a.tolist(), b.tolist(), c.tolist(), strict=True)
        return cls(
            triangles.points[:, 0].tolist(),
            triangles.points[:, 1].tolist(),
            [(i, j, k) for i, j, k in triangles.corners.tolist()],
            [(i, j, k) for i, j, k in triangles.neighbours.tolist()],
            [((p[0], q[0], r[0]), (p[1], q[1], r[1]), (p[2], q[2], r[2])) for p, q, r in rows],
        )

    def walk(self, first: int, path: FloatArray) -> list[int]:
        """The triangles along `path` (n, 2) from `first`, which holds its first point, without steps undone.

        Raises `ValueError` where the path leaves the ground.
        """
        passed = [first]
        here = first
        points = path.tolist()
        for (ax, ay), (bx, by) in pairwise(points):
            while True:
                (a0, b0, c0), (a1, b1, c1), (a2, b2, c2) = self.sides[here]
                if (
                    a0 * bx + b0 * by + c0 >= 0
                    and a1 * bx + b1 * by + c1 >= 0
                    and a2 * bx + b2 * by + c2 >= 0
                ):
                    break
                beyond = self._beyond(here, ax, ay, bx - ax, by - ay)
                if beyond == OUTSIDE:
                    raise ValueError(f"the path leaves the free ground near ({ax:.3f}, {ay:.3f}) mm")
                here = beyond
                if len(passed) > 1 and passed[-2] == here:
                    passed.pop()
                else:
                    passed.append(here)
        return passed

    def _beyond(self, here: int, ax: float, ay: float, dx: float, dy: float) -> int:
        """The triangle that a ray from (ax, ay) in `here` enters next.

        It leaves by the side from a corner on its right to one on its left.
        """
        i, j, k = self.corners[here]
        left_i = dx * (self.ys[i] - ay) >= dy * (self.xs[i] - ax)
        left_j = dx * (self.ys[j] - ay) >= dy * (self.xs[j] - ax)
        left_k = dx * (self.ys[k] - ay) >= dy * (self.xs[k] - ax)
        if left_j and not left_i:
            return self.neighbours[here][0]
        if left_k and not left_j:
            return self.neighbours[here][1]
        if left_i and not left_k:
            return self.neighbours[here][2]
        raise ValueError(f"rounding lost the path near ({ax:.3f}, {ay:.3f}) mm")

    def portals(self, passed: list[int]) -> list[Portal]:
        """What lies between one triangle and the next."""
        found = []
        for here, there in pairwise(passed):
            side = self.neighbours[here].index(there)
            right, left = self.corners[here][side], self.corners[here][(side + 1) % 3]
            found.append(Portal(left, right))
        return found


def cyclic(passed: list[int]) -> list[int]:
    """A closed walk (first triangle = last) without the way out to a loop and the same way back."""
    way = 0
    while len(passed) - 2 * way > 2 and passed[way + 1] == passed[-way - 2]:
        way += 1
    return passed[way : len(passed) - way]
