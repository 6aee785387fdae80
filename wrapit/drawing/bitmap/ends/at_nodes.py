"""Each node where its strokes point to: joints, corners, free ends and small rings."""

from __future__ import annotations

from wrapit.drawing.bitmap.arms import Arm, arms_at
from wrapit.drawing.bitmap.centre_lines import Line
from wrapit.drawing.bitmap.endings import place, place_end
from wrapit.drawing.bitmap.ends.rings import Ends, Rings
from wrapit.drawing.bitmap.hard_edges.pixels import needs_longer_look
from wrapit.drawing.bitmap.ink import Ink
from wrapit.drawing.bitmap.pairing import pair, unkinked
from wrapit.drawing.bitmap.strand_graph import StrandGraph


def ended(graph: StrandGraph, lines: dict[int, Line], rings: Rings, ink: Ink, width_px: float) -> Ends:
    """Puts each node where its arms point to; how each strand leaves its ends, but for closed loops."""
    endings: Ends = {}
    hard = needs_longer_look(ink, width_px)
    for node in graph.nodes:
        if node in rings:
            graph.nodes[node], ends = rings[node]
            endings |= ends
            continue
        arms = arms_at(graph, lines, node, width_px, hard=hard)
        if len(arms) == 1:
            graph.nodes[node], ending = place_end(arms[0], ink)
            endings[arms[0].strand, arms[0].end] = ending
        elif not graph.is_seam(node):
            pairs = pairs_at(graph, node, arms)
            graph.nodes[node], found = place(arms, graph.nodes[node], pairs, ink, known=node in graph.placed)
            for arm, ending in zip(arms, found, strict=True):
                endings[arm.strand, arm.end] = ending
    return endings


def pairs_at(graph: StrandGraph, node: int, arms: list[Arm]) -> list[tuple[int, int]]:
    """Which arms of a node continue each other; at a corner, where only two meet, none do."""
    if len(arms) == 2:
        return []
    index = {(arm.strand, arm.end): k for k, arm in enumerate(arms)}
    known = graph.through.get(node, ())
    if len(arms) == 4 and known and all(end in index for ends in known for end in ends):
        pairs = [(index[a], index[b]) for a, b in known]
    else:
        pairs = pair(arms)
    return unkinked(arms, pairs)
