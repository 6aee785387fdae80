"""The page of the guide on the board: which peg goes into which hole."""

from __future__ import annotations

from collections.abc import Sequence

from wrapit.decomposition.json_file import wire_number
from wrapit.geometry import Region
from wrapit.geometry.bspline import chain_of
from wrapit.geometry.outlines.loops import circle
from wrapit.jig.bench.from_above import LINE, bounds_of
from wrapit.jig.bench.model import Bench
from wrapit.jig.made import GuidePage
from wrapit.jig.pegs.model import PegPlan, hole_name
from wrapit.pages.model import (
    Block,
    Caution,
    Figure,
    Length,
    Paragraph,
    Picture,
    Points,
    Shape,
    Table,
    Text,
    Thickness,
    either,
    listed,
    text,
)
from wrapit.wires.model import Turn

# How large the board's holes are drawn: pegs' shanks differ from maker to maker.
HOLE_MM = 0.8


def peg_page(plan: PegPlan, bench: Bench, files: Sequence[str], *, pair: bool) -> GuidePage:
    """What the guide says of this board; `files` are those of the drawing at true size."""
    board = plan.board
    how = text("pegs-how", columns=board.columns, rows=board.rows, pitch=Length(board.pitch_mm))
    blocks: list[Block] = [Paragraph(how)]
    if files:
        blocks.append(Paragraph(text("pegs-file", files=either(files))))
    if pair:
        blocks.append(Caution(text("pegs-pair")))
    blocks += [Figure(_picture(plan, bench), text("pegs-picture"), text("pegs-caption")), _table(plan)]
    if plan.unserved:
        blocks.append(Paragraph(text("pegs-unserved", turns=len(plan.unserved))))
        blocks.append(Points(tuple(_place(turn) for turn in plan.unserved)))
    return GuidePage("pegs", text("pegs-title"), tuple(blocks))


def _table(plan: PegPlan) -> Table:
    rows = tuple(
        (
            text("plain", value=hole_name(peg.cell)),
            text("thickness", value=Thickness(peg.diameter_mm)),
            text("plain", value=listed(_place(turn) for turn, _ in peg.turns)),
        )
        for peg in plan.pegs
    )
    head = (text("pegs-head-hole"), text("pegs-head-peg"), text("pegs-head-round"))
    return Table(text("pegs-table"), head, rows)


def _place(turn: Turn) -> Text:
    middle = Length((turn.start_mm + turn.end_mm) / 2)
    return text("wire-at", wire=wire_number(turn.wire), at=middle)


def _picture(plan: PegPlan, bench: Bench) -> Picture:
    low, high, text_mm = bounds_of(bench.plate)
    board = plan.board
    cells = [(column, row) for column in range(board.columns) for row in range(board.rows)]
    holes = [Shape(Region(circle(board.place(cell), HOLE_MM / 2)), "hole") for cell in cells]
    pegs = [Shape(peg, "wall") for peg in bench.walls]
    lines = [Shape(chain_of(wire.centreline), "wire", wire.colour, LINE * text_mm) for wire in bench.wires]
    return Picture(low, high, text_mm, (Shape(bench.plate, "plate"), *holes, *pegs, *lines))
