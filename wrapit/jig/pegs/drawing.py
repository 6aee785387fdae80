"""The board as a drawing at true size: to print and lay under the board, or to engrave on one."""

from __future__ import annotations

from wrapit.geometry.bspline import chain_of
from wrapit.geometry.outlines.loops import circle, rounded_rectangle
from wrapit.jig.contours import Contour, FlatDrawing
from wrapit.jig.lettering import engraved_text, text_size_mm
from wrapit.jig.pegs.model import PegPlan, hole_name
from wrapit.wires.model import Wire

# Holes are marked, not drawn in full: pegs' shanks differ from maker to maker.
MARK_MM = 0.8
# Legible on a print at true size; smaller where a peg is thinner than its size is wide.
TEXT_MM = 2.0


def board_drawing(plan: PegPlan, wires: tuple[Wire, ...]) -> FlatDrawing:
    """`pegs`: board and holes on SCORE; wires, pegs with their diameters, and the holes' names on ENGRAVE."""
    left, bottom, right, top = plan.board.corners
    shift = (-left, -bottom)

    def at(point: tuple[float, float]) -> tuple[float, float]:
        return point[0] + shift[0], point[1] + shift[1]

    board = plan.board
    contours = [Contour("SCORE", rounded_rectangle(0.0, 0.0, right - left, top - bottom, 3.0).edges)]
    for column in range(board.columns):
        for row in range(board.rows):
            contours.append(Contour("SCORE", circle(at(board.place((column, row))), MARK_MM / 2).edges))
    for wire in wires:
        contours.append(Contour("ENGRAVE", (chain_of(wire.centreline),)).moved(0, shift))
    for peg in plan.pegs:
        x, y = at(board.place(peg.cell))
        contours.append(Contour("ENGRAVE", circle((x, y), peg.diameter_mm / 2).edges))
        inside = peg.diameter_mm > 2.2 * TEXT_MM
        text_mm = TEXT_MM if inside else 0.7 * TEXT_MM
        place = (x, y) if inside else (x, y + peg.diameter_mm / 2 + text_mm)
        contours += _size(peg.diameter_mm, place, text_mm)
    for column in range(board.columns):
        x, _ = at(board.place((column, 0)))
        contours += engraved_text(hole_name((column, 0)).rstrip("1"), (x, TEXT_MM), TEXT_MM)
    for row in range(board.rows):
        _, y = at(board.place((0, row)))
        contours += engraved_text(f"{row + 1}", (TEXT_MM, y), TEXT_MM)
    return FlatDrawing("pegs", "Board with pegs", tuple(contours), right - left, top - bottom)


def _size(diameter_mm: float, centre: tuple[float, float], text_mm: float) -> list[Contour]:
    """A diameter with a point that is seen: with the font's own, of a tenth of a mm, 1.6 reads as 16."""
    whole, _, parts = f"{diameter_mm:g}".partition(".")
    if not parts:
        return [*engraved_text(whole, centre, text_mm)]
    gap_mm, dot_mm = 0.3 * text_mm, 0.18 * text_mm
    left_mm, right_mm = (text_size_mm(text, text_mm)[0] for text in (whole, parts))
    start = centre[0] - (left_mm + right_mm + 2 * gap_mm + 2 * dot_mm) / 2
    dot = (start + left_mm + gap_mm + dot_mm, centre[1] - text_mm / 2 + dot_mm)
    return [
        *engraved_text(whole, (start + left_mm / 2, centre[1]), text_mm),
        Contour("ENGRAVE", circle(dot, dot_mm).edges),
        *engraved_text(parts, (dot[0] + dot_mm + gap_mm + right_mm / 2, centre[1]), text_mm),
    ]
