"""The printed jig: turns, walls, plate and holes."""

from __future__ import annotations

import math
from typing import Annotated, Literal

from pydantic import Field

from wrapit.config.block import Block
from wrapit.config.quantities import Point, angle, curvature, duration, length, number


class SeatConfig(Block):
    """A round pocket in the printed jig that holds a bead or a stone while wire is laid round it."""

    at: Point
    """Its middle, such as `[12 mm, 30 mm]`: a point of the drawing, as in `drawing.json` (y up)."""

    diameter: Annotated[float, length("0.3 mm", "200 mm", "6 mm")]
    """Of the bead or stone; the pocket is wider by the clearance on each side.

    Wires pass its middle at half the pocket and half their own thickness or more.
    """

    depth: Annotated[float, length("0.1 mm", "50 mm", "1.5 mm")] = 1.5
    """How deep it sits in the plate."""

    post: Annotated[float, length("0 mm", "50 mm", "1.2 mm")] = 0.0
    """Diameter of a post in its middle, a little thinner than the hole of a drilled bead; 0 mm for none."""


class JigConfig(Block):
    """The printed jig (paper, section 5)."""

    support: Literal["taut", "turns"] = "taut"
    """Where walls stand.

    `taut`: on the inside of turns, and wherever else a wire laid under tension would stray from the drawing.
    `turns`: on the inside of turns and of long stretches (the paper's rule).
    """

    taut_tolerance: Annotated[float, length("0.05 mm", "5 mm", "0.35 mm")] = 0.35
    """Where a wire laid under tension would stray further it gets another wall (`support: taut`)."""

    room: Annotated[float, length("0 mm", "20 mm", "2 mm")] = 2.0
    """Free ground for the fingers on the side of a wire that needs no wall (`support: taut`)."""

    turn_curvature: Annotated[float, curvature("0.001 /mm", "10 /mm", "0.08 /mm")] = 0.08
    """A wire needs a wall where it bends more sharply than this (0.08 /mm is a radius of 12.5 mm)."""

    turn_angle: Annotated[float, angle("0 deg", "360 deg", "25 deg")] = math.radians(25)
    """Turns that bend the wire by less in total get no wall."""

    long_segment: Annotated[float, length("0.5 mm", "1000 mm", "20 mm")] = 20.0
    """Straighter stretches longer than this get a wall too, on their inside (`support: turns`)."""

    split: Literal["auto", "single", "per-wire"] = "auto"
    """One jig for all wires, or several; auto splits where a single jig would hold a wire badly."""

    max_strays: Annotated[float, number(0, 1)] = 0.08
    """Auto splits when a wire laid under tension would lie over 0.5 mm off the drawing along more than this
    share of its length (`support: taut`)."""

    min_turn_support: Annotated[float, number(0, 1)] = 0.6
    """Auto splits when a wire would have wall along less than this share of its turns (`support: turns`)."""

    split_turn_support: Annotated[float, number(0, 1)] = 0.9
    """Once split, wires share a jig only if each has wall along this share of its turns (or can't alone)."""

    least_support: Annotated[float, number(0, 1)] = 0.3
    """A piece can't be made as asked when the first of `jigs` would hold less than this share of its wires'
    length; 0 makes it all the same. A wire that is held less, and a further kind of jig that would hold less
    and is left out, are errors in the report.
    """

    wall_thickness: Annotated[float, length("0.2 mm", "50 mm", "3.5 mm")] = 3.5
    """Thickness of the walls, where there is room for it."""

    clearance: Annotated[float, length("0 mm", "5 mm", "0.2 mm")] = 0.2
    """Gap between a wire and a wall that it passes."""

    inside_gap: Annotated[float, length("0 mm", "5 mm", "0.1 mm")] = 0.1
    """Gap between a wire and the wall that it is wrapped on and lies on; never more than the clearance."""

    min_wall_width: Annotated[float, length("0.05 mm", "20 mm", "0.8 mm")] = 0.8
    """Thinner walls can't be printed and are dropped."""

    post_bends: bool = True
    """Round corners of the drawing at least so wide that a post of `min_wall_width` fits inside the bend."""

    min_wall_area: Annotated[float, number(0, 1_000)] = 2.0
    """Smaller walls (mm²) can't be printed and are dropped."""

    min_wall_height: Annotated[float, length("0.1 mm", "100 mm", "4 mm")] = 4.0
    """Walls are at least this high; where wires cross they get room for one layer more."""

    lead_in: Annotated[float, length("0 mm", "10 mm", "0.3 mm")] = 0.3
    """The top of each wall is set back by this much, over as much of its height, to let wire in easily."""

    plate: Literal["fitted", "rectangle"] = "fitted"
    """The printed plate's outline.

    `fitted`: it follows the piece at the margin, without bays narrower than 12 mm.
    `rectangle`: a box with rounded corners. Laser-cut plates are boxes always.
    """

    base_thickness: Annotated[float, length("0.2 mm", "100 mm", "2.4 mm")] = 2.4
    """Thickness of the plate; 2.4 mm are twelve layers of 0.2 mm, and hold."""

    margin: Annotated[float, length("0.1 mm", "200 mm", "3 mm")] = 3.0
    """Plate around the walls and wires; without any, walls end on its edge and the solid is not sound."""

    corner_radius: Annotated[float, length("0 mm", "200 mm", "3 mm")] = 3.0
    """Rounding of the plate's corners; a fitted plate's margin is no less, so that all are as round."""

    min_hole: Annotated[float, length("0.1 mm", "50 mm", "2 mm")] = 2.0
    """Smallest start hole; thicker wires get their diameter + 0.5 mm."""

    tail_slot: Annotated[float, length("0 mm", "50 mm", "0.8 mm")] = 0.8
    """Start holes are this much longer in the direction of the wire's tail, so that it can be bent down."""

    springback: Literal["report", "compensate"] = "report"
    """What to do about wire that opens a little when it is let go.

    `report`: the jig has the shape of the drawing, and the guide says how much further to bend.
    `compensate`: the jig bends each wire further, by what metal and temper spring back
    (curvature + 3.395 · proof stress / (E · diameter)), so that the wire let go has the shape of the
    drawing. Overbent wires don't meet where they are drawn, so each gets a jig of its own.
    """

    pins: bool = True
    """Holes for pins inside turns that are too tight for a wall."""

    seats: tuple[SeatConfig, ...] = Field(default=(), max_length=200)
    """Seats for beads or stones, `[{at: [12 mm, 30 mm], diameter: 6 mm}]`; the laser-cut jig has none."""

    numbers: bool = True
    """Engrave each wire's number beside the hole where it starts."""

    course: bool = True
    """Mark each wire's course on the printed plate: a groove under it, with an arrow head near its start.

    Wires thinner than 0.67 mm have none: they would sink into a groove that a nozzle of 0.4 mm leaves open.
    """

    screw_hole: Annotated[float, length("0 mm", "20 mm", "3 mm")] = 0.0
    """Diameter of four screw holes, as far out on the plate as they have a rim; 0 mm for none."""

    bed_width: Annotated[float, length("20 mm", "5 m", "220 mm")] = 220.0
    """Width of the printer's bed."""

    bed_depth: Annotated[float, length("20 mm", "5 m", "220 mm")] = 220.0
    """Depth of the printer's bed."""

    time_limit: Annotated[float, duration("1 s", "24 h", "120 s")] | None = None
    """How long making the jig's solids may take; 120 s and 60 s more for each wire unless given."""

    stl_tolerance: Annotated[float, length("0.0001 mm", "1 mm", "0.005 mm")] = 0.005
    """Largest distance of the STL's facets from the true surface."""
