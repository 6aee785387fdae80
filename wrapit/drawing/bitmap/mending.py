"""Nodes that were put where there is no ink, or beside it: put where the strokes, drawn again, are the ink."""

from __future__ import annotations

import numpy as np

from wrapit.drawing.bitmap.arms import Arm, arms_at, usual_width, widths_near
from wrapit.drawing.bitmap.centre_lines import Line, sample
from wrapit.drawing.bitmap.curves import fitted
from wrapit.drawing.bitmap.endings import Ending, bent_ending, passed
from wrapit.drawing.bitmap.ends.at_nodes import pairs_at
from wrapit.drawing.bitmap.ends.rings import Ends
from wrapit.drawing.bitmap.ink import Ink
from wrapit.drawing.bitmap.misfits import Misfit, misfits
from wrapit.drawing.bitmap.overlaps.redrawn import Surroundings, surroundings
from wrapit.drawing.bitmap.strand_graph import StrandGraph
from wrapit.geometry import BezierChain, FloatArray
from wrapit.geometry.polynomials import angle

# In stroke widths.
# How near is a node to what it is tried for?
_NEAR = 1.5
# By what steps is a better place looked for, from the first on?
_STEPS = (0.5, 0.25, 0.125, 0.0625)
# What share of what was missed may be left?
_LEFT = 0.5
# What does a lead that bends cost, in squared widths for each squared radian?
_BENT = 0.1


def mended(
    graph: StrandGraph, lines: dict[int, Line], endings: Ends, ink: Ink, width_px: float, tolerance: float
) -> tuple[dict[int, BezierChain], list[Misfit]]:
    """The curve of each strand, with nodes moved that so explain the ink better, and what is still missed."""
    curves = fitted(graph, lines, endings, graph.strands, width_px, tolerance)
    found = misfits(ink.mask, curves, lines, width_px)
    for node in _near(graph, found, width_px):
        before = _amount(found, graph.nodes[node], width_px)
        arms = arms_at(graph, lines, node, width_px, hard=False)
        if not before or (pairs_at(graph, node, arms) and _is_ink(ink, graph.nodes[node])):
            continue
        place, leads = _moved(graph, lines, node, arms, ink, width_px)
        was, graph.nodes[node] = graph.nodes[node], place
        tried = endings | leads
        changed = fitted(graph, lines, tried, {strand for strand, _ in leads}, width_px, tolerance)
        trial = curves | changed
        left = misfits(ink.mask, trial, lines, width_px)
        if _total(left) < _total(found) - (1 - _LEFT) * before:
            curves, found, endings = trial, left, tried
        else:
            graph.nodes[node] = was
    return curves, found


def _near(graph: StrandGraph, found: list[Misfit], width_px: float) -> list[int]:
    """The joints and corners beside a misfit, those beside the largest first."""
    near: dict[int, None] = {}
    for misfit in found:
        for node, at in sorted(graph.nodes.items(), key=lambda item: float(((item[1] - misfit.at) ** 2).sum())):
            if np.linalg.norm(at - misfit.at) > _NEAR * width_px:
                break
            if graph.degree(node) > 1 and not graph.is_seam(node):
                near[node] = None
    return list(near)


def _is_ink(ink: Ink, at: FloatArray) -> bool:
    """Whether a place is ink."""
    return bool(sample(ink, at[None], np.zeros((1, 2)), np.zeros(1))[0, 0] <= ink.half)


def _total(found: list[Misfit]) -> float:
    return sum(misfit.area for misfit in found)


def _amount(found: list[Misfit], at: FloatArray, width_px: float) -> float:
    """What is missed around a place, in squared stroke widths."""
    return sum(misfit.area for misfit in found if np.linalg.norm(misfit.at - at) < 2 * _NEAR * width_px)


def _moved(
    graph: StrandGraph, lines: dict[int, Line], node: int, arms: list[Arm], ink: Ink, width_px: float
) -> tuple[FloatArray, Ends]:
    """A better place of a node, and how each strand leaves it."""
    own_px = usual_width(widths_near(lines, arms, width_px), width_px)
    start = graph.nodes[node]
    around = surroundings(ink, np.stack([start, start]), arms, [], own_px)
    place = _best(around, arms, start)
    return place, {(each.strand, each.end): _ending(each, place) for each in arms}


def _best(around: Surroundings, arms: list[Arm], start: FloatArray) -> FloatArray:
    """The place from which leads to the arms miss the ink least: the best neighbour, step by step."""

    def cost(place: FloatArray) -> float:
        endings = [_ending(each, place) for each in arms]
        leads = [
            np.vstack([place, ending.lead, each.points[ending.cut - each.cut]])
            for each, ending in zip(arms, endings, strict=True)
        ]
        bent = [
            angle(ending.tangent, each.at(float(each.along[ending.cut - each.cut]))[1])
            for each, ending in zip(arms, endings, strict=True)
        ]
        return around.misfit(leads) + _BENT * sum(turn**2 for turn in bent)

    ways = [np.array([x, y], dtype=np.float64) for x in (-1, 0, 1) for y in (-1, 0, 1) if x or y]
    best, least = start, cost(start)
    for step in _STEPS:
        while True:
            tried = [best + step * around.width_px * way for way in ways]
            costs = [cost(each) for each in tried]
            if min(costs) >= least:
                break
            least = min(costs)
            best = tried[costs.index(least)]
    return best


def _ending(arm: Arm, place: FloatArray) -> Ending:
    return bent_ending(arm, place, passed(arm, place, arm.at(0.0)[1]))
