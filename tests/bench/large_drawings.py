"""Drawings of any number of segments, generated, as the text of a drawing file."""

from __future__ import annotations

import itertools
import json
import math
from collections.abc import Callable, Sequence
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from wrapit.drawing.json_file import FORMAT

Points: TypeAlias = NDArray[np.float64]
Edges: TypeAlias = Sequence[tuple[int, int]]

# How far a segment bulges to the side, as a share of its length: a line that a hand drew.
BULGE = 0.12


def cells(rng: np.random.Generator, segments: int) -> tuple[Points, Edges]:
    """A net of cells: three segments meet almost everywhere."""
    from scipy.spatial import Voronoi

    diagram = Voronoi(rng.uniform(0, 1, (segments // 2 + 12, 2)))
    inside = np.all((diagram.vertices > -0.3) & (diagram.vertices < 1.3), axis=1)
    edges = [(a, b) for a, b in diagram.ridge_vertices if a >= 0 and b >= 0 and inside[a] and inside[b]]
    return _middle(diagram.vertices, edges, segments)


def triangles(rng: np.random.Generator, segments: int) -> tuple[Points, Edges]:
    """A net of triangles: six segments meet, wires cross everywhere."""
    from scipy.spatial import Delaunay

    points = rng.uniform(0, 1, (max(8, segments // 3 + segments // 20 + 6), 2))
    found = Delaunay(points).simplices
    edges = sorted({(min(a, b), max(a, b)) for t in found.tolist() for a, b in itertools.combinations(t, 2)})
    return _middle(points, edges, segments)


def grid(rng: np.random.Generator, segments: int) -> tuple[Points, Edges]:
    """A grid, a little shaken."""
    side = math.ceil(math.sqrt(segments / 2)) + 2
    points = np.array(list(itertools.product(range(side), range(side))), dtype=float)
    points += rng.uniform(-0.15, 0.15, points.shape)
    edges = [(side * i + j, side * i + j + 1) for i in range(side) for j in range(side - 1)]
    edges += [(side * i + j, side * i + j + side) for i in range(side - 1) for j in range(side)]
    return _middle(points, edges, segments)


def spiral(rng: np.random.Generator, segments: int) -> tuple[Points, Edges]:
    """A spider's web: one long spiral across straight spokes."""
    spokes = 8
    turns = np.arange(segments // 2 + 2 + spokes) / spokes
    radius = np.sqrt(1 + turns) + rng.uniform(-0.02, 0.02, len(turns))
    angles = 2 * math.pi * turns
    points = np.column_stack([radius * np.cos(angles), radius * np.sin(angles)])
    around = list(itertools.pairwise(range(len(turns))))
    across = [(index, index + spokes) for index in range(len(turns) - spokes)]
    return points, sorted([*around, *across])[:segments]


def strands(rng: np.random.Generator, segments: int) -> tuple[Points, Edges]:
    """Short strokes side by side that touch nothing: each is a wire of its own."""
    side = math.ceil(math.sqrt(segments))
    places = np.array(list(itertools.product(range(side), range(side))), dtype=float)[:segments]
    angles = rng.uniform(0, 2 * math.pi, segments)
    way = 0.35 * np.column_stack([np.cos(angles), np.sin(angles)])
    return np.concatenate([places - way, places + way]), [(i, i + segments) for i in range(segments)]


KINDS: dict[str, Callable[[np.random.Generator, int], tuple[Points, Edges]]] = {
    "cells": cells,
    "triangles": triangles,
    "grid": grid,
    "spiral": spiral,
    "strands": strands,
}


def drawing_text(kind: str, segments: int, size_mm: float, *, beziers: int = 1, seed: int = 0) -> str:
    """A drawing of one kind with so many segments of so many Béziers each, as JSON."""
    rng = np.random.default_rng(seed)
    points, edges = KINDS[kind](rng, segments)
    used = sorted({end for edge in edges for end in edge})
    number = {old: new for new, old in enumerate(used)}
    points = points[used]
    points = (points - points.min(axis=0)) * size_mm / np.ptp(points, axis=0).max()
    bulges = rng.uniform(-BULGE, BULGE, len(edges))
    ends = [(number[a], number[b]) for a, b in edges]
    return json.dumps(
        {
            "format": FORMAT,
            "unit": "mm",
            "junctions": points.tolist(),
            "segments": [
                {"start": a, "end": b, "beziers": _arch(points[a], points[b], bulge, beziers).tolist()}
                for (a, b), bulge in zip(ends, bulges, strict=True)
            ],
        }
    )


def _arch(start: Points, end: Points, bulge: float, beziers: int) -> Points:
    """A flat parabola from one place to another as cubics (n, 4, 2)."""
    way = end - start
    top = (start + end) / 2 + 2 * bulge * np.array([-way[1], way[0]])
    t = np.linspace(0, 1, beziers + 1)[:, None]
    places = (1 - t) ** 2 * start + 2 * t * (1 - t) * top + t**2 * end
    places[[0, -1]] = start, end
    handles = ((1 - t) * (top - start) + t * (end - top)) * 2 / (3 * beziers)
    return np.stack([places[:-1], places[:-1] + handles[:-1], places[1:] - handles[1:], places[1:]], axis=1)


def _middle(points: Points, edges: Edges, segments: int) -> tuple[Points, Edges]:
    """The edges nearest the middle, so that the rest hangs together."""
    halves = np.array([(points[a] + points[b]) / 2 for a, b in edges])
    away = np.hypot(*(halves - halves.mean(axis=0)).T)
    return points, [edges[index] for index in np.argsort(away, kind="stable")[:segments]]
