"""Graphs of every size and kind, generated; no drawing needed.

`graph_text` writes one in the format of the reference program.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Sequence

import numpy as np

from wrapit.decomposition.graph import Graph


def random_multigraph(rng: np.random.Generator, segments: int, junctions: int) -> Graph:
    """Any multigraph at all: loops, parallel segments, cut junctions; tangents at random."""
    angles = rng.uniform(0, 2 * math.pi, 2 * segments)
    return Graph(
        tuple(rng.integers(junctions, size=2 * segments).tolist()),
        np.stack([np.cos(angles), np.sin(angles)], axis=1),
        tuple(rng.uniform(1, 20, segments).tolist()),
    )


def all_even(rng: np.random.Generator, segments: int, junctions: int) -> Graph:
    """A random closed walk: every junction has an even degree."""
    walk = rng.integers(junctions, size=segments).tolist()
    ends = [j for e in range(segments) for j in (walk[e], walk[(e + 1) % segments])]
    angles = rng.uniform(0, 2 * math.pi, 2 * segments)
    return Graph(
        tuple(ends), np.stack([np.cos(angles), np.sin(angles)], axis=1), tuple(rng.uniform(1, 20, segments))
    )


def closed_curves(rng: np.random.Generator, segments: int) -> Graph:
    """Smooth closed curves that cross one another: all junctions of degree 4, passed straight."""
    return _crossings(rng, segments, closed=True)


def strokes(rng: np.random.Generator, segments: int) -> Graph:
    """Open smooth strokes that cross one another, with dangling ends."""
    return _crossings(rng, segments, closed=False)


def voronoi(rng: np.random.Generator, segments: int) -> Graph:
    """Cells: degree 3 everywhere."""
    from scipy.spatial import Voronoi

    diagram = Voronoi(rng.uniform(0, 1, (segments // 2 + 12, 2)))
    inside = np.all((diagram.vertices > -0.3) & (diagram.vertices < 1.3), axis=1)
    edges = [(a, b) for a, b in diagram.ridge_vertices if a >= 0 and b >= 0 and inside[a] and inside[b]]
    return _straight(diagram.vertices, edges, segments)


def delaunay(rng: np.random.Generator, segments: int) -> Graph:
    """Triangles: degrees about 6 and above."""
    from scipy.spatial import Delaunay

    points = rng.uniform(0, 1, (max(5, segments // 3 + 3), 2))
    triangles = Delaunay(points).simplices
    edges = sorted({tuple(sorted((int(t[i]), int(t[i - 1])))) for t in triangles for i in range(3)})
    return _straight(points, edges, segments)


def cactus(rng: np.random.Generator, segments: int) -> Graph:
    """Rings and twigs that hang on one another at cut junctions, the hardest kind for robustness."""
    return flowers(rng, segments, None, 0.4)


def flowers(rng: np.random.Generator, segments: int, hubs: int | None, twigs: float) -> Graph:
    """A cactus on whose first `hubs` junctions everything hangs, on any junction if None; `twigs` is the
    share of blocks that are open."""
    ends: list[int] = []
    junctions = 1
    while len(ends) < 2 * segments:
        at = int(rng.integers(junctions if hubs is None else min(junctions, hubs)))
        size = int(rng.integers(1, 6))
        ring = [at, *range(junctions, junctions + size - 1)]
        junctions += size - 1
        if size > 1 and rng.random() < twigs:
            ends += [j for pair in itertools.pairwise(ring) for j in pair]
        else:
            ends += [j for pair in zip(ring, [*ring[1:], at], strict=True) for j in pair]
    ends = ends[: 2 * segments]
    angles = rng.uniform(0, 2 * math.pi, len(ends))
    return Graph(
        tuple(_renumbered(ends)),
        np.stack([np.cos(angles), np.sin(angles)], axis=1),
        tuple(rng.uniform(1, 20, len(ends) // 2)),
    )


def composed(rng: np.random.Generator, wires: int) -> tuple[Graph, list[set[int]]]:
    """A piece laid out of known smooth wires (as in the paper's Figure 5), and the segments of each.

    Each wire is a curve of low frequency; wires meet where they cross at 15° or more.
    """
    curves = [_wandering(rng) for _ in range(wires)]
    stops: list[list[tuple[float, int]]] = [[] for _ in curves]
    junctions = 0
    for i, first in enumerate(curves):
        for k, second in enumerate(curves[: i + 1]):
            for at, other in _meetings(first, second, same=i == k):
                stops[i].append((at, junctions))
                stops[k].append((other, junctions))
                junctions += 1
    ends: list[int] = []
    angles: list[float] = []
    lengths: list[float] = []
    truth: list[set[int]] = []
    for curve, crossings in zip(curves, stops, strict=True):
        way = [(0.0, junctions), *sorted(crossings), (len(curve) - 1.0, junctions + 1)]
        junctions += 2
        truth.append(set(range(len(lengths), len(lengths) + len(way) - 1)))
        for (at, j), (to, k) in itertools.pairwise(way):
            ends += [j, k]
            angles += [_heading(curve, at), _heading(curve, to) + math.pi]
            lengths.append((to - at) * 0.5)
    tangents = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    return Graph(tuple(ends), tangents, tuple(lengths)), truth


FAMILIES: dict[str, Callable[[np.random.Generator, int], Graph]] = {
    "closed curves": closed_curves,
    "strokes": strokes,
    "voronoi": voronoi,
    "delaunay": delaunay,
    "cactus": cactus,
}


def graph_text(graph: Graph) -> str:
    """`V E`, then V lines `x y` (unused: zeros), then E lines `u v tux tuy tvx tvy`."""
    lines = [f"{len(graph.incident)} {graph.segments}", *("0 0" for _ in graph.incident)]
    for e in range(graph.segments):
        u, v = graph.junction_of[2 * e], graph.junction_of[2 * e + 1]
        numbers = " ".join(f"{x:.17g}" for x in graph.tangents[2 * e : 2 * e + 2].ravel())
        lines.append(f"{u} {v} {numbers}")
    return "\n".join(lines) + "\n"


def _crossings(rng: np.random.Generator, segments: int, *, closed: bool) -> Graph:
    """Curves are random sequences of crossings; each crossing is passed twice, nearly straight."""
    crossings = max(1, segments // 2 if closed else round(segments / 2.3))
    passes = rng.permutation(np.repeat(np.arange(crossings), 2)).tolist()
    count = max(1, crossings // 8)
    cuts = sorted(
        rng.choice(np.arange(1, len(passes)), min(count - 1, len(passes) - 1), replace=False).tolist()
    )
    ends: list[int] = []
    angles: list[float] = []
    directions = [rng.uniform(0, 2 * math.pi) for _ in range(crossings)]
    seen = [0] * crossings
    fresh = crossings
    for first, last in zip([0, *cuts], [*cuts, len(passes)], strict=True):
        stops = passes[first:last]
        headings = []
        for stop in stops:
            headings.append(directions[stop] + seen[stop] * rng.uniform(0.6, 2.5))
            seen[stop] += 1
        hops = list(zip(range(len(stops)), [*range(1, len(stops)), 0], strict=True))
        if not closed:
            hops.pop()
            for index, out in ((0, math.pi), (-1, 0.0)):
                ends += [stops[index], fresh]
                angles += [headings[index] + out, rng.uniform(0, 2 * math.pi)]
                fresh += 1
        for i, k in hops:
            ends += [stops[i], stops[k]]
            angles += [headings[i] + rng.normal(0, 0.02), headings[k] + math.pi + rng.normal(0, 0.02)]
    return Graph(
        tuple(_renumbered(ends)),
        np.stack([np.cos(angles), np.sin(angles)], axis=1),
        tuple(rng.uniform(1, 20, len(ends) // 2).tolist()),
    )


def _straight(points: np.ndarray, edges: Sequence[tuple[int, int]], segments: int) -> Graph:
    """The segments nearest the middle, so that the rest stays in one piece."""
    middle = np.mean([(points[a] + points[b]) / 2 for a, b in edges], axis=0)
    ordered = sorted(
        edges, key=lambda edge: float(np.hypot(*((points[edge[0]] + points[edge[1]]) / 2 - middle)))
    )
    ends: list[int] = []
    angles: list[float] = []
    lengths: list[float] = []
    for a, b in ordered[:segments]:
        way = points[b] - points[a]
        angle = math.atan2(way[1], way[0])
        ends += [a, b]
        angles += [angle, angle + math.pi]
        lengths.append(float(np.hypot(*way)) * 40)
    return Graph(tuple(_renumbered(ends)), np.stack([np.cos(angles), np.sin(angles)], axis=1), tuple(lengths))


def _renumbered(ends: Sequence[int]) -> list[int]:
    number: dict[int, int] = {}
    return [number.setdefault(junction, len(number)) for junction in ends]


def _wandering(rng: np.random.Generator, count: int = 160) -> np.ndarray:
    t = np.linspace(0, 1, count)
    start, slope = rng.uniform(-1, 1, 2), rng.normal(0, 1.2, 2)
    waves = [
        rng.normal(0, 0.5 / k, 2) * np.sin(math.pi * k * t + rng.uniform(0, 6))[:, None] for k in (1, 2, 3)
    ]
    return start + slope * t[:, None] + sum(waves)


def _meetings(first: np.ndarray, second: np.ndarray, *, same: bool) -> list[tuple[float, float]]:
    """Parameters at which two polylines cross at 15° or more."""
    a, da = first[:-1, None], np.diff(first, axis=0)[:, None]
    b, db = second[None, :-1], np.diff(second, axis=0)[None]
    slope = da[..., 0] * db[..., 1] - da[..., 1] * db[..., 0]
    offset = b - a
    with np.errstate(divide="ignore", invalid="ignore"):
        s = (offset[..., 0] * db[..., 1] - offset[..., 1] * db[..., 0]) / slope
        t = (offset[..., 0] * da[..., 1] - offset[..., 1] * da[..., 0]) / slope
    steep = np.abs(slope) > math.sin(math.radians(15)) * np.hypot(da[..., 0], da[..., 1]) * np.hypot(
        db[..., 0], db[..., 1]
    )
    hits = (s >= 0) & (s < 1) & (t >= 0) & (t < 1) & steep
    if same:
        hits &= np.arange(len(hits))[:, None] > np.arange(hits.shape[1])[None] + 1
    return [(i + s[i, j], j + t[i, j]) for i, j in np.argwhere(hits).tolist()]


def _heading(curve: np.ndarray, at: float) -> float:
    index = min(int(at), len(curve) - 2)
    way = curve[index + 1] - curve[index]
    return math.atan2(way[1], way[0])
