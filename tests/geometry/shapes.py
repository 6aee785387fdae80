"""Random shapes and rigid motions, and answers found by brute force."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass

import numpy as np
from hypothesis import strategies as st

from wrapit.geometry import BezierChain, FloatArray
from wrapit.geometry.bezier import derivative, split

coordinates = st.floats(-20, 20, allow_subnormal=False).map(lambda value: round(value, 3))
points = st.tuples(coordinates, coordinates)


@dataclass(frozen=True)
class Motion:
    """A turn about the origin and a shift, mirrored first if `flip` is -1."""

    angle: float
    shift: tuple[float, float]
    flip: float = 1.0

    @property
    def matrix(self) -> FloatArray:
        cos, sin = math.cos(self.angle), math.sin(self.angle)
        return np.array([[cos, -sin], [sin, cos]]) @ np.diag([1.0, self.flip])

    def of(self, xy: FloatArray) -> FloatArray:
        return xy @ self.matrix.T + np.array(self.shift)


motions = st.builds(Motion, st.floats(-4, 4), points)
mirrorings = st.builds(Motion, st.floats(-4, 4), points, st.just(-1.0))


@st.composite
def tame_cubics(draw: st.DrawFn) -> FloatArray:
    """One cubic (4, 2) without cusps: it turns by less than a right angle to either side of its chord."""
    x, y = draw(points)
    length, heading = draw(st.floats(1, 20)), draw(st.floats(-math.pi, math.pi))
    first, last = draw(st.floats(-1.2, 1.2)), draw(st.floats(-1.2, 1.2))
    near, far = draw(st.floats(0.15, 0.45)), draw(st.floats(0.15, 0.45))
    local = np.array(
        [
            (0.0, 0.0),
            (near * math.cos(first), near * math.sin(first)),
            (1 - far * math.cos(last), far * math.sin(last)),
            (1.0, 0.0),
        ]
    )
    return Motion(heading, (x, y)).of(length * local)


@st.composite
def cubics_with_tips(draw: st.DrawFn, off: float = 0.02) -> FloatArray:
    """One cubic (4, 2) that comes to a stand inside, or all but does, and leaves to another side.

    B'(t) = 0 fixes the middle leg of its control polygon by the others; `off` moves it a little.
    """
    t, heading = draw(st.floats(0.3, 0.7)), draw(st.floats(-math.pi, math.pi))
    # Sides of a tip part by what both legs differ in direction.
    between = draw(st.floats(0.5, 2.6)) * draw(st.sampled_from([-1, 1]))
    out = draw(st.floats(10, 40)) * np.array([1.0, 0.0])
    back = draw(st.floats(10, 40)) * np.array([math.cos(between), math.sin(between)])
    middle = -((1 - t) ** 2 * out + t**2 * back) / (2 * t * (1 - t))
    middle = middle + off * np.array([draw(st.floats(-1, 1)), draw(st.floats(-1, 1))])
    return Motion(heading, draw(points)).of(np.cumsum([np.zeros(2), out, middle, back], axis=0))


@st.composite
def tame_chains(draw: st.DrawFn) -> BezierChain:
    """Up to four tame cubics, each from where the one before ends, mostly with a corner there."""
    cubics = [draw(tame_cubics())]
    for cubic in draw(st.lists(tame_cubics(), max_size=3)):
        moved = cubic - cubic[0] + cubics[-1][3]
        moved[0] = cubics[-1][3]
        cubics.append(moved)
    return BezierChain(np.array(cubics))


@st.composite
def smooth_chains(draw: st.DrawFn) -> BezierChain:
    """Up to four tame cubics with one tangent at each joint, but handles of different lengths."""
    chain = draw(tame_chains())
    cubics = chain.points.copy()
    for before, after in itertools.pairwise(cubics):
        arriving = before[3] - before[2]
        leaving = after[1] - after[0]
        turn = math.atan2(arriving[1], arriving[0]) - math.atan2(leaving[1], leaving[0])
        start = after[0].copy()
        after[:] = Motion(turn, (0.0, 0.0)).of(after - start) + before[3]
        after[0] = before[3]
    return BezierChain(cubics)


def finely_measured(chain: BezierChain) -> float:
    """Length by Gauss's rule on 256 parts of each cubic."""
    parts = chain.points
    for _ in range(8):
        parts = np.concatenate(split(parts, 0.5))
    nodes, weights = np.polynomial.legendre.leggauss(8)
    speed = np.linalg.norm(derivative(parts, (nodes + 1) / 2), axis=-1)
    return float((speed @ weights).sum() / 2)
