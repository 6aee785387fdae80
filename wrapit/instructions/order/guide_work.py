"""What is laid: the piece's wires, the jigs with theirs, ties, and what was found of the jigs."""

from __future__ import annotations

from dataclasses import dataclass

from wrapit.errors import Finding
from wrapit.instructions.model import Tie
from wrapit.jig.bench.model import Bench, Handling
from wrapit.jig.model import SameShape
from wrapit.wires.model import JumpRing, Wire


@dataclass(frozen=True, eq=False)
class Work:
    """What is laid: the piece's wires, the jigs with theirs, ties, and what was found of the jigs.

    `prefix` begins the anchors and picture keys: the other one of a pair has its own. `bridges` are segments
    that the drawing didn't have.
    """

    prefix: str
    wires: tuple[Wire, ...]
    handling: Handling | None
    ties: tuple[Tie, ...]
    findings: tuple[Finding, ...]
    ring: JumpRing | None
    bridges: frozenset[int] = frozenset()
    of_pair: bool = False

    @property
    def benches(self) -> tuple[Bench, ...]:
        """The jigs."""
        return self.handling.benches if self.handling is not None else ()

    @property
    def forms(self) -> tuple[SameShape, ...]:
        """Wires that are made in another's place."""
        return self.handling.forms if self.handling is not None else ()

    def named(self, name: str) -> Wire:
        """The wire of the piece with this name."""
        return next(wire for wire in self.wires if wire.name == name)
