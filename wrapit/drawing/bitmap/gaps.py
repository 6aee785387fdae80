"""Changes to a strand graph together with its centre lines: strands joined and cut, gaps, short segments."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from wrapit.drawing.bitmap.arms import arm
from wrapit.drawing.bitmap.centre_lines import Line
from wrapit.drawing.bitmap.endings import place_end
from wrapit.drawing.bitmap.ends.caps import find_cap
from wrapit.drawing.bitmap.ink import Ink
from wrapit.drawing.bitmap.strand_graph import StrandGraph
from wrapit.geometry import FloatArray
from wrapit.geometry.polyline import lengths, total_length
from wrapit.geometry.polynomials import angle

# What gap (in stroke widths) was not meant? Between two ends that face each other one, between an end and the
# side of a stroke half of one; wider ones may be meant and stay open. On the pictures measured
# no gap lies within 30 % of either.
_END_GAP = 1.0
_SIDE_GAP = 0.5
# How far off may an end point and still mean the other one? The last width of a stroke is poorly known, so
# widely; the pictures measured hold no case within 30 % of these.
_END_RAD = math.radians(60)
_SIDE_RAD = math.radians(50)
# Where does a flat end bend the skeleton? Thinning turns to a corner half a width before the edge, so 0.6 of
# it is left out; the cap is looked at from a whole width away, on lines that are long enough for both.
_TURNS = 0.6
_TAIL = 1.0
_TAILED = 2.5


def rejoin(graph: StrandGraph, lines: dict[int, Line], node: int) -> None:
    """One strand and one line in place of the two that meet at a node of degree two."""
    ends = graph.ends_at(node)
    if len(ends) != 2 or ends[0][0] == ends[1][0]:
        return
    (first, first_end), (second, second_end) = ends
    before = _walked(lines.pop(first), turned=first_end == 0)
    after = _walked(lines.pop(second), turned=second_end == 1)
    strand = graph.rejoin(node)
    if strand is not None:
        lines[strand] = _joined([before, after])


def cut(graph: StrandGraph, lines: dict[int, Line], strand: int, index: int) -> int:
    """A new node on a strand, at a point of its line; its number."""
    s, line = graph.strands[strand], lines.pop(strand)
    node = graph.add_node(line.points[index])
    graph.drop_strand(strand)
    for start, end, part in ((s.start, node, slice(None, index + 1)), (node, s.end, slice(index, None))):
        points = line.points[part]
        lines[graph.add_strand(start, end, points)] = Line(
            points, line.width[part], line.clean[part], lengths(points)
        )
    return node


def cut_tails(graph: StrandGraph, lines: dict[int, Line], ink: Ink, width_px: float) -> None:
    """Lines stop before a flat end, where thinning turns to one of its corners."""
    for node in [node for node in graph.nodes if graph.degree(node) == 1]:
        strand, end = graph.ends_at(node)[0]
        line = lines[strand]
        if line.length < _TAILED * width_px:
            continue
        from_tip = line.along if end == 0 else line.length - line.along
        before = _part(line, from_tip >= _TAIL * width_px)
        last = arm(before, strand, end, width_px)
        start, slope = last.at(0.0)
        cap = find_cap(start, -slope, width_px, ink)
        if cap is not None and cap.flat:
            ahead = (line.points - start) @ -slope
            kept = (from_tip >= _TAIL * width_px) | (ahead <= cap.edge_px - _TURNS * width_px)
            lines[strand] = _part(line, kept)


def close_gaps(graph: StrandGraph, lines: dict[int, Line], ink: Ink, width_px: float) -> None:
    """Joins free ends that nearly touch another end, or point at a stroke right in front of them."""
    tips = {}
    for node in [node for node in graph.nodes if graph.degree(node) == 1]:
        strand, end = graph.ends_at(node)[0]
        place, ending = place_end(arm(lines[strand], strand, end, width_px), ink)
        tips[node] = (place, -ending.tangent)
    for _, one, other in _facing(tips, width_px):
        if {one, other} <= graph.nodes.keys() and graph.degree(one) == graph.degree(other) == 1:
            middle = (tips[one][0] + tips[other][0]) / 2
            gap = float(np.linalg.norm(tips[one][0] - tips[other][0])) - width_px
            graph.note("gap", middle, max(gap, 0.0), "two ends nearly touch: closed")
            graph.tell("note", "gap-closed", middle, "two ends of strokes that nearly touch were joined")
            _join_ends(graph, lines, one, other, middle)
    for node, (place, outward) in tips.items():
        if node in graph.nodes and graph.degree(node) == 1:
            _join_side(graph, lines, node, place, outward, width_px)


def _facing(tips: dict[int, tuple[FloatArray, FloatArray]], width_px: float) -> list[tuple[float, int, int]]:
    """Pairs of free ends that point at each other over a small gap, nearest first."""
    nodes = list(tips)
    if len(nodes) < 2:
        return []
    points = np.array([tips[node][0] for node in nodes])
    apart = np.linalg.norm(points[:, None] - points[None], axis=2)
    found = []
    for i, j in np.argwhere(np.triu(apart < (1 + _END_GAP) * width_px, 1)):
        step = points[j] - points[i]
        facing = max(angle(tips[nodes[i]][1], step), angle(tips[nodes[j]][1], -step)) < _END_RAD
        if facing or apart[i, j] < 0.3 * width_px:
            found.append((float(apart[i, j]), nodes[i], nodes[j]))
    return sorted(found)


def _join_ends(graph: StrandGraph, lines: dict[int, Line], one: int, other: int, middle: FloatArray) -> None:
    same = graph.ends_at(one)[0][0] == graph.ends_at(other)[0][0]
    strand = graph.ends_at(one)[0][0]
    node = graph.merge([one, other], middle, [])
    if same:
        line = lines[strand]
        points = np.vstack([line.points, line.points[:1]])
        lines[strand] = Line(
            points,
            np.append(line.width, line.width[0]),
            np.append(line.clean, line.clean[0]),
            lengths(points),
        )
    else:
        rejoin(graph, lines, node)


def _join_side(
    graph: StrandGraph,
    lines: dict[int, Line],
    node: int,
    place: FloatArray,
    outward: FloatArray,
    width_px: float,
) -> None:
    own = graph.ends_at(node)[0][0]
    best: tuple[float, int, int] | None = None
    reach = (1 + _SIDE_GAP) * width_px
    for strand, line in lines.items():
        low, high = line.box
        if (place < low - reach).any() or (place > high + reach).any():
            continue
        far = np.linalg.norm(line.points - place, axis=1)
        if strand == own:
            from_tip = line.along if graph.ends_at(node)[0][1] == 0 else line.length - line.along
            far = np.where(from_tip < 4 * width_px, np.inf, far)
        index = int(np.argmin(far))
        if best is None or far[index] < best[0]:
            best = (float(far[index]), strand, index)
    if best is None or best[0] > reach:
        return
    distance, strand, index = best
    point = lines[strand].points[index]
    if angle(outward, point - place) > _SIDE_RAD or not 2 < index < len(lines[strand].points) - 3:
        return
    graph.note(
        "gap", (place + point) / 2, max(distance - width_px, 0.0), "an end nearly touches a stroke: closed"
    )
    graph.tell("note", "gap-closed", point, "an end that nearly touches a stroke was joined to it")
    joint = cut(graph, lines, strand, index)
    end = next(end for end in graph.ends_at(node))
    graph.reroute(end[0], end[1], joint)
    graph.drop_lonely()


def drop_short(graph: StrandGraph, lines: dict[int, Line], shortest_px: float, shortest_mm: float) -> None:
    """Drops side branches, and merges the ends of inner strands, that are too short to bend by hand."""
    reason = f"shorter than {shortest_mm:g} mm, which nobody can bend"
    while True:
        short = []
        for strand, s in graph.strands.items():
            if (
                min(graph.degree(s.start), graph.degree(s.end))
                == 1
                == max(graph.degree(s.start), graph.degree(s.end))
            ):
                continue
            length = min(lines[strand].length, total_length(graph.path(strand)))
            if length < shortest_px and len(graph.strands) > 1:
                short.append((length, strand))
        if not short:
            return
        length, strand = min(short)
        s = graph.strands[strand]
        middle = (graph.nodes[s.start] + graph.nodes[s.end]) / 2
        graph.note("short segment", middle, length, reason)
        if s.start == s.end or 1 in (graph.degree(s.start), graph.degree(s.end)):
            graph.drop_strand(strand)
            del lines[strand]
            graph.drop_lonely()
            left = [node for node in {s.start, s.end} if node in graph.nodes]
        else:
            del lines[strand]
            left = [graph.merge([s.start, s.end], middle, [strand])]
        for node in left:
            if graph.degree(node) == 2:
                rejoin(graph, lines, node)


def _part(line: Line, kept: NDArray[np.bool_]) -> Line:
    points = line.points[kept]
    return Line(points, line.width[kept], line.clean[kept], lengths(points))


def _walked(line: Line, turned: bool) -> Line:
    if not turned:
        return line
    points = line.points[::-1]
    return Line(points, line.width[::-1], line.clean[::-1], lengths(points))


def _joined(parts: list[Line]) -> Line:
    points = np.concatenate([part.points for part in parts])
    return Line(
        points,
        np.concatenate([part.width for part in parts]),
        np.concatenate([part.clean for part in parts]),
        lengths(points),
    )
