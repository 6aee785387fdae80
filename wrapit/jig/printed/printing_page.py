"""The page of the guide on printing the jig: which file, how, and what stands where on it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from wrapit.config import Config
from wrapit.geometry.bspline import chain_of
from wrapit.geometry.svgframe import SvgFrame, number
from wrapit.jig.made import file_stem
from wrapit.jig.model import Jig, JigSet
from wrapit.wires.model import Wire

# A rule of thumb for each cm³ of the solid in PLA, layers of 0.2 mm, two perimeters and a fifth of infill.
# PrusaSlicer says 6.2 to 7.4 minutes (the larger the jig, the fewer) and 1.10 to 1.17 g of five of our pieces
# at 40, 60 and 90 mm.
MINUTES_PER_CM3 = 6.8
GRAMS_PER_CM3 = 1.13
# How large numbers stand on the picture, as a share of its longer side: over 11 px on a phone.
TEXT = 0.045


@dataclass(frozen=True)
class StartMark:
    """Where wires start: their numbers, and the place on the picture with its size, as SVG has them."""

    text: str
    x: str
    y: str
    radius: str


@dataclass(frozen=True)
class PrintedJig:
    """One jig to print, and its picture: path data of plate, walls and (path, colour) of wires.

    `files` are what to print, one of them; `mirrored` those of the other earring. `pins` are (wire, at mm,
    diameter).
    """

    name: str
    files: tuple[str, ...]
    mirrored: tuple[str, ...]
    wires: tuple[int, ...]
    size_mm: tuple[float, float, float]
    minutes: float
    grams: float
    pins: tuple[tuple[int, float, float], ...]
    seats: int
    view_box: str
    plate: str
    walls: tuple[str, ...]
    courses: tuple[tuple[str, str], ...]
    starts: tuple[StartMark, ...]
    text_mm: str


@dataclass(frozen=True)
class PrintPage:
    """The whole page."""

    jigs: tuple[PrintedJig, ...]
    material: str = "PLA or PETG"


def plan_print_page(jigs: JigSet, wires: Sequence[Wire], config: Config) -> PrintPage:
    """The page of these jigs."""
    return PrintPage(tuple(_printed(jig, len(jigs.jigs), wires, config) for jig in jigs.jigs))


def _printed(jig: Jig, count: int, wires: Sequence[Wire], config: Config) -> PrintedJig:
    mine = [wire for wire in wires if wire.name in jig.wires]
    low, high = (np.array(corner) for corner in np.split(np.array(_bounds(jig)), 2))
    frame = SvgFrame.around(low, high, 1.0)
    text_mm = TEXT * max(frame.width_mm, frame.height_mm)
    number_of = {wire.name: wire.number for wire in mine}
    volume_cm3 = jig.volume_mm3 / 1000
    return PrintedJig(
        name=jig.name,
        files=_files(jig.name, count, config, ""),
        mirrored=_files(jig.name, count, config, "-mirrored") if config.pair else (),
        wires=tuple(number_of.values()),
        size_mm=jig.size_mm,
        minutes=MINUTES_PER_CM3 * volume_cm3,
        grams=GRAMS_PER_CM3 * volume_cm3,
        pins=tuple(
            (number_of[pin.turn.wire], (pin.turn.start_mm + pin.turn.end_mm) / 2, pin.diameter_mm)
            for pin in jig.plan.pins
        ),
        seats=len(jig.plan.seats),
        view_box=frame.view_box,
        plate=frame.region(jig.plate),
        walls=tuple(frame.region(wall) for wall in jig.walls),
        courses=tuple((frame.path(chain_of(wire.centreline)), wire.colour) for wire in mine),
        starts=_starts(jig, mine, frame, text_mm),
        text_mm=number(text_mm),
    )


def _bounds(jig: Jig) -> tuple[float, float, float, float]:
    from wrapit.geometry.outlines.polygons import polygon_of

    bounds: tuple[float, float, float, float] = polygon_of(jig.plate, 0.05).bounds
    return bounds


def _files(name: str, count: int, config: Config, suffix: str) -> tuple[str, ...]:
    """The files of one jig that a slicer takes, as the pipeline names them."""
    stem = file_stem(name, count) + suffix
    kinds = [kind for kind in ("3mf", "stl", "step") if kind in config.outputs]
    return tuple(f"{stem}.{kind}" for kind in kinds)


def _starts(jig: Jig, wires: Sequence[Wire], frame: SvgFrame, text_mm: float) -> tuple[StartMark, ...]:
    """A mark on each hole in which wires start, with their numbers."""
    marks = []
    for hole in jig.plan.holes:
        starting = [
            str(wire.number)
            for wire in wires
            if wire.name in hole.wires and _nearest(wire, jig) == hole.centre
        ]
        if starting:
            x, y = frame.at(hole.centre)
            text = ", ".join(starting)
            radius = text_mm * (0.45 + 0.3 * len(text))
            marks.append(StartMark(text, number(x), number(y), number(radius)))
    return tuple(marks)


def _nearest(wire: Wire, jig: Jig) -> tuple[float, float]:
    """The centre of the hole in which a wire starts."""
    start = wire.ends[0]
    holes = [hole for hole in jig.plan.holes if wire.name in hole.wires]
    return min(holes, key=lambda hole: float(np.hypot(*(np.array(hole.centre) - start)))).centre
