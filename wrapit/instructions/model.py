"""The guide before it becomes a page: what to prepare, bend, lay and tie, in order."""

from __future__ import annotations

from dataclasses import dataclass

from wrapit.wires.model import JumpRing, Wire


@dataclass(frozen=True)
class Material:
    """Something to have at hand."""

    what: str
    thickness: str
    length_mm: float
    mass_g: float
    note: str


@dataclass(frozen=True)
class Tie:
    """A place where passes of wire are bound together; `wires` are numbers, `passes` strands."""

    letter: str
    junction: int
    point: tuple[float, float]
    wires: tuple[int, ...]
    passes: int
    binding_mm: float


@dataclass(frozen=True)
class Step:
    """One stretch of a wire, from one meeting place to the next."""

    number: int
    start_mm: float
    end_mm: float
    action: str
    arrival: str


@dataclass(frozen=True, eq=False)
class WireSheet:
    """Everything about the making of one wire; `ties` are met in this order, at mm from the mark.

    `same_as` says which other wire's form it is made on, if it has that one's shape; `hole` is the number at
    the hole where it starts. `cautions` are what to do by hand where the jig alone doesn't do it.
    """

    number: int
    wire: Wire
    thickness: str
    tail_mm: float
    jig: str
    same_as: str
    hole: int
    overbend: str
    steps: tuple[Step, ...]
    cautions: tuple[str, ...]
    ties: tuple[tuple[Tie, float], ...]


@dataclass(frozen=True)
class Placement:
    """One stage of the assembly: lay this wire, then make these ties."""

    wire: int
    joins: tuple[int, ...]
    ties: tuple[Tie, ...]


@dataclass(frozen=True, eq=False)
class Guide:
    """The whole guide."""

    name: str
    size_mm: tuple[float, float]
    metal: str
    temper: str
    materials: tuple[Material, ...]
    sheets: tuple[WireSheet, ...]
    ties: tuple[Tie, ...]
    assembly: tuple[Placement, ...]
    binding_turns: int
    ring: JumpRing | None = None
    seats: tuple[str, ...] = ()
    """Each bead's size, where the jig holds beads or stones."""
