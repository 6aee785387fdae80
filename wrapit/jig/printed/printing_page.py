"""The page of the guide on printing the jig: which file, how, and what stands where on it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from wrapit.config import Config
from wrapit.geometry.bspline import chain_of
from wrapit.geometry.outlines.polygons import polygon_of
from wrapit.geometry.svgframe import SvgFrame, number
from wrapit.jig.made import MIRRORED, file_stem
from wrapit.jig.model import Jig, JigSet
from wrapit.wires.model import Wire

# A rule of thumb for each cm³ of the solid in PLA of 1.24 g/cm³, with what the page says: layers of 0.2 mm,
# two perimeters, 20 % infill. PrusaSlicer, so set, says 7.7 to 9.5 minutes (the larger the jig, the fewer)
# and 0.94 to 1.06 g of five of our pieces at 40, 60 and 90 mm.
MINUTES_PER_CM3 = 8.5
GRAMS_PER_CM3 = 0.99
# How large numbers stand on the picture, as a share of its longer side: over 11 px on a phone.
TEXT = 0.045
# How finely the plate is sampled for the picture's size.
SAMPLED_MM = 0.05


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

    `files` are what to print, one of them; `mirrored` those of the other earring. `pins` are (wire, mm
    along it, diameter in mm).
    """

    name: str
    files: tuple[str, ...]
    mirrored: tuple[str, ...]
    wires: tuple[int, ...]
    size_mm: tuple[float, float, float]
    minutes: float
    grams: float
    pins: tuple[tuple[str, float, float], ...]
    view_box: str
    plate: str
    walls: tuple[str, ...]
    courses: tuple[tuple[str, str], ...]
    starts: tuple[StartMark, ...]
    text_mm: str


def plan_print_page(jigs: JigSet, wires: Sequence[Wire], config: Config) -> tuple[PrintedJig, ...]:
    """What the page says of each jig."""
    return tuple(_printed(jig, len(jigs.jigs), wires, config) for jig in jigs.jigs)


def _printed(jig: Jig, count: int, wires: Sequence[Wire], config: Config) -> PrintedJig:
    mine = [wire for wire in wires if wire.name in jig.wires]
    left, bottom, right, top = polygon_of(jig.plate, SAMPLED_MM).bounds
    frame = SvgFrame.around(np.array([left, bottom]), np.array([right, top]), 1.0)
    text_mm = TEXT * max(frame.width_mm, frame.height_mm)
    volume_cm3 = jig.volume_mm3 / 1000
    return PrintedJig(
        name=jig.name,
        files=_files(jig.name, count, config, ""),
        mirrored=_files(jig.name, count, config, MIRRORED) if config.pair else (),
        wires=tuple(wire.number for wire in mine),
        size_mm=jig.size_mm,
        minutes=MINUTES_PER_CM3 * volume_cm3,
        grams=GRAMS_PER_CM3 * volume_cm3,
        pins=tuple(
            (pin.turn.wire, (pin.turn.start_mm + pin.turn.end_mm) / 2, pin.diameter_mm)
            for pin in jig.plan.pins
        ),
        view_box=frame.view_box,
        plate=frame.region(jig.plate),
        walls=tuple(frame.region(wall) for wall in jig.walls),
        courses=tuple((frame.path(chain_of(wire.centreline)), wire.colour) for wire in mine),
        starts=_starts(jig, mine, frame, text_mm),
        text_mm=number(text_mm),
    )


def _files(name: str, count: int, config: Config, suffix: str) -> tuple[str, ...]:
    """The files of one jig that a slicer takes, as the pipeline names them."""
    stem = file_stem(name, count) + suffix
    kinds = [kind for kind in ("3mf", "stl", "step") if kind in config.outputs]
    return tuple(f"{stem}.{kind}" for kind in kinds)


def _starts(jig: Jig, wires: Sequence[Wire], frame: SvgFrame, text_mm: float) -> tuple[StartMark, ...]:
    """A mark on each hole in which wires start, with their numbers."""
    starting: dict[tuple[float, float], list[str]] = {}
    for wire in wires:
        holes = [hole.centre for hole in jig.plan.holes if wire.name in hole.wires]
        nearest = min(holes, key=lambda centre: math.dist(centre, wire.ends[0]))
        starting.setdefault(nearest, []).append(str(wire.number))
    marks = []
    for centre, numbers in starting.items():
        (x, y), text = frame.at(centre), ", ".join(numbers)
        radius = text_mm * (0.45 + 0.3 * len(text))
        marks.append(StartMark(text, number(x), number(y), number(radius)))
    return tuple(marks)
