"""Joints and corners whose strokes, drawn again, don't have the ink's edges: moved until they do."""

from __future__ import annotations

from collections.abc import Collection, Mapping

import numpy as np

from wrapit.drawing.bitmap.centre_lines import Line
from wrapit.drawing.bitmap.curves import fitted
from wrapit.drawing.bitmap.ends.rings import Ends
from wrapit.drawing.bitmap.ink import Ink
from wrapit.drawing.bitmap.mending.crowd import crowd_at
from wrapit.drawing.bitmap.mending.ink_edges import FINE, contour, half_widths, near, off, rms
from wrapit.drawing.bitmap.mending.web import Still
from wrapit.drawing.bitmap.strand_graph import StrandGraph
from wrapit.geometry import BezierChain, FloatArray
from wrapit.geometry.arrays import median

# In stroke widths.
# How far around a joint are edges looked at, and how many are enough to tell?
_AROUND = 1.3
_FEWEST = 12
# When do edges lie elsewhere? With their root mean square above this: good joints miss by 0.02 to 0.03. With
# 0.04 one of 402 icons more is right, and one of 26 thresholded drawings less.
_OFF = 0.05
# When do they fit? With less than this, and less than a share of what it was. With 0.6 instead of 0.75 three
# of 402 icons fewer are right, with 0.04 and 0.5 eight, with 0.03 nine; 0.055 leaves a hook in a horse's ear.
_FIT = 0.05
_LEFT = 0.75
# How many standard deviations is the median of what is off?
_DEVIATION = 1.48
# How much of what ends alone, and is round or flat there, is left out? A cap and what joins it.
_CAP = 0.8


def mended(
    graph: StrandGraph,
    lines: dict[int, Line],
    endings: Ends,
    kept: Collection[int],
    ink: Ink,
    width_px: float,
    tolerance: float,
) -> dict[int, BezierChain]:
    """The curve of each strand; joints are moved, and lines and endings renewed, where that fits better.

    Nodes that are `kept` stay where they are.
    """
    curves = fitted(graph, lines, endings, graph.strands, width_px, tolerance)
    drawn = _drawn(curves, lines, width_px)
    edge = _edge(graph, ink, width_px)
    done = set(kept)
    for node in _doubtful(graph, lines, drawn, edge, width_px):
        crowd = None if node in done else crowd_at(graph, lines, drawn, endings, node, kept, width_px)
        if crowd is None:
            continue
        done |= set(crowd.nodes)
        seen = crowd.seen(edge)
        moved = crowd.moved(graph, seen) if len(seen) >= _FEWEST else None
        if moved is None:
            continue
        was = {n: graph.nodes[n] for n in crowd.nodes}
        graph.nodes.update(moved.places)
        new = fitted(graph, lines | moved.lines, endings | moved.endings, crowd.strands, width_px, tolerance)
        tried = _drawn(new, lines | moved.lines, width_px)
        before, after = (
            _missed(seen, [*(some[strand] for strand in crowd.strands), *crowd.web.near], width_px)
            for some in (drawn, tried)
        )
        if rms(after) < min(_FIT, _LEFT * rms(before)):
            curves |= new
            drawn |= tried
            lines |= moved.lines
            endings |= moved.endings
        else:
            graph.nodes.update(was)
    return curves


def _drawn(curves: Mapping[int, BezierChain], lines: Mapping[int, Line], width_px: float) -> dict[int, Still]:
    """Each strand's stroke as it is now."""
    points = {strand: curve.sampled(FINE * width_px) for strand, curve in curves.items()}
    return {k: Still(each, half_widths(lines[k], len(each), width_px)) for k, each in points.items()}


def _missed(edge: FloatArray, strokes: Collection[Still], width_px: float) -> FloatArray:
    """How far outside (n,) of the ink of strokes edges lie, in stroke widths."""
    points = np.concatenate([stroke.points for stroke in strokes])
    return off(edge, points, np.concatenate([stroke.halves for stroke in strokes])) / width_px


def _unevenness(lines: Mapping[int, Line], width_px: float) -> float:
    """How much the widths of strokes differ along each, in stroke widths, as a standard deviation."""
    apart = [np.zeros(0)]
    for line in lines.values():
        known = line.width[line.clean & np.isfinite(line.width)]
        if len(known):
            apart.append(np.abs(known - median(known)))
    every = np.concatenate(apart)
    return _DEVIATION * median(every) / width_px if len(every) else 0.0


def _edge(graph: StrandGraph, ink: Ink, width_px: float) -> FloatArray:
    """The ink's edge (n, 2), but for the ends of what ends alone."""
    edge = contour(ink)
    free = [place for node, place in graph.nodes.items() if graph.degree(node) == 1]
    return edge[~near(edge, np.array(free), _CAP * width_px)] if free and len(edge) else edge


def _doubtful(
    graph: StrandGraph,
    lines: Mapping[int, Line],
    drawn: Mapping[int, Still],
    edge: FloatArray,
    width_px: float,
) -> list[int]:
    """The joints and corners around which curves don't have the ink's edges, the worst first."""
    from scipy.spatial import cKDTree

    nodes = [node for node in graph.nodes if graph.degree(node) > 1 and not graph.is_seam(node)]
    if not nodes or not len(edge):
        return []
    places = np.array([graph.nodes[node] for node in nodes])
    beside = edge[near(edge, places, _AROUND * width_px)]
    if not len(beside):
        return []
    missed = _missed(beside, drawn.values(), width_px)
    most = max(_OFF, _unevenness(lines, width_px))
    found = []
    for node, around in zip(nodes, cKDTree(beside).query_ball_point(places, _AROUND * width_px), strict=True):
        if len(around) >= _FEWEST and (bad := rms(missed[around])) > most:
            found.append((-bad, node))
    return [node for _, node in sorted(found)]
