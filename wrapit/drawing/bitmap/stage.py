"""Traces a bitmap: ink, skeleton, clean-up, junctions, curves."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from wrapit.config import TracingConfig
from wrapit.drawing.assembly import Piece, Placement, assemble, placement
from wrapit.drawing.bitmap.centre_lines import centre_lines, renewed
from wrapit.drawing.bitmap.cleanup import (
    Radii,
    contract_short,
    drop_crumbs,
    join_flat_ends,
    tidy,
    without_pinholes,
)
from wrapit.drawing.bitmap.corners.stage import split_corners
from wrapit.drawing.bitmap.curves import start_loops
from wrapit.drawing.bitmap.ends.at_nodes import ended
from wrapit.drawing.bitmap.ends.rings import ring_joints
from wrapit.drawing.bitmap.gaps import close_gaps, cut_tails, drop_short
from wrapit.drawing.bitmap.hard_edges.pixels import needs_longer_look
from wrapit.drawing.bitmap.hard_edges.steady import all_steadied
from wrapit.drawing.bitmap.mending.misfits import misfits, tell_misread
from wrapit.drawing.bitmap.mending.stage import mended
from wrapit.drawing.bitmap.overlaps.short import forks_apart
from wrapit.drawing.bitmap.overlaps.stage import resolve_overlaps
from wrapit.drawing.bitmap.overlaps.tips import open_tips
from wrapit.drawing.bitmap.picture import Picture, read_on_ruled_paper, read_picture
from wrapit.drawing.bitmap.refusals import is_ruled, refuse_loose_strokes, refuse_other_pictures
from wrapit.drawing.bitmap.skeleton import strand_graph_of, thin_within
from wrapit.drawing.bitmap.strand_graph import StrandGraph
from wrapit.drawing.changes import Change, Notice
from wrapit.drawing.components import LONGEST_LINK, Connected, connect
from wrapit.drawing.model import Drawing
from wrapit.errors import DrawingError, Finding
from wrapit.geometry import BezierChain, FloatArray

# How much of a stair may a curve leave out, at least, and how much of the configured tolerance? Nearly the
# half that an edge is uncertain by; and less than usual of the other, as the line is off already. With 0.25
# of a stair, enlarged drawings turn 1.4 times as much. With all of the tolerance 8 instead of 11 of 26
# drawings are near their smooth twins, with 0.6 one takes 1.68 times their Béziers.
_STAIR = 0.4
_OF_TOLERANCE = 0.85


def trace_bitmap(path: Path, tracing: TracingConfig, size_mm: float) -> tuple[Drawing, tuple[Finding, ...]]:
    """The drawing in a bitmap, its longest side `size_mm`, and what the maker should know about it.

    Raises DrawingError where the picture can't be read or is no line drawing.
    """
    if tracing.filled == "refuse":
        return _read_and_traced(path, tracing, size_mm, alone=True)
    # A filled shape may well reach the side of the picture, as an edge or a table does: those come second.
    try:
        return _read_and_traced(path, tracing, size_mm, alone=False)
    except DrawingError as refused:
        try:
            return _read_and_traced(path, tracing, size_mm, alone=True)
        except DrawingError:
            # The first reason tells the maker more.
            raise refused from None


def _read_and_traced(
    path: Path, tracing: TracingConfig, size_mm: float, *, alone: bool
) -> tuple[Drawing, tuple[Finding, ...]]:
    picture = read_picture(path, tracing, alone=alone)
    ruled = is_ruled(picture.ink.mask)
    darker = read_on_ruled_paper(path, tracing, alone=alone) if ruled else None
    try:
        drawing, findings = _traced(darker or picture, path, tracing, size_mm)
    except DrawingError as refused:
        raise _with_surroundings(refused, picture) from None
    return drawing, (_about_ruling(darker is not None), *findings) if ruled else findings


def _with_surroundings(refused: DrawingError, picture: Picture) -> DrawingError:
    """The refusal, led by what lies around the paper where there is such: most likely it is the cause."""
    around = [notice.message for notice in picture.notices if notice.code in ("dark-table", "dark-edge")]
    if not around:
        return refused
    return DrawingError(
        f"{around[0]}, but what remains is no line drawing",
        refused.where,
        "crop the picture to the plain paper around the drawing, or photograph it in even light",
    )


def _about_ruling(left_out: bool) -> Finding:
    if left_out:
        return Finding(
            "warning",
            "ruled-paper",
            "drawing",
            "only the darkest lines were traced; paler ones that rule the paper are left out",
            "draw on plain paper if lines are missing",
        )
    return Finding(
        "warning",
        "ruled-paper",
        "drawing",
        "straight lines run across the whole picture and were traced as part of the drawing",
        "draw on plain paper, or with a pen much darker than the ruling, if they are not meant",
    )


def _traced(
    picture: Picture, path: Path, tracing: TracingConfig, size_mm: float
) -> tuple[Drawing, tuple[Finding, ...]]:
    ink, skeleton = picture.ink, picture.skeleton
    width_px = skeleton.width_px
    graph = strand_graph_of(skeleton.pixels, skeleton.pairs)
    filled = without_pinholes(graph, ink.mask, width_px)
    if filled is not None:
        skeleton = thin_within(filled)
        graph = strand_graph_of(skeleton.pixels, skeleton.pairs)
    radius = Radii(skeleton.pixels, skeleton.distance)
    graph.rejoin_all()
    tidy(graph, radius, width_px)
    join_flat_ends(graph, ink.mask, radius, width_px)
    refuse_other_pictures(ink, skeleton, graph, str(path), outlined=tracing.filled == "outline")
    contract_short(graph, radius, 0.35)
    tidy(graph, radius, width_px)
    drop_crumbs(graph, width_px)
    refuse_loose_strokes(graph, str(path))
    lines = centre_lines(graph, ink, width_px)
    open_tips(graph, lines, ink, width_px)
    resolve_overlaps(graph, lines, ink, width_px)
    contract_short(graph, radius, 1.0, forks_apart(graph, lines, width_px))
    if tidy(graph, radius, width_px):
        lines = renewed(graph, lines, ink, width_px)
    cut_tails(graph, lines, ink, width_px)
    close_gaps(graph, lines, ink, width_px)
    split_corners(graph, lines, ink, width_px, tracing.corner_angle)
    size_px = float(max(np.ptp(np.concatenate([line.points for line in lines.values()]), axis=0)))
    drop_short(graph, lines, tracing.shortest_segment * size_px / size_mm, tracing.shortest_segment)
    uneven_px = picture.uneven_px
    steady = all_steadied(graph, lines, width_px, uneven_px) if uneven_px else lines
    rings = ring_joints(graph, steady, ink, width_px)
    # Steadying bends the ends of lines: what strokes point at is told by what was measured.
    measured = lines if needs_longer_look(ink, width_px) else steady
    endings = ended(graph, measured, rings, ink, width_px)
    tolerance = _tolerance(picture, tracing)
    start_loops(graph, steady, endings, width_px)
    curves = mended(graph, steady, endings, rings, ink, width_px, tolerance)
    missed = misfits(ink.mask, curves, steady, width_px)
    pieces = [Piece(s.start, s.end, curves[strand]) for strand, s in graph.strands.items()]
    connected = connect(graph.nodes, pieces, tracing.components, LONGEST_LINK * size_px)
    graph.changes += connected.changes
    graph.notices += connected.notices
    tell_misread(graph, missed, [piece.curve for piece in connected.pieces], width_px)
    return _drawing(graph, connected, picture, size_mm)


def _drawing(
    graph: StrandGraph, connected: Connected, picture: Picture, size_mm: float
) -> tuple[Drawing, tuple[Finding, ...]]:
    pieces = [
        Piece(piece.start, piece.end, BezierChain(picture.source(piece.curve.points)), piece.kind)
        for piece in connected.pieces
    ]
    places = {node: picture.source(point) for node, point in connected.places.items()}
    where = placement([piece.curve for piece in pieces], size_mm, flip=True)
    changes = [*picture.changes]
    changes += [
        Change(
            change.what,
            (x, y),
            change.length_px * picture.factor,
            change.reason,
        )
        for change in graph.changes
        for x, y in [picture.source(np.array(change.at_px)).tolist()]
    ]
    drawing = assemble(
        places,
        pieces,
        where,
        width=picture.skeleton.width_px * picture.factor,
        changes=changes,
        pixel_frame=True,
        spots=picture.spots_in_source([*connected.spots, *picture.dots]),
    )
    findings = [*_about(picture)]
    findings += [_finding(notice, np.array(notice.at_px), where) for notice in picture.notices]
    findings += [_finding(notice, picture.source(np.array(notice.at_px)), where) for notice in graph.notices]
    return drawing, tuple(findings)


def _about(picture: Picture) -> list[Finding]:
    findings = []
    width_px = picture.skeleton.width_px * picture.factor
    if picture.light_on_dark:
        findings.append(Finding("note", "light-on-dark", "drawing", "light lines on dark ground were traced"))
    if picture.ink.shaded:
        findings.append(
            Finding("note", "uneven-paper", "drawing", "the paper is unevenly lit; its shade was divided out")
        )
    if width_px < 3:
        findings.append(
            Finding(
                "warning",
                "coarse-picture",
                "drawing",
                f"the lines are only {width_px:.1f} px wide, so junctions may be off by part of a pixel",
                "scan at a higher resolution",
            )
        )
    return findings


def _finding(notice: Notice, px: FloatArray, where: Placement) -> Finding:
    mm = where.points(px)
    place = f"at ({px[0]:.0f}, {px[1]:.0f}) px, ({mm[0]:.1f}, {mm[1]:.1f}) mm"
    return Finding(notice.level, notice.code, place, notice.message, notice.remedy)


def _tolerance(picture: Picture, tracing: TracingConfig) -> float:
    """How far curves may leave the points, in stroke widths: no stairs are followed."""
    if not picture.uneven_px:
        return tracing.tolerance
    return max(_OF_TOLERANCE * tracing.tolerance, _STAIR * picture.uneven_px / picture.skeleton.width_px)
