"""Curves along centre lines, from node to node as their endings say."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from wrapit.drawing.bitmap.centre_lines import Line
from wrapit.drawing.bitmap.endings import Ending
from wrapit.drawing.bitmap.ends.rings import Ends
from wrapit.drawing.bitmap.strand_graph import StrandGraph
from wrapit.geometry import BezierChain, unit
from wrapit.geometry.fitting.fit import Stroke, fit_all


def start_loops(graph: StrandGraph, lines: dict[int, Line], endings: Ends, width_px: float) -> None:
    """Lets each closed loop without junction start and end at its topmost point, in one direction."""
    for node in graph.nodes:
        if graph.is_seam(node):
            strand = graph.ends_at(node)[0][0]
            line = lines[strand]
            lines[strand] = line = line.turned(int(np.argmin(line.points[:-1, 1])))
            reach = int(np.searchsorted(line.along, width_px))
            tangent = unit(line.points[reach] - line.points[-1 - reach])
            graph.nodes[node] = line.points[0]
            endings[strand, 0] = Ending(tangent, np.zeros((0, 2)), 1)
            endings[strand, 1] = Ending(-tangent, np.zeros((0, 2)), 1)


def fitted(
    graph: StrandGraph,
    lines: dict[int, Line],
    endings: Ends,
    strands: Iterable[int],
    width_px: float,
    tolerance: float,
) -> dict[int, BezierChain]:
    """The curves of strands, no farther than `tolerance` (stroke widths) from their lines."""
    strands = list(strands)
    strokes = [
        _stroke(graph, strand, lines[strand], endings[strand, 0], endings[strand, 1]) for strand in strands
    ]
    return dict(zip(strands, fit_all(strokes, tolerance * width_px, reach=width_px), strict=True))


def _stroke(graph: StrandGraph, strand: int, line: Line, first: Ending, last: Ending) -> Stroke:
    s = graph.strands[strand]
    stop = len(line.points) - last.cut
    inner = slice(first.cut, stop)
    keep = line.clean[inner] if stop > first.cut and line.clean[inner].mean() > 0.6 else slice(None)
    middle = line.points[inner][keep] if stop > first.cut else np.zeros((0, 2))
    # A point every quarter of the width tells a curve as well as one every eighth.
    if len(middle) > 32:
        told = np.arange(len(middle)) % 2 == 0
        # A gentle corner's own points have no width; without its apex a curve cuts it by 0.4 widths.
        told |= np.isnan(line.width[inner][keep])
        middle = middle[told]
    points = np.vstack(
        [graph.nodes[s.start][None], first.lead, middle, last.lead[::-1], graph.nodes[s.end][None]]
    )
    return Stroke(points, first.tangent, -last.tangent)
