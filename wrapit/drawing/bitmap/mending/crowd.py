"""Joints that lie so close together that each one's strokes are the others' too."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace

import numpy as np

from wrapit.drawing.bitmap.arms import Arm, arm, arms_at
from wrapit.drawing.bitmap.centre_lines import Line
from wrapit.drawing.bitmap.endings import SNAP_RAD, Ending, bent_ending, passed
from wrapit.drawing.bitmap.ends.at_nodes import pairs_at
from wrapit.drawing.bitmap.ends.rings import Ends
from wrapit.drawing.bitmap.mending.web import Between, Outward, Still, Web
from wrapit.drawing.bitmap.strand_graph import StrandEnd, StrandGraph
from wrapit.geometry import FloatArray, unit
from wrapit.geometry.polyline import lengths
from wrapit.geometry.polynomials import angle, parabola_shares

# In stroke widths.
# Which strokes make one crowd of their joints, and how many joints has it at most? A parabola can't follow
# longer ones, and each joint more makes a step dearer. Not varied.
_SHORT = 2.5
_MOST = 5
# How far around a crowd are strokes looked for that may have edges in common with its own?
_NEAR = 2.5
# Where does a stroke that leaves stand alone? So far from the joint, in its arm.
_ALONE = 1.5
# What edges are those of a crowd? Those no farther than this from its strokes, and not much nearer to others.
_REACH = 1.1
_OTHERS = 0.3
# How many points of edges are enough? More only cost time. Not varied.
_ENOUGH = 200
# When are two joints one? Their wires would touch over all of the stroke between.
_ONE = 0.35
# When do two strokes of a pair go on as one?
_ONE_RAD = np.radians(25)
# In how many steps is a stroke between joints renewed?
_STEPS = 16


@dataclass(frozen=True, eq=False)
class _Leaving:
    """A strand that leaves a crowd at a node: its arm there, and the arm's point from which on it stays."""

    end: StrandEnd
    node: int
    arm: Arm
    first: int

    @property
    def to(self) -> FloatArray:
        """The place from which on it stays."""
        return self.arm.points[self.first]


@dataclass(frozen=True, eq=False)
class Crowd:
    """The `nodes` of a crowd, the strands `inner` between them, those that leave, and all as a web.

    `pairs` are the strand ends at each node that continue each other.
    """

    nodes: list[int]
    inner: list[int]
    leaving: list[_Leaving]
    pairs: dict[int, list[tuple[StrandEnd, StrandEnd]]]
    web: Web

    @property
    def strands(self) -> list[int]:
        """All strands whose curves a move changes."""
        return sorted({*self.inner, *(each.end[0] for each in self.leaving)})

    def seen(self, edge: FloatArray) -> FloatArray:
        """Those points (n, 2) of the ink's edges, from top to bottom, that tell of this crowd."""
        from scipy.spatial import cKDTree

        width_px = self.web.width_px
        rows = self.web.drawn[:, 1].min() - _REACH * width_px, self.web.drawn[:, 1].max() + _REACH * width_px
        edge = edge[slice(*np.searchsorted(edge[:, 1], rows))]
        own = cKDTree(self.web.drawn).query(edge, distance_upper_bound=_REACH * width_px)[0]
        near = np.flatnonzero(np.isfinite(own))
        if self.web.still and len(near):
            others = cKDTree(np.concatenate([still.points for still in self.web.still])).query(edge[near])[0]
            near = near[own[near] < others + _OTHERS * width_px]
        return edge[near[:: max(1, len(near) // _ENOUGH)]]

    def moved(self, graph: StrandGraph, edge: FloatArray) -> Moved | None:
        """The crowd where edges (n, 2) fit best; nothing where two of its joints would be one then."""
        joints, between, outward = self.web.settled(edge)
        places = dict(zip(self.nodes, joints, strict=True))
        apart = [np.linalg.norm(joints[each.end] - joints[each.start]) for each in self.web.between]
        if min(apart, default=np.inf) < _ONE * self.web.width_px:
            return None
        lines, endings = {}, {}
        for strand, bend, was in zip(self.inner, between, self.web.between, strict=True):
            s = graph.strands[strand]
            points = parabola_shares(_STEPS) @ np.stack([places[s.start], bend, places[s.end]])
            width = np.full(len(points), 2 * was.half_px)
            lines[strand] = Line(points, width, np.ones(len(points), dtype=np.bool_), lengths(points))
            for end, node in ((0, s.start), (1, s.end)):
                endings[strand, end] = Ending(unit(bend - places[node]), np.zeros((0, 2)), 1)
        for each, bend in zip(self.leaving, outward, strict=True):
            endings[each.end] = bent_ending(each.arm, each.first, places[each.node], bend)
        for node, pairs in self.pairs.items():
            endings |= _aligned(endings, graph.ends_at(node), pairs)
        return Moved(places, lines, endings)


@dataclass(frozen=True, eq=False)
class Moved:
    """New places of nodes, and what is new with them: lines of strands between, and endings."""

    places: dict[int, FloatArray]
    lines: dict[int, Line]
    endings: Ends


def _aligned(endings: Ends, ends: list[StrandEnd], pairs: list[tuple[StrandEnd, StrandEnd]]) -> Ends:
    """The endings at a node, with one direction for pairs, and for single ones that nearly leave along."""
    tangents = {}
    for one, other in pairs:
        first, second = endings[one].tangent, endings[other].tangent
        if angle(-first, second) < _ONE_RAD:
            tangents[other] = unit(second - first)
            tangents[one] = -tangents[other]
    through = list(tangents.values())
    for end in ends:
        if end not in tangents:
            near = [along for along in through if angle(along, endings[end].tangent) < SNAP_RAD]
            if near:
                tangents[end] = near[0]
    return {end: replace(endings[end], tangent=along) for end, along in tangents.items()}


def crowd_at(
    graph: StrandGraph,
    lines: Mapping[int, Line],
    drawn: Mapping[int, Still],
    endings: Ends,
    node: int,
    kept: Collection[int],
    width_px: float,
) -> Crowd | None:
    """The crowd of a node, without nodes that are `kept`; nothing where its strokes stand alone nowhere."""
    nodes = _nodes(graph, drawn, node, kept, width_px)
    inner, between, leaving, outward, still = [], [], [], [], []
    own = {strand for n in nodes for strand, _ in graph.ends_at(n)}
    for strand in sorted(own):
        s, line, stroke = graph.strands[strand], lines[strand], drawn[strand]
        ends = [(end, n) for end, n in ((0, s.start), (1, s.end)) if n in nodes]
        if len(ends) == 2 and s.start != s.end and stroke.length < _SHORT * width_px:
            middle = stroke.points[len(stroke.points) // 2]
            bend = 2 * middle - (graph.nodes[s.start] + graph.nodes[s.end]) / 2
            inner.append(strand)
            between.append(
                Between(nodes.index(s.start), nodes.index(s.end), bend, float(stroke.halves.mean()))
            )
            continue
        first, last = 0, len(stroke.points)
        for end, n in ends:
            found = _leaving(graph, line, endings, (strand, end), n, len(ends) == 2, width_px)
            if found is None:
                return None
            direction = found.arm.at(float(found.arm.along[found.first]))[1]
            nearest = int(np.argmin(np.linalg.norm(stroke.points - found.to, axis=1)))
            leaving.append(found)
            outward.append(Outward(nodes.index(n), found.to, direction, float(stroke.halves[nearest])))
            first, last = (nearest, last) if end == 0 else (first, nearest + 1)
        still.append(stroke.part(first, last))
    joints = np.array([graph.nodes[n] for n in nodes])
    corners = [k for k, n in enumerate(nodes) if graph.degree(n) == 2]
    moving = np.concatenate([joints, *(out.to[None] for out in outward)])
    low, high = moving.min(axis=0) - _NEAR * width_px, moving.max(axis=0) + _NEAR * width_px
    still += [stroke for strand, stroke in drawn.items() if strand not in own and stroke.reaches(low, high)]
    still = [stroke for stroke in still if len(stroke.points) > 1]
    pairs = {n: _pairs(graph, lines, n, width_px) for n in nodes}
    return Crowd(nodes, inner, leaving, pairs, Web(joints, corners, between, outward, still, width_px))


def _pairs(
    graph: StrandGraph, lines: Mapping[int, Line], node: int, width_px: float
) -> list[tuple[StrandEnd, StrandEnd]]:
    arms = arms_at(graph, lines, node, width_px, hard=False)
    ends = [(each.strand, each.end) for each in arms]
    return [(ends[i], ends[j]) for i, j in pairs_at(graph, node, arms)]


def _nodes(
    graph: StrandGraph, drawn: Mapping[int, Still], node: int, kept: Collection[int], width_px: float
) -> list[int]:
    """A node and those that short strokes join with it, but no more than a crowd has."""
    nodes, added = {node}, {node}
    while added:
        ends = [(strand, end) for n in sorted(added) for strand, end in graph.ends_at(n)]
        others = {graph.other_node(*each) for each in ends if drawn[each[0]].length < _SHORT * width_px}
        added = {n for n in others - nodes if graph.degree(n) > 1 and n not in kept and not graph.is_seam(n)}
        if len(nodes | added) > _MOST:
            break
        nodes |= added
    return sorted(nodes)


def _leaving(
    graph: StrandGraph, line: Line, endings: Ends, end: StrandEnd, node: int, both: bool, width_px: float
) -> _Leaving | None:
    """Where a strand stands alone that leaves a node; nothing where its other end is nearer than that."""
    own = arm(line, *end, width_px)
    far = np.linalg.norm(own.points - graph.nodes[node], axis=1) > _ALONE * width_px
    far[: passed(own, graph.nodes[node], own.at(0.0)[1])] = False
    first = int(np.argmax(far)) if far.any() else len(own.points) - 1
    most = len(line.points) // 2 if both else len(line.points) - 2 - endings[end[0], 1 - end[1]].cut
    first = min(first, most - own.cut)
    return _Leaving(end, node, own, first) if first >= 0 else None
