"""A jig as it lies on the bench: what the steps of the guide need to know of it, whatever its kind."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Final, Literal

from wrapit.geometry import Region
from wrapit.jig.model import SameShape
from wrapit.wires.model import Side, Wire

Around = Literal["wall", "pin", "peg", "run"]
# The index of what is no wall of the bench.
NO_WALL: Final = -1


@dataclass(frozen=True)
class Contact:
    """A span of a wire, by arc length, that lies round something on one `side` of it.

    `index` counts the bench's walls (pins and pegs are among them); a run that lies there has NO_WALL.
    `label` is a peg's hole, and `rod_mm` the thickness of pin or peg.
    """

    start_mm: float
    end_mm: float
    side: Side
    around: Around
    index: int
    label: str = ""
    rod_mm: float = 0.0


@dataclass(frozen=True, eq=False)
class Bench:
    """One jig: its wires as they lie in it, its walls from above, and along each wire what it lies round.

    `anchored` says that tails go down into holes; `unmarked` are wires whose number is not engraved.
    """

    name: str
    wires: tuple[Wire, ...]
    walls: tuple[Region, ...]
    plate: Region
    contacts: Mapping[str, tuple[Contact, ...]]
    anchored: bool = True
    unmarked: frozenset[str] = frozenset()
    seats_mm: tuple[float, ...] = ()
    """Each bead's size, where the jig holds beads or stones."""


@dataclass(frozen=True, eq=False)
class Handling:
    """All jigs of one kind: those in which the wires of a piece are made.

    `forms` are wires that another's place serves, as they have its shape. `overbent`: the jigs bend each
    wire further than drawn, by what it springs back.
    """

    benches: tuple[Bench, ...]
    forms: tuple[SameShape, ...] = field(default=())
    overbent: bool = False
