"""What a page of the guide says and shows, before it has a language, a unit or a medium."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal, TypeAlias

from wrapit.geometry import BezierChain, FloatArray, Region

Point: TypeAlias = tuple[float, float]


@dataclass(frozen=True)
class Length:
    """A length as a ruler gives it, said in the guide's unit."""

    mm: float


@dataclass(frozen=True)
class Span:
    """The length between two places of a ruler: the difference of what is read there."""

    start_mm: float
    end_mm: float


@dataclass(frozen=True)
class Thickness:
    """The thickness of wire or rod, with the gauge that shops sell where one fits (`wire`)."""

    mm: float
    wire: bool = False


@dataclass(frozen=True)
class Mass:
    """A weight."""

    g: float


@dataclass(frozen=True)
class Duration:
    """How long something takes, as roughly as that is known."""

    minutes: float


@dataclass(frozen=True)
class Listed:
    """Things one after the other: `a, b and c`, or `a, b or c`."""

    items: tuple[Value, ...]
    word: Literal["and", "or"] = "and"


@dataclass(frozen=True)
class Text:
    """A sentence or phrase by its key among the guide's texts, and what goes into it."""

    key: str
    values: tuple[tuple[str, Value], ...] = ()


Value: TypeAlias = str | int | float | Length | Span | Thickness | Mass | Duration | Listed | Text


def text(key: str, **values: Value) -> Text:
    """`text("cut", wire=2, length=Length(87))`."""
    return Text(key, tuple(values.items()))


def listed(items: Iterable[Value]) -> Listed:
    """Things one after the other."""
    return Listed(tuple(items))


def either(items: Iterable[Value]) -> Listed:
    """Things of which one will do."""
    return Listed(tuple(items), "or")


Style = Literal[
    "plate", "wall", "wall-now", "wire", "earlier", "later", "edge", "present", "arrow", "hole", "ring"
]


@dataclass(frozen=True, eq=False)
class Shape:
    """Something drawn: a curve, a polyline (n, 2) or a flat piece, in mm with y up.

    `width_mm` is that of a line; a `colour` overrides the style's.
    """

    geometry: BezierChain | FloatArray | Region
    style: Style
    colour: str = ""
    width_mm: float = 0.0


@dataclass(frozen=True, eq=False)
class Shared:
    """Shapes that many pictures show, by their key; lines get a style and width of each picture's own."""

    key: str
    style: Style | None = None
    colour: str = ""
    width_mm: float = 0.0


@dataclass(frozen=True)
class Mark:
    """A short text in a disc, or bare where `bare`; a leader runs from it to its `anchor`."""

    text: str
    at: Point
    kind: Literal["number", "tie", "bare", "dot"]
    anchor: Point | None = None
    colour: str = ""


@dataclass(frozen=True, eq=False)
class Picture:
    """A drawing from above; text is `text_mm` high, a share of the picture, so that it reads on any piece."""

    low: Point
    high: Point
    text_mm: float
    shapes: tuple[Shape | Shared, ...]
    marks: tuple[Mark, ...] = ()


@dataclass(frozen=True)
class Paragraph:
    """A few sentences."""

    text: Text


@dataclass(frozen=True)
class Caution:
    """What to mind."""

    text: Text


@dataclass(frozen=True)
class Heading:
    """Of a part of a page."""

    text: Text


@dataclass(frozen=True)
class Facts:
    """Names and what goes with them."""

    rows: tuple[tuple[Text, Text], ...]


@dataclass(frozen=True)
class Points:
    """A list; `numbered` where the order counts."""

    items: tuple[Text, ...]
    numbered: bool = False


@dataclass(frozen=True)
class Table:
    """Rows of texts under a head; the first cell names the row."""

    caption: Text
    head: tuple[Text, ...]
    rows: tuple[tuple[Text, ...], ...]


@dataclass(frozen=True, eq=False)
class Figure:
    """A picture with its words: `label` for who can't see it, `caption` for who can."""

    picture: Picture
    label: Text
    caption: Text | None = None


Block: TypeAlias = Paragraph | Caution | Heading | Facts | Points | Table | Figure
