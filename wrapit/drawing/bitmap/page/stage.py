"""Leaves out what a picture shows around the drawing, and says so; refuses where it can't be told apart."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from wrapit.drawing.bitmap.image import GreyImage
from wrapit.drawing.bitmap.page.cells import BoolCells, Cells, cells_of, depth, painted, sides
from wrapit.drawing.bitmap.page.frames import find_frame
from wrapit.drawing.bitmap.page.ground import Ground, edge_of_light, find_ground
from wrapit.drawing.bitmap.page.scan_edges import Edges, find_edges
from wrapit.drawing.changes import Change, Notice
from wrapit.errors import DrawingError

# How many frames may lie in one another? Double and triple lines and a mat; more is a drawing of squares.
_MOST_FRAMES = 4
# What is a scanner's lid or the dark beside its glass, what a table? In shares of the paper's brightness, and
# no deeper than this share of the shorter side.
_LID = 0.35
_LID_DEPTH = 0.08
_CROP = "crop it off in a drawing program (GIMP: Crop Tool; Paint: Select, then Crop) if lines are missing"


@dataclass(frozen=True, eq=False)
class Page:
    """A picture of the drawing alone, and what was left out; places are pixels of the file."""

    grey: GreyImage
    changes: tuple[Change, ...]
    notices: tuple[Notice, ...]


def is_bright_page(grey: GreyImage) -> bool:
    """Whether a picture with a dark rim shows bright paper on a table or in a dark frame."""
    cells = cells_of(grey)
    low, high = np.percentile(cells.level, [1, 99])
    return float(np.median(cells.level)) > (low + high) / 2 or find_ground(cells) is not None


def drawing_alone(grey: GreyImage, where: str) -> Page:
    """The picture without table, dark edges, punched holes and frames.

    Raises DrawingError where lines run into a table, a shadow or a dark edge.
    """
    changes: list[Change] = []
    notices: list[Notice] = []

    def leave_out(cells: Cells, cut: BoolCells, code: str, message: str, remedy: str) -> None:
        at_px, length = _place(cut, cells.step)
        changes.append(Change(code, at_px, length, message))
        notices.append(Notice("note" if code == "dark-table" else "warning", code, at_px, message, remedy))

    cells = cells_of(grey)
    ground = find_ground(cells)
    if ground is not None:
        if ground.crossed:
            raise _runs_into_ground(ground, where)
        leave_out(cells, ground.where, *_about_ground(ground))
        grey = painted(grey, cells, ground.where)
        cells = cells_of(grey)
    lit = edge_of_light(cells)
    if lit.any():
        raise _edge_of_light(lit, cells.step, where)
    edges = find_edges(cells)
    if edges.run_into.any():
        raise _runs_into_edge(edges, where)
    if edges.edges.any():
        message = f"the dark edge of the picture {sides(edges.edges)} is left out"
        leave_out(cells, edges.edges, "dark-edge", message, _CROP)
    if edges.holes.any():
        message = "dark spots near the side of the picture are taken for punched holes and left out"
        leave_out(
            cells, edges.holes, "punched-holes", message, "connect them to the drawing if they belong to it"
        )
    if notices and (edges.edges.any() or edges.holes.any()):
        grey = painted(grey, cells, edges.edges | edges.holes)
        cells = cells_of(grey)
    for _ in range(_MOST_FRAMES):
        frame = find_frame(cells)
        if frame is None:
            break
        message = "the rectangle around the drawing is taken for its frame and left out"
        leave_out(cells, frame, "frame", message, "connect the drawing to it if it belongs to the piece")
        grey = painted(grey, cells, frame)
        cells = cells_of(grey)
    return Page(grey, tuple(changes), tuple(notices))


def _place(cut: BoolCells, step: int) -> tuple[tuple[float, float], float]:
    """Where the first of these cells is, and how long the side of their box, in pixels."""
    rows, columns = np.nonzero(cut)
    size = max(float(np.ptp(rows)), float(np.ptp(columns))) + 1
    return (float(columns[0] * step), float(rows[0] * step)), size * step


def _about_ground(ground: Ground) -> tuple[str, str, str]:
    where = sides(ground.where)
    if ground.level > 1:
        return "dark-table", f"the lighter ground around the paper ({where}) is left out", _CROP
    if _is_lid(ground):
        return "dark-edge", f"the dark edge of the picture {where} is left out", _CROP
    return "dark-table", f"the dark ground around the paper ({where}) is left out", _CROP


def _is_lid(ground: Ground) -> bool:
    deepest = int(depth(ground.where.shape)[ground.where].max())
    return ground.level < _LID and deepest < _LID_DEPTH * min(ground.where.shape)


def _runs_into_ground(ground: Ground, where: str) -> DrawingError:
    if _is_lid(ground):
        return _dark_edge(sides(ground.where), where)
    return DrawingError(
        f"lines run into the table under the paper or into a shadow's edge ({sides(ground.where)})",
        where,
        "photograph the whole paper in even light, or with a scanner app, and crop the photo to the paper",
    )


def _edge_of_light(lit: BoolCells, step: int, where: str) -> DrawingError:
    (x, y), _ = _place(lit, step)
    return DrawingError(
        f"a shadow's edge, or that of a sheet or table, crosses the picture at ({x:.0f}, {y:.0f}) px",
        where,
        "photograph the drawing in even light, or with a scanner app, and crop the photo to the paper",
    )


def _runs_into_edge(edges: Edges, where: str) -> DrawingError:
    return _dark_edge(sides(edges.run_into), where)


def _dark_edge(side: str, where: str) -> DrawingError:
    return DrawingError(
        f"lines run into the dark edge of the picture {side}",
        where,
        "crop the picture so that the edge is gone, or scan it again with the whole drawing on the glass",
    )
