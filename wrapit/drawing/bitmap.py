"""Traces a bitmap: ink, skeleton, clean-up, junctions, curves."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from wrapit.config import TracingConfig
from wrapit.drawing.assembly import Piece, assemble, placement
from wrapit.drawing.centring import Line, centre_lines, measure_width
from wrapit.drawing.cleanup import Radii, contract_short, drop_small_loops, keep_largest, prune_spurs
from wrapit.drawing.image import load_grey
from wrapit.drawing.ink import find_ink
from wrapit.drawing.model import Drawing
from wrapit.drawing.network import Network
from wrapit.drawing.skeleton import network, thin
from wrapit.errors import DrawingError, Finding
from wrapit.geometry import FloatArray, unit
from wrapit.geometry.fitting import Stroke, fit_all


def trace_bitmap(path: Path, tracing: TracingConfig, size_mm: float) -> tuple[Drawing, tuple[Finding, ...]]:
    """The drawing in a bitmap, its longest side `size_mm`, and what the maker should know about it.

    Raises DrawingError where the picture can't be read or is no line drawing.
    """
    grey, _ = load_grey(path, tracing.pixel_limit)
    ink = find_ink(grey, str(path))
    pixels, pairs = thin(ink.mask)
    if len(pixels) < 8:
        raise DrawingError("the picture holds no lines", str(path), "draw at least one line")
    width_px, distance = measure_width(pixels, ink.mask)
    net = network(pixels, pairs)
    radius = Radii(pixels, distance)
    net.rejoin_all()
    prune_spurs(net, radius, width_px)
    contract_short(net, radius, 1.0)
    drop_small_loops(net, width_px)
    keep_largest(net)
    lines = centre_lines(net, ink, width_px)
    pieces = _fitted(net, lines, width_px, tracing.tolerance)
    place = placement([piece.curve for piece in pieces], size_mm, flip=True)
    drawing = assemble(net.nodes, pieces, place, width=width_px, changes=net.changes, pixel_frame=True)
    return drawing, ()


def _fitted(net: Network, lines: dict[int, Line], width_px: float, tolerance: float) -> list[Piece]:
    strokes = []
    for strand, s in net.strands.items():
        strokes.append(_stroke(lines[strand], net.nodes[s.start], net.nodes[s.end], width_px))
    chains = fit_all(strokes, tolerance * width_px, reach=width_px)
    return [Piece(s.start, s.end, chain) for s, chain in zip(net.strands.values(), chains, strict=True)]


def _stroke(line: Line, start: FloatArray, end: FloatArray, width_px: float) -> Stroke:
    keep = (line.along > width_px) & (line.along < line.length - width_px)
    inner = line.points[keep]
    points = np.vstack([start[None], inner, end[None]])
    reach = min(len(points) - 1, 6)
    return Stroke(points, unit(points[reach] - points[0]), unit(points[-1] - points[-1 - reach]))
