"""A board with pegs: which hole takes a peg of which thickness, for which turn."""

from __future__ import annotations

from dataclasses import dataclass

from wrapit.wires.model import Turn

Cell = tuple[int, int]


@dataclass(frozen=True)
class Board:
    """Holes at `origin` + (column, row) · pitch, columns and rows from 0; it reaches `margin` beyond them."""

    origin: tuple[float, float]
    pitch_mm: float
    columns: int
    rows: int
    margin_mm: float

    def place(self, cell: Cell) -> tuple[float, float]:
        """Where a hole is, in the piece's coordinates."""
        return self.origin[0] + cell[0] * self.pitch_mm, self.origin[1] + cell[1] * self.pitch_mm

    @property
    def corners(self) -> tuple[float, float, float, float]:
        """Left, bottom, right, top of the board."""
        (left, bottom), (right, top) = self.place((0, 0)), self.place((self.columns - 1, self.rows - 1))
        margin = self.margin_mm
        return left - margin, bottom - margin, right + margin, top + margin


@dataclass(frozen=True)
class Peg:
    """A peg in a hole, and the turns bent round it, each with the share of it that follows the peg."""

    cell: Cell
    diameter_mm: float
    turns: tuple[tuple[Turn, float], ...]


@dataclass(frozen=True)
class PegPlan:
    """The board, its pegs from the lower left, and the turns that no peg serves."""

    board: Board
    pegs: tuple[Peg, ...]
    unserved: tuple[Turn, ...]

    @property
    def held_share(self) -> float:
        """The share of the length of all turns that follows a peg; 1 where nothing turns.

        Straighter stretches need no peg: wire between two pegs is straight by itself.
        """
        served = [(turn.end_mm - turn.start_mm, share) for peg in self.pegs for turn, share in peg.turns]
        total = sum(length for length, _ in served) + sum(t.end_mm - t.start_mm for t in self.unserved)
        return sum(length * share for length, share in served) / total if total > 0 else 1.0


def hole_name(cell: Cell) -> str:
    """A hole as the board has it: column letters, row number from 1.

    >>> hole_name((0, 0)), hole_name((27, 4))
    ('A1', 'AB5')
    """
    letters, column = "", cell[0] + 1
    while column:
        column, digit = divmod(column - 1, 26)
        letters = chr(ord("A") + digit) + letters
    return f"{letters}{cell[1] + 1}"
