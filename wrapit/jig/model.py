"""The jig: first a plan in the plane (no kernel), then solids."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, Literal

from shapely import Polygon

from wrapit.geometry import FloatArray, Loop, Region
from wrapit.geometry.outlines.loops import circle
from wrapit.wires.model import Turn

# A wire off by more than this is seen to be off: half a wire's thickness.
SEEN_MM = 0.5


@dataclass(frozen=True, eq=False)
class Wall:
    """A wall in the plan: its polygon, channels cut, right to about 1e-3 mm; the face is made from it."""

    turns: tuple[Turn, ...]
    outline: Polygon
    height_mm: float


@dataclass(frozen=True)
class Hole:
    """A through hole for wire ends; `outline` is exact and includes the slots for the tails.

    `centre` and `diameter_mm` are those of the round part; ends too near for holes of their own share one.
    """

    centre: tuple[float, float]
    diameter_mm: float
    wires: tuple[str, ...]
    outline: Loop


@dataclass(frozen=True, eq=False)
class Plate:
    """The base plate."""

    outline: Region
    thickness_mm: float


@dataclass(frozen=True)
class Pin:
    """A hole for a pin inside a turn that is too tight for a wall."""

    turn: Turn
    centre: tuple[float, float]
    diameter_mm: float


@dataclass(frozen=True)
class Seat:
    """A round pocket in the plate for a bead; `threaded` says that a wire over it runs through the bead.

    The post in it is `post_mm` thick (0 is none) and rises `post_height_mm` over the plate.
    """

    centre: tuple[float, float]
    bead_mm: float
    diameter_mm: float
    depth_mm: float
    post_mm: float
    post_height_mm: float
    threaded: bool = False

    @property
    def pocket(self) -> Loop:
        """Outline of the pocket."""
        return circle(self.centre, self.diameter_mm / 2)


@dataclass(frozen=True, eq=False)
class Label:
    """A wire's number, engraved as flat pockets."""

    text: str
    strokes: tuple[Region, ...]
    depth_mm: float


@dataclass(frozen=True, eq=False)
class Groove:
    """Where the wires run, engraved as flat grooves with arrow heads."""

    strokes: tuple[Region, ...]
    depth_mm: float


@dataclass(frozen=True, eq=False)
class JigPlan:
    """Which walls, holes, pins, labels and plate a jig for these wires has, and how they lie in it taut."""

    name: str
    wires: tuple[str, ...]
    walls: tuple[Wall, ...]
    holes: tuple[Hole, ...]
    plate: Plate
    pins: tuple[Pin, ...] = ()
    labels: tuple[Label, ...] = ()
    screw_holes: tuple[Loop, ...] = ()
    seats: tuple[Seat, ...] = ()
    laid: tuple[Course, ...] = ()
    groove: Groove | None = None

    @property
    def ground(self) -> Region:
        """The plate with what goes through it: holes, screw holes and pockets."""
        openings = [*(hole.outline for hole in self.holes), *self.screw_holes]
        openings += [seat.pocket for seat in self.seats]
        return Region(self.plate.outline.outer, tuple(openings))


@dataclass(frozen=True)
class TurnSupport:
    """Share of a turn's or long stretch's arc length that has wall at the right distance inside."""

    turn: Turn
    share: float


@dataclass(frozen=True)
class Hold:
    """How well a jig holds one wire: the supported share of its turns, the share of its length that strays.

    A wire strays where, laid under tension, it lies more than half a millimetre off the drawing.
    """

    turns: float
    strays: float


@dataclass(frozen=True, eq=False)
class Course:
    """How one wire lies when it is laid under tension.

    `taut` (m, 2) is its course, `at_mm` (n,) are places along the drawn wire, `drawn` (n, 2) their points,
    `off_mm` (n,) how far from each the taut wire passes.
    """

    wire: str
    taut: FloatArray
    at_mm: FloatArray
    drawn: FloatArray
    off_mm: FloatArray

    @property
    def share_off(self) -> float:
        """Share of the wire that lies more than SEEN_MM off."""
        return float((self.off_mm > SEEN_MM).mean())


def straying(laid: Iterable[Course]) -> tuple[FloatArray, ...]:
    """The courses (m, 2) of wires that lie visibly off somewhere."""
    return tuple(course.taut for course in laid if course.share_off > 0)


@dataclass(frozen=True)
class SameShape:
    """A wire that has the shape of another, `like`; `mirrored`: once it is turned over.

    `reversed` says that its end lies where the other starts.
    """

    wire: str
    like: str
    mirrored: bool
    reversed: bool = False


@dataclass(frozen=True, eq=False)
class Part:
    """A named, coloured solid; `solid` is a kernel shape that only `wrapit.kernel` looks into.

    `box_mm` are its least and its greatest x, y and z, (3,) each.
    """

    name: str
    solid: Any
    colour: str
    box_mm: tuple[FloatArray, FloatArray]


@dataclass(frozen=True, eq=False)
class Jig:
    """One printable body with its proof: what was measured on the exact result.

    `walls` are the exact wall faces after cutting, `plate` the plate's upper face, less holes and seats,
    `hemmed` the share of the wires' length with a wall close by on both sides.
    """

    name: str
    wires: tuple[str, ...]
    part: Part
    walls: tuple[Region, ...]
    plate: Region
    plan: JigPlan
    valid: bool
    solids: int
    volume_mm3: float
    support: tuple[TurnSupport, ...]
    min_wall_to_wire_mm: float | None
    hemmed: float
    size_mm: tuple[float, float, float]


@dataclass(frozen=True, eq=False)
class JigSet:
    """All jigs of a piece; `split` is "per-wire" as soon as the wires are parted over several jigs.

    `forms` are wires that another's jig serves, as they have its shape. `overbent` says that they bend each
    wire further than drawn, by what it springs back.
    """

    split: Literal["single", "per-wire"]
    jigs: tuple[Jig, ...]
    forms: tuple[SameShape, ...] = ()
    overbent: bool = False
