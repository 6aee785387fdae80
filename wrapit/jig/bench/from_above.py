"""A jig from above as a picture: plate, walls, wires, and each wire's number where it starts."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from wrapit.geometry import FloatArray, Region
from wrapit.geometry.bspline import chain_of
from wrapit.geometry.label_places import place_labels
from wrapit.jig.bench.model import Bench
from wrapit.pages.model import Mark, Picture, Point, Shape
from wrapit.wires.model import Wire

# How high text stands on a picture, as a share of its longer side: over 11 px on a phone of 360.
TEXT = 0.045
# How wide wires are drawn on it, in shares of the text's height, so that walls stay visible beside them.
LINE = 0.16
# Across a letter's disc, in heights of text.
DISC = 1.25
# How finely wires are sampled where labels keep off them, at least: an eighth of the text's height will do.
INK_MM = 0.2
# How finely plates are sampled for a picture's size.
SAMPLED_MM = 0.05
# Starts nearer than this share one hole, and one disc with both numbers.
ONE_HOLE_MM = 1.6


def bench_picture(bench: Bench) -> Picture:
    """The jig with the wires of the guide laid in."""
    low, high, text_mm = bounds_of(bench.plate)
    walls = [Shape(wall, "wall") for wall in bench.walls]
    lines = [Shape(chain_of(wire.centreline), "wire", wire.colour, LINE * text_mm) for wire in bench.wires]
    shapes = (Shape(bench.plate, "plate"), *walls, *lines)
    return with_room(Picture(low, high, text_mm, shapes, start_marks(bench.wires, text_mm)))


def with_room(picture: Picture) -> Picture:
    """The picture with its bounds where its marks need them."""
    corners = [picture.low, picture.high]
    for mark in picture.marks:
        (x, y), reach = mark.at, disc_mm(mark.text, picture.text_mm) * 1.1
        corners += [(x - reach, y - reach), (x + reach, y + reach)]
    low, high, _ = framed(np.array(corners), 0.0)
    return replace(picture, low=low, high=high)


def bounds_of(region: Region) -> tuple[Point, Point, float]:
    """Lower left and upper right corner of a picture around a flat piece, and its text's height."""
    outline = region.outer.sampled(SAMPLED_MM)
    return framed(outline, 1.0)


def framed(points: FloatArray, margin_mm: float) -> tuple[Point, Point, float]:
    """The same around points (n, 2)."""
    low, high = points.min(axis=0) - margin_mm, points.max(axis=0) + margin_mm
    text_mm = TEXT * float(np.max(high - low))
    return (float(low[0]), float(low[1])), (float(high[0]), float(high[1])), text_mm


def start_marks(wires: Sequence[Wire], text_mm: float) -> tuple[Mark, ...]:
    """A disc on each place where wires start, with their numbers; beside it where discs would touch."""
    starting: list[tuple[Point, list[str]]] = []
    for wire in wires:
        start = (float(wire.ends[0][0]), float(wire.ends[0][1]))
        shared = next((found for found in starting if math.dist(found[0], start) < ONE_HOLE_MM), None)
        if shared is None:
            starting.append((start, [str(wire.number)]))
        else:
            shared[1].append(str(wire.number))
    marks = [Mark(", ".join(numbers), at, "number") for at, numbers in starting]
    crowded = [mark for mark in marks if any(_touch(mark, other, text_mm) for other in marks)]
    if not crowded:
        return tuple(marks)
    ink = ink_of(wires, text_mm)
    wanted = [(mark.text, np.array([mark.at])) for mark in marks]
    labels = place_labels(wanted, ink, DISC * text_mm)
    return tuple(Mark(label.text, label.centre, "number", label.anchor) for label in labels)


def ink_of(wires: Sequence[Wire], text_mm: float) -> FloatArray:
    """Points (n, 2) all along the wires, near enough to one another that no label slips between."""
    step_mm = max(INK_MM, text_mm / 8)
    return np.vstack([chain_of(wire.centreline).sampled(step_mm) for wire in wires])


def disc_mm(letters: str, text_mm: float) -> float:
    """Radius of the disc behind a mark's text: around one letter, more for each further one."""
    return text_mm * (DISC / 2 + 0.3 * (len(letters) - 1))


def _touch(mark: Mark, other: Mark, text_mm: float) -> bool:
    apart = math.dist(mark.at, other.at)
    return other is not mark and apart < disc_mm(mark.text, text_mm) + disc_mm(other.text, text_mm)
