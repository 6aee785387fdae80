"""A finished jig of any kind, as the rest of the program knows it: files, numbers, a page of the guide."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Final, Protocol, TypeVar

from wrapit.config import Config, JigKind
from wrapit.errors import Finding
from wrapit.geometry import FloatArray, Region
from wrapit.jig.bench.model import Handling
from wrapit.jig.contours import FlatDrawing
from wrapit.jig.model import Part
from wrapit.pages.model import Block, Text
from wrapit.wires.model import Wire

Wires = tuple[Wire, ...]
T = TypeVar("T")
R = TypeVar("R")


@dataclass(frozen=True, eq=False)
class View:
    """A jig from above with wires laid in; without a plate it is the wires alone. `stem` names the file.

    `taut` are the courses (m, 2) of wires that stray visibly when they are laid under tension; `heights_mm`
    are those of the walls over the plate, which is `plate_mm` thick.
    """

    stem: str
    wires: Wires
    walls: tuple[Region, ...] = ()
    plate: Region | None = None
    taut: tuple[FloatArray, ...] = ()
    heights_mm: tuple[float, ...] = ()
    plate_mm: float = 0.0


# What the names of files of the other earring end in.
MIRRORED: Final = "-mirrored"


def file_stem(name: str, count: int) -> str:
    """What the files of a jig are named, before their suffix: by its name where there are several."""
    return name if count > 1 else "jig"


@dataclass(frozen=True, eq=False)
class GuidePage:
    """A page of the guide about a jig: what to print, cut, glue or set, before wires are bent."""

    anchor: str
    title: Text
    blocks: tuple[Block, ...]


@dataclass(frozen=True, eq=False)
class Made:
    """A finished jig.

    `block` and `numbers` are its part of the report. `parts` are solids, one a printable body, `drawings`
    flat files. `views` show it from above, `handling` says what lies where for the steps of the guide.
    """

    block: str
    numbers: dict[str, Any]
    findings: tuple[Finding, ...]
    parts: tuple[Part, ...] = ()
    drawings: tuple[FlatDrawing, ...] = ()
    views: tuple[View, ...] = ()
    handling: Handling | None = None
    page: GuidePage | None = None


@dataclass(frozen=True, eq=False)
class Planned:
    """A jig before its solids: `views` show it already, `build` makes it; picklable."""

    views: tuple[View, ...]
    build: Callable[[], Made]


class Each(Protocol):
    """Makes something of each of several things, one by one or some elsewhere; all of it picklable."""

    def __call__(self, make: Callable[[T], R], things: Sequence[T], /) -> list[R]: ...


def one_by_one(make: Callable[[T], R], things: Sequence[T], /) -> list[R]:
    """`Each` in this process."""
    return [make(thing) for thing in things]


class Make(Protocol):
    """Makes a jig; `each` may have part of it done in another process."""

    def __call__(self, wires: Wires, config: Config, each: Each = one_by_one, /) -> Made: ...


@dataclass(frozen=True)
class JigMaker:
    """A kind of jig.

    `make` takes the wires of the piece as they lie in the jig, and raises JigError where no such jig can be
    made, UnheldError where it would hold too little. `held` is the share of the wires that
    it would hold, planned only. `solid` says that its parts are kernel solids: then `plan` does what needs no
    kernel, raises as `make` does, and returns what is built in the kernel's process, and
    `judge` looks at them once more, by other means, and raises KernelError where jig and wires have anything
    in common.
    """

    kind: JigKind
    solid: bool
    make: Make
    held: Callable[[Wires, Config], float]
    judge: Callable[[Made, Wires, Config], Made] | None = None
    plan: Callable[[Wires, Config], Planned] | None = None


def reported(value: float) -> float:
    """A number as the report gives it."""
    return round(float(value), 4)
