"""The page of the guide on the board: which peg goes into which hole."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from wrapit.geometry.bspline import chain_of
from wrapit.geometry.outlines.loops import circle
from wrapit.geometry.svgframe import SvgFrame, number
from wrapit.jig.pegs.model import PegPlan, hole_name
from wrapit.wires.model import Wire


@dataclass(frozen=True)
class PegLine:
    """A peg: its hole, its diameter, and what is bent round it as (wire, at mm)."""

    hole: str
    diameter_mm: float
    turns: tuple[tuple[str, float], ...]


@dataclass(frozen=True)
class PegPage:
    """What the page says and shows; `circles` are paths of pegs, `holes` places, as SVG has them."""

    pitch_mm: float
    columns: int
    rows: int
    pegs: tuple[PegLine, ...]
    unserved: tuple[tuple[str, float], ...]
    view_box: str
    wires: tuple[tuple[str, str], ...]
    circles: tuple[str, ...]
    holes: tuple[tuple[str, str], ...]


def plan_peg_page(plan: PegPlan, wires: tuple[Wire, ...]) -> PegPage:
    """The page of this board."""
    board = plan.board
    left, bottom, right, top = board.corners
    frame = SvgFrame.around(np.array([left, bottom]), np.array([right, top]), 1.0)
    cells = [(column, row) for column in range(board.columns) for row in range(board.rows)]
    return PegPage(
        pitch_mm=board.pitch_mm,
        columns=board.columns,
        rows=board.rows,
        pegs=tuple(
            PegLine(
                hole_name(peg.cell),
                peg.diameter_mm,
                tuple((turn.wire, (turn.start_mm + turn.end_mm) / 2) for turn, _ in peg.turns),
            )
            for peg in plan.pegs
        ),
        unserved=tuple((turn.wire, (turn.start_mm + turn.end_mm) / 2) for turn in plan.unserved),
        view_box=frame.view_box,
        wires=tuple((frame.path(chain_of(wire.centreline)), wire.colour) for wire in wires),
        circles=tuple(frame.outline(circle(board.place(peg.cell), peg.diameter_mm / 2)) for peg in plan.pegs),
        holes=tuple((number(x), number(y)) for x, y in (frame.at(board.place(cell)) for cell in cells)),
    )
