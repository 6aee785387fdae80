"""Random drawings that wire can't follow as they are, for the tests: by kind, seed and size.

Beside the bench's families (what people draw) there are the kinds that a fit is about: rungs too close,
combs of stubs, double outlines, tips, narrow fingers and lenses, whole nets, and mirrored figures.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable
from functools import cache
from typing import Any, Final

import numpy as np

from tests.bench.families import CORNERED, FAMILIES
from tests.drawing.generated import Points
from wrapit.config import Config
from wrapit.drawing.assembly import assemble, placement
from wrapit.drawing.components import connect
from wrapit.drawing.model import Drawing, Junction, Segment
from wrapit.drawing.svg.planar import Curve, planar
from wrapit.geometry import BezierChain, FloatArray

Lines = list[Points]
Rng = np.random.Generator

# A sheet turned by right angles, and turned over.
IMAGES = tuple(
    np.diag(signs) @ axes
    for axes in (np.eye(2), np.eye(2)[::-1])
    for signs in itertools.product((1.0, -1.0), repeat=2)
)

# A pixel of the lines is so much of the drawing: ends this near to a line are joined to it.
REACH_SHARE = 2e-3


def _ladder(rng: Rng, size_mm: float) -> Lines:
    """Two rails, and rungs 0.5 to 4 mm apart."""
    width, at = rng.uniform(4, 12), np.cumsum(rng.uniform(0.5, 4, int(rng.integers(4, 14)))) + 6
    bow = rng.uniform(-4, 4)
    rails = [
        np.array([[0, y], [size_mm / 2, y + bow], [size_mm, y]], dtype=float) for y in (-width / 2, width / 2)
    ]
    tall = width / 2 + abs(bow) + 1
    return [*rails, *(np.array([[x, -tall], [x, tall]]) for x in at)]


def _comb(rng: Rng, size_mm: float) -> Lines:
    """A back with teeth of 0.5 to 7 mm."""
    teeth = int(rng.integers(3, 12))
    at = (np.arange(teeth) + rng.uniform(0.6, 1.4)) * size_mm / (teeth + 2)
    back = np.array([[0.0, 0.0], [size_mm, 0.0]])
    return [back, *(np.array([[x, 0], [x + rng.normal(), sign * rng.uniform(0.5, 7)]]) for x, sign in
                    zip(at, rng.choice([-1, 1], teeth), strict=True))]  # fmt: skip


def _lens(rng: Rng, size_mm: float) -> Lines:
    """Bows over one chord, 0.3 to 3 mm higher each, with a line through their tips."""
    x = np.linspace(0, 1, 13)
    heights = np.cumsum(rng.uniform(0.3, 3, int(rng.integers(2, 5)))) - rng.uniform(0, 3)
    tail = np.array([[0.8 * size_mm, 0.0], [size_mm, rng.uniform(-4, 4)]])
    return [*(np.column_stack([0.8 * size_mm * x, 4 * h * x * (1 - x)]) for h in heights), tail]


def _double(rng: Rng, size_mm: float) -> Lines:
    """An outline drawn twice, 0.6 to 1.8 mm apart, with two ties."""
    angle, apart = np.linspace(0, 2 * math.pi, 49), rng.uniform(0.6, 1.8)
    waves, phase = int(rng.integers(2, 5)), rng.uniform(0, 6)
    ratio = rng.uniform(0.6, 1.0)
    ring = np.column_stack([np.cos(angle), ratio * np.sin(angle)])
    outer = (size_mm / 2 * (0.8 + 0.15 * np.cos(waves * angle + phase)))[:, None] * ring
    ends = rng.choice(48, 2, replace=False)
    inner = outer - apart * ring / np.hypot(*ring.T)[:, None]
    return [outer, inner, *(np.array([1.02 * outer[n], 0.9 * inner[n]]) for n in ends)]


def _finger(rng: Rng, size_mm: float) -> Lines:
    """A palm with fingers of 0.8 to 4 mm."""
    count = int(rng.integers(2, 6))
    step, line = size_mm / count, [np.array([0.0, 0.0])]
    for n in range(count):
        wide, tall, x = rng.uniform(0.8, 4), rng.uniform(6, size_mm / 2), (n + 0.5) * step
        line += [np.array(p) for p in ((x - wide / 2, 0.0), (x - wide / 2, tall), (x, tall + wide / 2),
                                       (x + wide / 2, tall), (x + wide / 2, 0.0))]  # fmt: skip
    line += [
        np.array(p) for p in ((size_mm, 0.0), (size_mm, -0.3 * size_mm), (0.0, -0.3 * size_mm), (0.0, 0.0))
    ]
    return [np.array(line)]


def _tips(rng: Rng, _: float) -> Lines:
    """A zigzag whose tips have 10 to 170 degrees."""
    at, heading, line = np.zeros(2), 0.0, [np.zeros(2)]
    for n in range(int(rng.integers(3, 9))):
        heading = (1 if n % 2 else -1) * (math.pi - math.radians(rng.uniform(10, 170))) / 2
        at = at + rng.uniform(3, 15) * np.array([math.cos(heading), math.sin(heading)])
        line.append(at)
    return [np.array(line)]


def _net(rng: Rng, size_mm: float) -> Lines:
    """Some of the edges of a Delaunay triangulation, bowed by less than would make them cross."""
    from scipy.spatial import Delaunay

    places = rng.uniform(0, size_mm, (int(rng.integers(6, 18)), 2))
    triangles = Delaunay(places).simplices
    edges = sorted({tuple(sorted(map(int, e))) for t in triangles for e in itertools.combinations(t, 2)})
    lines = []
    for a, b in edges:
        if rng.random() > 0.65:
            continue
        step = places[b] - places[a]
        bow = rng.uniform(-0.12, 0.12) * np.array([-step[1], step[0]])
        lines.append(np.array([places[a], (places[a] + places[b]) / 2 + bow, places[b]]))
    return lines or [places[:2]]


def _grate(rng: Rng, _: float) -> Lines:
    """Bars both ways, 0.7 to 8 mm apart."""
    bars = [np.cumsum(rng.uniform(0.7, 8, int(rng.integers(2, 5)))) for _ in range(2)]
    ends = [max(each[-1] for each in bars) + 5, -5.0]
    return [
        *(np.array([[x, ends[1]], [x, ends[0]]]) for x in bars[0]),
        *(np.array([[ends[1], y], [ends[0], y]]) for y in bars[1]),
    ]


MADE: Final[dict[str, Callable[[Rng, float], Lines]]] = {
    "comb": _comb, "double": _double, "finger": _finger, "grate": _grate, "ladder": _ladder, "lens": _lens,
    "net": _net, "tips": _tips,
}  # fmt: skip
_STRAIGHT: Final = CORNERED | {"comb", "finger", "grate", "tips"}
KINDS: Final = (*sorted(FAMILIES), *sorted(MADE))


@cache
def drawn(kind: str, seed: int, size_mm: float, *, twin: bool = False) -> Drawing:
    """A drawing of a kind, its longest side so long; `twin`: joined to its own mirror image (x to -x)."""
    rng = np.random.default_rng([seed, KINDS.index(kind)])
    lines = MADE[kind](rng, size_mm) if kind in MADE else FAMILIES[kind](rng)
    if twin:
        # A few mm overlap, so that both halves are one.
        least = min(float(line[:, 0].min()) for line in lines)
        lines = [line - (least + rng.uniform(0.02, 0.2) * size_mm, 0.0) for line in lines]
        lines += [line * (-1, 1) for line in lines]
    return traced(lines, size_mm, straight=kind in _STRAIGHT)


def traced(lines: Lines, size_mm: float, *, straight: bool) -> Drawing:
    """Lines as an SVG's are read: cut where they cross, the largest connected part of them."""
    every = np.concatenate(lines)
    scale = 1000 / float(np.ptp(every, axis=0).max())
    curves = [Curve(_cubics(scale * line, straight), bool(np.allclose(line[0], line[-1]))) for line in lines]
    graph = planar(curves, REACH_SHARE * 1000, math.radians(60))
    one = connect(graph.places, graph.pieces, "largest", 0.0)
    place = placement([piece.curve for piece in one.pieces], size_mm, flip=False)
    return assemble(one.places, one.pieces, place, width=None, changes=[], pixel_frame=False)


def _cubics(line: Points, straight: bool) -> FloatArray:
    """Cubics (n, 4, 2) through the points, straight or each tangent along the chord of its neighbours."""
    if straight:
        return np.stack([(line[:-1] * (3 - k) + line[1:] * k) / 3 for k in range(4)], axis=1)
    closed = bool(np.allclose(line[0], line[-1]))
    padded = np.concatenate([[line[-2] if closed else line[0]], line, [line[1] if closed else line[-1]]])
    tangent = (padded[2:] - padded[:-2]) / 6
    cubics = np.stack([line[:-1], line[:-1] + tangent[:-1], line[1:] - tangent[1:], line[1:]], axis=1)
    if closed:
        cubics[-1, 3] = cubics[0, 0]
    return cubics


def config(level: str, gauge: int, **more: Any) -> Config:
    """A config that makes drawings fit for wire of a gauge (AWG)."""
    return Config.model_validate({"drawing": "x", "fit": level, "wire": {"gauge": f"{gauge} AWG"}, **more})


def mapped(drawing: Drawing, matrix: FloatArray) -> Drawing:
    """The drawing under a linear map, its parts numbered in another order, as if it had been read anew."""
    order = list(reversed(range(len(drawing.segments))))
    places = list(reversed(range(len(drawing.junctions))))
    at = {old: new for new, old in enumerate(places)}
    moved = [drawing.junctions[old].point @ matrix for old in places]
    segments = []
    for new, old in enumerate(order):
        segment = drawing.segments[old]
        points = segment.curve.points @ matrix
        points[0, 0], points[-1, 3] = moved[at[segment.start]], moved[at[segment.end]]
        curve, ends = BezierChain(points), (at[segment.start], at[segment.end])
        if old % 2:
            curve, ends = curve.reversed(), ends[::-1]
        segments.append(Segment(new, *ends, curve))
    return Drawing(tuple(Junction(n, point) for n, point in enumerate(moved)), tuple(segments))


def places_of(drawing: Drawing, step_mm: float = 0.02) -> FloatArray:
    """Places along all lines, (n, 2)."""
    return np.concatenate([segment.curve.sampled(step_mm) for segment in drawing.segments])


def apart_mm(one: Drawing, other: Drawing) -> float:
    """How far the two drawings' lines lie apart at most (Hausdorff)."""
    from scipy.spatial import cKDTree

    a, b = places_of(one), places_of(other)
    return float(max(cKDTree(a).query(b)[0].max(), cKDTree(b).query(a)[0].max()))


def moved(drawing: Drawing, by: FloatArray) -> Drawing:
    """The drawing somewhere else."""
    junctions = tuple(Junction(j.id, j.point + by) for j in drawing.junctions)
    segments = tuple(
        Segment(s.id, s.start, s.end, BezierChain(s.curve.points + by)) for s in drawing.segments
    )
    return Drawing(junctions, segments)


def looks_the_same(drawing: Drawing) -> bool:
    """Whether a drawing has a symmetry of its own, within what is certain of places."""
    low, high = drawing.bounds_mm
    centred = moved(drawing, -(low + high) / 2)
    return any(apart_mm(centred, mapped(centred, matrix)) < 1e-3 for matrix in IMAGES[1:])
