"""The taut wire: the shortest path that goes round the obstacles the same way as the drawn one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from shapely.geometry.base import BaseGeometry

from wrapit.geometry import FloatArray
from wrapit.jig.taut.belt import belt
from wrapit.jig.taut.funnel import Bend, shortest
from wrapit.jig.taut.sleeve import Walker, cyclic
from wrapit.jig.taut.triangles import OUTSIDE, Triangles

# Where a drawn path runs into an obstacle, or along its side, this much on both sides of the path is free all
# the same: sampling takes paths up to 0.05 mm into walls. No hand follows a jig to a hundred times that.
HAIR_MM = 1e-3
# Points of a path are moved by this much, each in its own direction, so that none lies on a triangle's side
# and no stretch along one: a ten-thousandth of the hair, a million times what doubles lose at 100 mm.
JOG_MM = 1e-7
# Each is turned by the golden angle from the one before, so that neighbours never move alike.
JOG_TURN_RAD = np.pi * (3 - np.sqrt(5))
# Ground around everything: a taut wire never leaves the convex hull of obstacles and path, so any will do. In
# 150 random fields none, this, and a quarter of the field's size gave the same lengths in the same time.
MARGIN_MM = 1.0


@dataclass(frozen=True, eq=False)
class FreeGround:
    """The plane less the obstacles, cut into triangles once for all the paths that were given to `around`."""

    triangles: Triangles
    walker: Walker

    @classmethod
    def around(
        cls, obstacles: BaseGeometry, paths: Sequence[FloatArray], closed: Sequence[bool] | None = None
    ) -> FreeGround:
        """`obstacles`: polygons, mm, already grown by the wire's radius.

        They give way by a hair to `paths`, (n, 2) each, and to the stretch that closes those that are
        `closed` (none by default), whether they repeat their first point or not.

        Raises `ValueError` where `closed` says of fewer or more paths than there are.
        """
        rings = [False] * len(paths) if closed is None else closed
        drawn = [_whole(path, ring) for path, ring in zip(paths, rings, strict=True)]
        hairs = shapely.buffer([_line(path) for path in drawn], HAIR_MM, quad_segs=2)
        everything = shapely.GeometryCollection([obstacles, *hairs])
        x0, y0, x1, y1 = everything.bounds
        box = shapely.box(x0 - MARGIN_MM, y0 - MARGIN_MM, x1 + MARGIN_MM, y1 + MARGIN_MM)
        solid = shapely.union_all(shapely.get_parts(obstacles))
        shapely.prepare(solid)
        free = box.difference(solid.difference(shapely.union_all(hairs[shapely.intersects(solid, hairs)])))
        triangles = Triangles.of(free)
        return cls(triangles, Walker.over(triangles))

    def pulled(self, path: FloatArray, closed: bool = False) -> FloatArray:
        """`path` (n, 2), pulled taut: the shortest path (m, 2) homotopic to it, in mm.

        Its ends stay; every other point is a corner of an obstacle. Where `closed`, the path's end joins its
        start (given twice or not) and nothing is held but by obstacles: the shortest loop, its last point the
        first again, where it passes the path's own start; a single point (1, 2) if no obstacle holds it.

        Raises `ValueError` where the path leaves the ground, which one that was given to `around`, as closed
        if it is, never does.
        """
        whole = _whole(path, closed)
        jogged = _jogged(whole, closed)
        first = self.triangles.holding(jogged[0])
        if first == OUTSIDE:
            raise ValueError(f"the path starts outside of the free ground, at {whole[0]} mm")
        passed = self.walker.walk(first, jogged)
        if closed:
            loop = cyclic(passed)
            return belt(self.walker, loop) if len(loop) > 1 else whole[:1]
        # From end to end as moved: those lie inside of their triangles, the drawn ones perhaps on a side.
        # A funnel that starts on its portal opens by half a turn and would take a corner for no need.
        (ax, ay), (bx, by) = jogged[0].tolist(), jogged[-1].tolist()
        portals = self.walker.portals(passed)
        bends = shortest(Bend(ax, ay), Bend(bx, by), portals, self.walker.xs, self.walker.ys)
        inner = [(bend.x, bend.y) for bend in bends[1:-1]]
        return np.array([whole[0], *inner, whole[-1]])


def _whole(path: FloatArray, closed: bool) -> FloatArray:
    """The path; a closed one with its first point last, whether it was given twice or not."""
    points = np.asarray(path, dtype=float)
    if closed and not np.array_equal(points[0], points[-1]):
        return np.concatenate([points, points[:1]])
    return points


def _line(path: FloatArray) -> BaseGeometry:
    """A path as a line, one that closes or not; of a single point too."""
    return shapely.LineString(path) if len(path) > 1 else shapely.Point(path[0])


def _jogged(path: FloatArray, closed: bool) -> FloatArray:
    """The path with each point moved a little; a closed one ends where it starts."""
    turned = JOG_TURN_RAD * np.arange(len(path))
    moved = path + JOG_MM * np.column_stack([np.cos(turned), np.sin(turned)])
    if closed:
        moved[-1] = moved[0]
    return moved
