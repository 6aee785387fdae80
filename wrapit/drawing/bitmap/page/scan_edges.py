"""A scan's dark edges, corners and punched holes: ink along a picture's sides that nobody drew."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from wrapit.drawing.bitmap.page.cells import BoolCells, Cells, depth

# How deep are dark edges? Up to this share of the shorter side, and no deeper than they are long.
_DEEPEST = 0.18
# What is left of the drawing at least, in shares of the longer side of the picture?
_LEAST_LEFT = 0.15
# Where is a hole punched? Within this share of the shorter side from a side; a disc of up to this share,
# that fills this much of its box (a full disc .79, a ring less) and is so much thicker than lines.
_HOLE_DEPTH = 0.14
_HOLE_SIZE = 0.07
_DISC = 0.68
_THICKER = 1.8
# Where does a drawing run into a dark edge? Where so much of a side is dark, deeper than so many strokes.
_ALONG = 0.3
_DEEP = 2.0


@dataclass(frozen=True, eq=False)
class Edges:
    """Cells of dark edges and of punched holes, and whether the drawing runs into an edge."""

    edges: BoolCells
    holes: BoolCells
    run_into: BoolCells


def find_edges(cells: Cells) -> Edges:
    """What is dark along the sides of the picture and touches nothing of the drawing."""
    from scipy.ndimage import binary_dilation

    ink = cells.ink
    labels, boxes = cells.pieces
    short, away = min(ink.shape), depth(ink.shape)
    edges, holes, run_into = (np.zeros_like(ink) for _ in range(3))
    for number, box in enumerate(boxes, 1):
        at_side = any(side.start == 0 or side.stop == n for side, n in zip(box, ink.shape, strict=True))
        # The box alone excludes nearly all pieces.
        if not at_side and not _is_small(box, short):
            continue
        piece = labels[box] == number
        deepest = int(away[box][piece].max()) + 1
        if at_side:
            along = int((piece & (away[box] == 0)).sum())
            if deepest <= _DEEPEST * short and along >= deepest:
                edges[box] |= piece
            elif _is_deep_along_a_side(labels == number, cells.stroke):
                run_into[box] |= piece
        elif deepest <= _HOLE_DEPTH * short and _is_hole(piece, cells.stroke):
            holes[box] |= piece
    if not edges.any() and not holes.any():
        return Edges(edges, holes, run_into)
    rest = ink & ~edges & ~holes
    if not _is_large(rest):
        edges[:], holes[:] = False, False

    def grown(cut: BoolCells) -> BoolCells:
        """With its own blur; nothing of the drawing is nearer than that, or it would be one piece with it."""
        return binary_dilation(cut, np.ones((3, 3)), iterations=2) & ~rest if cut.any() else cut

    return Edges(grown(edges), grown(holes), run_into)


def _is_large(ink: BoolCells) -> bool:
    rows, columns = np.flatnonzero(ink.any(axis=1)), np.flatnonzero(ink.any(axis=0))
    return len(rows) > 0 and max(np.ptp(rows), np.ptp(columns)) > _LEAST_LEFT * max(ink.shape)


def _is_small(box: tuple[slice, slice], short: int) -> bool:
    """Whether a piece in this box is no larger than a hole."""
    return bool(max(side.stop - side.start for side in box) <= _HOLE_SIZE * short + 2)


def _is_hole(piece: BoolCells, stroke: float) -> bool:
    height, width = piece.shape
    size = max(height, width)
    round_enough = min(height, width) > 0.75 * size and piece.mean() > _DISC
    return bool(round_enough and size > _THICKER * stroke)


def _is_deep_along_a_side(piece: BoolCells, stroke: float) -> bool:
    """Whether a broad band of it lies along one side of the picture."""
    for turned in (piece, piece[::-1], piece.T, piece.T[::-1]):
        first = np.argmin(turned, axis=0)
        deep = np.where(turned.all(axis=0), len(turned), first)
        if (deep > _DEEP * stroke + 1).mean() > _ALONG:
            return True
    return False
