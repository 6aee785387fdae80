"""Joints that lie so close together that each one's strokes are the others' too."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from wrapit.drawing.bitmap.arms import Arm, arm
from wrapit.drawing.bitmap.centre_lines import Line
from wrapit.drawing.bitmap.endings import Ending
from wrapit.drawing.bitmap.ends.at_nodes import pairs_at
from wrapit.drawing.bitmap.ends.rings import Ends
from wrapit.drawing.bitmap.mending.contours import FINE, half_widths
from wrapit.drawing.bitmap.mending.web import Between, Outward, Still, Web, parabola_shares
from wrapit.drawing.bitmap.strand_graph import StrandEnd, StrandGraph
from wrapit.geometry import BezierChain, FloatArray, unit
from wrapit.geometry.polyline import lengths
from wrapit.geometry.polynomials import angle

# In stroke widths.
# Which strokes make one crowd of their joints, and how many joints has it at most?
_SHORT = 2.5
_MOST = 5
# Where does a stroke that leaves stand alone? So far from the joint, in its arm.
_ALONE = 1.5
# What edges are those of a crowd? Those no farther than this from its strokes, and not much nearer to others.
_REACH = 1.1
_OTHERS = 0.3
# How many points of edges are enough?
_ENOUGH = 200
# When do two strokes of a pair go on as one?
_ONE_RAD = np.radians(25)
# In how many steps is a stroke between joints renewed, and one that leaves?
_STEPS, _LEAD_STEPS = 16, 8


@dataclass(frozen=True, eq=False)
class _Leaving:
    """A strand that leaves a crowd: its end there, its arm, and the arm's point from which on it stays."""

    end: StrandEnd
    node: int
    arm: Arm
    first: int


@dataclass(frozen=True, eq=False)
class Crowd:
    """The `nodes` of a crowd, the strands `inner` between them, those `leaving`, and what stays (n, 2) of curves."""

    nodes: list[int]
    inner: list[int]
    leaving: list[_Leaving]
    web: Web

    @property
    def strands(self) -> list[int]:
        """All strands whose curves a move changes."""
        return sorted({*self.inner, *(each.end[0] for each in self.leaving)})

    def seen(self, edge: FloatArray) -> FloatArray:
        """Those points (n, 2) of the ink's edges that tell of this crowd."""
        from scipy.spatial import cKDTree

        width_px = self.web.width_px
        own = cKDTree(np.concatenate(self.web.drawn)).query(edge, distance_upper_bound=_REACH * width_px)[0]
        near = np.flatnonzero(np.isfinite(own))
        if self.web.still and len(near):
            others = cKDTree(np.concatenate([still.points for still in self.web.still])).query(edge[near])[0]
            near = near[own[near] < others + _OTHERS * width_px]
        return edge[near[:: max(1, len(near) // _ENOUGH)]]

    def moved(self, graph: StrandGraph, edge: FloatArray) -> tuple[dict[int, FloatArray], dict[int, Line], Ends]:
        """Places of the nodes, lines of the strands between, and endings, with which edges (n, 2) fit best."""
        joints, between, outward = self.web.settled(edge)
        places = dict(zip(self.nodes, joints, strict=True))
        lines, endings = {}, {}
        for strand, bend in zip(self.inner, between, strict=True):
            s = graph.strands[strand]
            points = parabola_shares(_STEPS) @ np.stack([places[s.start], bend, places[s.end]])
            known = np.ones(len(points), dtype=np.bool_)
            lines[strand] = Line(points, known * self.web.width_px, known, lengths(points))
            for end, node in ((0, s.start), (1, s.end)):
                endings[strand, end] = Ending(unit(bend - places[node]), np.zeros((0, 2)), 1)
        for each, bend in zip(self.leaving, outward, strict=True):
            at, to = places[each.node], each.arm.points[each.first]
            lead = parabola_shares(_LEAD_STEPS)[1:-1] @ np.stack([at, bend, to])
            endings[each.end] = Ending(unit(bend - at), lead, each.arm.cut + each.first)
        for node in self.nodes:
            self._straighten(graph, node, endings)
        return places, lines, endings


    def _straighten(self, graph: StrandGraph, node: int, endings: Ends) -> None:
        """Gives those that go on as one the same direction."""
        arms = [each.arm for each in self.leaving if each.node == node]
        if len(arms) != graph.degree(node) or len(arms) < 3:
            return
        for one, other in (((arms[i].strand, arms[i].end), (arms[j].strand, arms[j].end)) for i, j in pairs_at(graph, node, arms)):
            first, second = endings[one].tangent, endings[other].tangent
            if angle(-first, second) < _ONE_RAD:
                along = unit(second - first)
                endings[one] = replace(endings[one], tangent=-along)
                endings[other] = replace(endings[other], tangent=along)


def crowd_at(
    graph: StrandGraph,
    lines: Mapping[int, Line],
    curves: Mapping[int, BezierChain],
    endings: Ends,
    node: int,
    width_px: float,
) -> Crowd | None:
    """The crowd of a node; nothing where it is too large, or leaves no strokes to stand on."""
    short = {s for s in graph.strands if min(lines[s].length, curves[s].length) < _SHORT * width_px}
    nodes = {node}
    for strand in short:
        s = graph.strands[strand]
        if s.start in nodes or s.end in nodes:
            nodes |= {n for n in (s.start, s.end) if graph.degree(n) > 1 and not graph.is_seam(n)}
    if len(nodes) > _MOST:
        return None
    listed = sorted(nodes)
    inner, leaving, still = [], [], []
    between, outward = [], []
    for strand, s in graph.strands.items():
        drawn = curves[strand].sampled(FINE * width_px)
        halves = half_widths(lines[strand], len(drawn), width_px)
        ends = [(end, n) for end, n in ((0, s.start), (1, s.end)) if n in nodes]
        if len(ends) == 2 and strand in short:
            if s.start == s.end:
                return None
            middle = drawn[len(drawn) // 2]
            bend = 2 * middle - (graph.nodes[s.start] + graph.nodes[s.end]) / 2
            inner.append(strand)
            between.append(Between(listed.index(s.start), listed.index(s.end), bend, float(halves.mean())))
            continue
        kept = [0, len(drawn)]
        for end, n in ends:
            found = _leaving(graph, lines[strand], endings, (strand, end), n, len(ends) == 2, width_px)
            if found is None:
                return None
            leaving.append(found)
            to = found.arm.points[found.first]
            direction = found.arm.at(float(found.arm.along[found.first]))[1]
            nearest = int(np.argmin(np.linalg.norm(drawn - to, axis=1)))
            outward.append(Outward(listed.index(n), to, direction, float(halves[nearest])))
            kept = [nearest, kept[1]] if end == 0 else [kept[0], nearest + 1]
        if kept[1] - kept[0] > 1:
            still.append(Still(drawn[slice(*kept)], halves[slice(*kept)]))
    joints = np.array([graph.nodes[n] for n in listed])
    corners = np.array([graph.degree(n) == 2 for n in listed])
    return Crowd(listed, inner, leaving, Web(joints, corners, between, outward, still, width_px))


def _leaving(
    graph: StrandGraph, line: Line, endings: Ends, end: StrandEnd, node: int, both: bool, width_px: float
) -> _Leaving | None:
    """Where a strand stands alone that leaves a node; nothing where its other end is nearer than that."""
    own = arm(line, *end, width_px)
    far = np.linalg.norm(own.points - graph.nodes[node], axis=1) > _ALONE * width_px
    first = int(np.argmax(far)) if far.any() else len(own.points) - 1
    most = len(line.points) // 2 if both else len(line.points) - 2 - endings[end[0], 1 - end[1]].cut
    first = min(first, most - own.cut)
    return _Leaving(end, node, own, first) if first >= 0 else None
