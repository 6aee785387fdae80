"""The guide's pictures: each jig from above with its wires, and the piece as it comes together."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from wrapit.geometry import BezierChain, FloatArray, joined
from wrapit.geometry.arclength import piece
from wrapit.geometry.bspline import chain_of
from wrapit.geometry.label_places import Label, place_labels
from wrapit.geometry.outlines.loops import Region, as_chain, circle
from wrapit.instructions.model import Step, Tie
from wrapit.jig.bench.from_above import DISC, INK_MM, LINE, bounds_of, framed, ink_of, start_marks, with_room
from wrapit.jig.bench.model import Bench
from wrapit.pages.model import Figure, Mark, Picture, Point, Shape, Shared, Text, text
from wrapit.wires.model import JumpRing, Wire

# Widths of lines in shares of the text's height: of the present stretch, of its dark edge, of the arrow.
PRESENT, EDGE, ARROW = 0.3, 0.52, 0.16
# Length of an arrow's barbs, and how far each stands off the line.
BARB, BARB_RAD = 0.75, 0.5
# How far around its place ink matters to a label, in heights of text: farther off it would name nothing.
NEAR = 10.0
# Height of text on the print at true size: read at arm's length, and small beside the wires.
PRINTED_TEXT_MM = 2.6
# More letters of ties than this hide a piece of usual size; they stand in the steps' pictures too.
PRINTED_TIES = 12


@dataclass(frozen=True, eq=False)
class Scene:
    """What pictures show of wires in one place: a jig, or the bare piece where `bench` is None.

    `key` begins the keys of its shared shapes.
    """

    key: str
    wires: tuple[Wire, ...]
    bench: Bench | None
    low: Point
    high: Point
    text_mm: float

    @staticmethod
    def of_bench(key: str, bench: Bench) -> Scene:
        """A jig."""
        return Scene(key, bench.wires, bench, *bounds_of(bench.plate))

    @staticmethod
    def of_piece(key: str, wires: Sequence[Wire], ties: Iterable[Tie] = ()) -> Scene:
        """The wires as they are in the piece, with room for the letters of ties."""
        low, high, text_mm = framed(np.vstack([chain_of(w.centreline).sampled(INK_MM) for w in wires]), 1.0)
        boxes = [low, high]
        for label in tie_labels(ties, ink_of(wires, text_mm), text_mm):
            (x, y), (half_x, half_y) = label.centre, label.half_size
            boxes += [(x - half_x, y - half_y), (x + half_x, y + half_y)]
        low, high, text_mm = framed(np.array(boxes), 0.5 * text_mm)
        return Scene(key, tuple(wires), None, low, high, text_mm)

    @cached_property
    def ink(self) -> FloatArray:
        """Points (n, 2) all along the wires, which labels keep off."""
        return ink_of(self.wires, self.text_mm)

    @property
    def shared(self) -> dict[str, tuple[Shape, ...]]:
        """Its shapes that many pictures show: plate and walls as one, and each wire."""
        wires: dict[str, tuple[Shape, ...]] = {
            self.wire_key(wire.number): (Shape(chain_of(wire.centreline), "wire"), *_beads(wire))
            for wire in self.wires
        }
        if self.bench is None:
            return wires
        walls = tuple(Shape(wall, "wall") for wall in self.bench.walls)
        return {self.key: (Shape(self.bench.plate, "plate"), *walls), **wires}

    def wire_key(self, number: int) -> str:
        """Key of one wire's line."""
        return f"{self.key}-{number}"

    def line(self, wire: Wire, width: float = LINE) -> Shared:
        """A wire in its colour."""
        return Shared(self.wire_key(wire.number), "wire", wire.colour, width * self.text_mm)

    def picture(self, shapes: Iterable[Shape | Shared], marks: Iterable[Mark] = ()) -> Picture:
        """A picture in this scene."""
        return with_room(Picture(self.low, self.high, self.text_mm, tuple(shapes), tuple(marks)))


def _beads(wire: Wire) -> Iterator[Shape]:
    """The rims of a wire's beads, drawn as the wire is."""
    for bead, (x, y) in zip(wire.beads, wire.bead_places.tolist(), strict=True):
        rim = circle((x, y), (bead.diameter_mm - wire.diameter_mm) / 2)
        yield Shape(joined(as_chain(edge) for edge in rim.edges), "wire")


def step_figure(scene: Scene, step: Step, wire: Wire, earlier: Iterable[int], ties: Sequence[Tie]) -> Figure:
    """A step along a wire: what lies already, what is bent now and which way, round which walls."""
    chain = chain_of(wire.centreline)
    end_mm = min(step.end_mm, chain.length)
    start_mm = min(step.start_mm, end_mm - 1e-3)
    now = piece(chain, max(0.0, start_mm), end_mm)
    laid = set(earlier)
    shapes: list[Shape | Shared] = []
    if scene.bench is not None:
        shapes.append(Shared(scene.key))
        shapes += [Shape(scene.bench.walls[index], "wall-now") for index in step.walls]
    shapes += [
        Shared(scene.wire_key(each.number), "earlier", each.colour, LINE * scene.text_mm)
        for each in scene.wires
        if each.number in laid
    ]
    shapes.append(Shared(scene.wire_key(wire.number), "later", "", LINE * scene.text_mm))
    if start_mm > 1e-3:
        shapes.append(Shape(piece(chain, 0.0, start_mm), "earlier", wire.colour, LINE * scene.text_mm))
    shapes += _present(now, wire.colour, scene.text_mm)
    marks = tuple(_marks(scene, ties, str(wire.number), chain.start))
    words = text("picture-step", wire=wire.number, start=step.start_mm, end=step.end_mm)
    return Figure(scene.picture(shapes, marks), words)


def _present(now: BezierChain, colour: str, text_mm: float) -> Iterator[Shape]:
    """The stretch that is bent now, with a dark edge and an arrow at its end."""
    yield Shape(now, "edge", "", EDGE * text_mm)
    yield Shape(now, "present", colour, PRESENT * text_mm)
    heading = math.atan2(*(float(value) for value in now.end_tangent[::-1]))
    barbs = [
        now.end - BARB * text_mm * np.array([math.cos(heading + turn), math.sin(heading + turn)])
        for turn in (BARB_RAD, -BARB_RAD)
    ]
    yield Shape(np.array([barbs[0], now.end, barbs[1]]), "arrow", "", ARROW * text_mm)


def piece_figure(
    scene: Scene,
    words: Text,
    *,
    laid: Iterable[int],
    now: Iterable[int] = (),
    marks: Iterable[Mark] = (),
    ring: JumpRing | None = None,
    caption: Text | None = None,
) -> Figure:
    """The piece with the wires that lie already, and those that are laid or tied now."""
    present, lying = set(now), set(laid)
    shapes: list[Shape | Shared] = []
    for wire in scene.wires:
        if wire.number in present:
            shapes.append(Shared(scene.wire_key(wire.number), "edge", "", EDGE * scene.text_mm))
            shapes.append(
                Shared(scene.wire_key(wire.number), "present", wire.colour, PRESENT * scene.text_mm)
            )
        elif wire.number in lying:
            shapes.append(scene.line(wire))
        else:
            shapes.append(Shared(scene.wire_key(wire.number), "later", "", LINE * scene.text_mm))
    if ring is not None:
        shapes.append(Shape(Region(circle(ring.point, ring.radius_mm)), "ring", "", ring.diameter_mm))
    return Figure(scene.picture(shapes, marks), words, caption)


def cover_figure(scene: Scene, words: Text, caption: Text, ring: JumpRing | None) -> Figure:
    """The finished piece, each wire in its colour with its number where it starts."""
    everything = [wire.number for wire in scene.wires]
    return piece_figure(
        scene,
        words,
        laid=everything,
        marks=start_marks(scene.wires, scene.text_mm),
        ring=ring,
        caption=caption,
    )


def true_size_picture(scene: Scene, ties: Iterable[Tie]) -> Picture:
    """The piece with wires as thick as they are, to lay them on: numbers at starts, letters of a few ties."""
    ties = tuple(ties)
    wanted = [(str(wire.number), wire.ends[:1]) for wire in scene.wires]
    starts = place_labels(wanted, scene.ink, DISC * PRINTED_TEXT_MM)
    shown = ties if len(ties) <= PRINTED_TIES else ()
    wanted = [(tie.letter, np.array([tie.point])) for tie in shown]
    letters = place_labels(wanted, scene.ink, DISC * PRINTED_TEXT_MM, starts)
    marks = [Mark(label.text, label.centre, "number", label.anchor) for label in starts]
    marks += [Mark(label.text, label.centre, "tie", label.anchor) for label in letters]
    thick = max(wire.diameter_mm for wire in scene.wires)
    centres = np.array([mark.at for mark in marks])
    cloud = np.vstack([scene.ink, centres - PRINTED_TEXT_MM, centres + PRINTED_TEXT_MM])
    low, high, _ = framed(cloud, thick)
    lines = [
        Shared(scene.wire_key(wire.number), "wire", wire.colour, wire.diameter_mm) for wire in scene.wires
    ]
    return Picture(low, high, PRINTED_TEXT_MM, tuple(lines), tuple(marks))


def tie_labels(ties: Iterable[Tie], cloud: FloatArray, text_mm: float) -> tuple[Label, ...]:
    """Places for the letters of ties, clear of the wires (n, 2)."""
    return place_labels([(tie.letter, np.array([tie.point])) for tie in ties], cloud, DISC * text_mm)


def tie_marks(scene: Scene, ties: Sequence[Tie]) -> Mapping[str, Mark]:
    """The mark of each tie by its letter, with a leader to its place."""
    labels = tie_labels(ties, scene.ink, scene.text_mm)
    return {label.text: Mark(label.text, label.centre, "tie", label.anchor) for label in labels}


def _marks(scene: Scene, ties: Sequence[Tie], number: str, start: FloatArray) -> Iterator[Mark]:
    """The wire's number beside its start, and the letters of ties, none on another."""
    places = [start, *(np.array(tie.point) for tie in ties)]
    near = np.min([np.abs(scene.ink - place).max(axis=1) for place in places], axis=0)
    ink = scene.ink[near < NEAR * scene.text_mm]
    (beside,) = place_labels([(number, start[None])], ink, DISC * scene.text_mm)
    yield Mark(number, beside.centre, "number", beside.anchor)
    wanted = [(tie.letter, np.array([tie.point])) for tie in ties]
    for label in place_labels(wanted, ink, DISC * scene.text_mm, (beside,)):
        yield Mark(label.text, label.centre, "tie", label.anchor)
