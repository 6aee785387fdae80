"""Traces a bitmap: ink, skeleton, clean-up, junctions, curves."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from wrapit.config import TracingConfig
from wrapit.drawing.assembly import Piece, assemble, placement
from wrapit.drawing.centring import Line, centre_lines
from wrapit.drawing.cleanup import Radii, contract_short, drop_small_loops, keep_largest, prune_spurs
from wrapit.drawing.image import load_grey
from wrapit.drawing.corners import split_corners
from wrapit.drawing.ends import place_end
from wrapit.drawing.ink import Ink, find_ink
from wrapit.drawing.junctions import PAIR_RAD, Ending, arms_at, place
from wrapit.drawing.model import Drawing
from wrapit.drawing.network import Network
from wrapit.drawing.skeleton import network, thin
from wrapit.errors import DrawingError, Finding
from wrapit.geometry import unit
from wrapit.geometry.fitting import Stroke, fit_all


def trace_bitmap(path: Path, tracing: TracingConfig, size_mm: float) -> tuple[Drawing, tuple[Finding, ...]]:
    """The drawing in a bitmap, its longest side `size_mm`, and what the maker should know about it.

    Raises DrawingError where the picture can't be read or is no line drawing.
    """
    grey, _ = load_grey(path, tracing.pixel_limit)
    ink = find_ink(grey, str(path))
    skeleton = thin(ink.mask)
    if len(skeleton.pixels) < 8:
        raise DrawingError("the picture holds no lines", str(path), "draw at least one line")
    width_px = skeleton.width_px
    net = network(skeleton.pixels, skeleton.pairs)
    radius = Radii(skeleton.pixels, skeleton.distance)
    net.rejoin_all()
    prune_spurs(net, radius, width_px)
    contract_short(net, radius, 1.0)
    drop_small_loops(net, width_px)
    keep_largest(net)
    lines = centre_lines(net, ink, width_px)
    split_corners(net, lines, width_px, tracing.corner_angle)
    pieces = _fitted(net, lines, ink, width_px, tracing.tolerance)
    where = placement([piece.curve for piece in pieces], size_mm, flip=True)
    drawing = assemble(net.nodes, pieces, where, width=width_px, changes=net.changes, pixel_frame=True)
    return drawing, ()


def _fitted(net: Network, lines: dict[int, Line], ink: Ink, width_px: float, tolerance: float) -> list[Piece]:
    endings: dict[tuple[int, int], Ending] = {}
    for node in net.nodes:
        arms = arms_at(net, lines, node, width_px)
        if len(arms) == 1:
            net.nodes[node], ending = place_end(arms[0], ink)
            endings[arms[0].strand, arms[0].end] = ending
        elif len(arms) == 2 and arms[0].strand == arms[1].strand:
            _seam(net, lines, node, endings, width_px)
        else:
            limit = 0.0 if len(arms) == 2 else PAIR_RAD
            net.nodes[node], found = place(arms, net.nodes[node], limit)
            for arm_, ending in zip(arms, found, strict=True):
                endings[arm_.strand, arm_.end] = ending
    strokes = [
        _stroke(net, strand, lines[strand], endings[strand, 0], endings[strand, 1]) for strand in net.strands
    ]
    chains = fit_all(strokes, tolerance * width_px, reach=width_px)
    return [Piece(s.start, s.end, chain) for s, chain in zip(net.strands.values(), chains, strict=True)]


def _seam(
    net: Network, lines: dict[int, Line], node: int, endings: dict[tuple[int, int], Ending], width_px: float
) -> None:
    """A closed loop without junction starts and ends at its topmost point, in one direction."""
    strand = net.ends_at(node)[0][0]
    line = lines[strand]
    top = int(np.argmin(line.points[:-1, 1]))
    lines[strand] = line = line.turned(top)
    reach = int(np.searchsorted(line.along, width_px))
    tangent = unit(line.points[reach] - line.points[-1 - reach])
    net.nodes[node] = line.points[0]
    endings[strand, 0] = Ending(tangent, np.zeros((0, 2)), 1)
    endings[strand, 1] = Ending(-tangent, np.zeros((0, 2)), 1)


def _stroke(net: Network, strand: int, line: Line, first: Ending, last: Ending) -> Stroke:
    s = net.strands[strand]
    stop = len(line.points) - last.cut
    inner = slice(first.cut, stop)
    keep = line.clean[inner] if line.clean[inner].mean() > 0.6 else slice(None)
    middle = line.points[inner][keep] if stop > first.cut else np.zeros((0, 2))
    points = np.vstack(
        [net.nodes[s.start][None], first.lead, middle, last.lead[::-1], net.nodes[s.end][None]]
    )
    return Stroke(points, first.tangent, -last.tangent)
