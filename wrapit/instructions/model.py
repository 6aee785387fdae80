"""The guide before it becomes a page or a print: steps, ties, strips, and what is to be had at hand."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from wrapit.instructions.order.moves import Move
from wrapit.pages.model import Block, Figure, Picture, Shape, Text
from wrapit.wires.model import Wire

StepKind = Literal["start", "shape", "end", "again", "lift", "place", "tie", "ends", "ring"]
Difficulty = Literal["easy", "medium", "hard"]


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
class Material:
    """Metal to have at hand, for all that the guide makes (two for a pair)."""

    use: Literal["frame", "binding", "ring"]
    diameter_mm: float
    length_mm: float
    mass_g: float


@dataclass(frozen=True)
class Crossing:
    """Where a wire passes over what already lies in the jig: `over` are numbers, its own for itself."""

    at_mm: float
    over: tuple[int, ...]


@dataclass(frozen=True, eq=False)
class Step:
    """One thing to do.

    Steps along a wire have its number, the span from `start_mm` to `end_mm` and the `moves` within; where
    the same is done several times on end, all moves are of one step that says how many `times`. `walls` are
    places among the bench's. `ties` are letters: those made now, or those that the wire passes.
    """

    kind: StepKind
    heading: Text
    texts: tuple[Text, ...]
    cautions: tuple[Text, ...] = ()
    wire: int = 0
    start_mm: float = 0.0
    end_mm: float = 0.0
    moves: tuple[Move, ...] = ()
    times: int = 1
    walls: tuple[int, ...] = ()
    crossings: tuple[Crossing, ...] = ()
    ties: tuple[str, ...] = ()
    figure: Figure | None = None


@dataclass(frozen=True, eq=False)
class Chapter:
    """Steps that belong together, as those of one wire; `anchor` is unique within the guide."""

    anchor: str
    heading: Text
    steps: tuple[Step, ...]


@dataclass(frozen=True)
class StripMark:
    """A mark on the ruler strip of a wire, in mm from the end that was cut.

    A wrap has its step's number, a tie its letter; only wraps have an extent.
    """

    start_mm: float
    end_mm: float
    label: str
    kind: Literal["start", "end", "wrap", "tie"]


@dataclass(frozen=True)
class Strip:
    """A strip at true size to lay a wire along before it is bent."""

    wire: int
    cut_mm: float
    marks: tuple[StripMark, ...]


@dataclass(frozen=True, eq=False)
class Page:
    """A page before or after the steps."""

    anchor: str
    title: Text
    blocks: tuple[Block, ...]


@dataclass(frozen=True, eq=False)
class Guide:
    """The whole guide: pages to get ready, then chapters of steps. `shared` are shapes of many pictures."""

    name: str
    lead: Text
    cover: Figure
    true_size: Picture
    pages: tuple[Page, ...]
    chapters: tuple[Chapter, ...]
    ties: tuple[Tie, ...]
    strips: tuple[Strip, ...]
    wires: tuple[Wire, ...]
    shared: Mapping[str, tuple[Shape, ...]]
    materials: tuple[Material, ...]
    difficulty: Difficulty
    minutes: float

    @property
    def steps(self) -> tuple[Step, ...]:
        """All steps in the order of the work; they are numbered from 1."""
        return tuple(step for chapter in self.chapters for step in chapter.steps)
