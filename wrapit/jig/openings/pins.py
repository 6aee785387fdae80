"""Pins for turns that are too tight for a wall: a nail or a piece of rod in the plate bends the wire."""

from __future__ import annotations

import math
from typing import Any

from wrapit.config import JigConfig
from wrapit.jig.channel import Channels
from wrapit.jig.model import Pin
from wrapit.jig.openings.room import PLATE_WEB_MM
from wrapit.jig.paired.hairpins import is_hairpin
from wrapit.jig.wall_ground import TOUCH_MM, face_probes
from wrapit.wires.model import Turn

# Which pins there are: rods and drills come in steps of 0.1 mm; no measurement set the thinnest.
SMALLEST_PIN_MM = 0.6
PIN_STEP_MM = 0.1
# A turn with wall along this share needs no pin (30 % up or down changes no pin of leaf and butterfly).
HELD = 0.5
# Where the tightest place of a turn is looked for: a tenth of the smallest pin and less.
STEP_MM = 0.05
# How far a pin may reach into a channel: polygons of pin and channel err by less.
TOUCHING_MM = 0.02


def pin_holes(channels: Channels, config: JigConfig, holes: Any, walls: Any) -> tuple[Pin, ...]:
    """A pin in the middle of each turn that is narrower than the narrowest wall and that no wall holds.

    In a hairpin also where a post would be wide enough but too small to print: its neck is closed.

    `walls` is what could be printed without pins: between legs that part, a wall's tip can be narrower
    than its foot, and then it holds the turn better than a pin.

    None where not even the thinnest pin fits, or where it would stand in a wire's way or in a start hole.
    """
    import shapely

    if not config.pins:
        return ()
    pins: list[Pin] = []
    taken = holes
    for turn in channels.turns:
        pin = _pin(channels, turn, config)
        if pin is None or _held(channels, turn, walls) >= HELD:
            continue
        disc = shapely.Point(pin.centre).buffer(pin.diameter_mm / 2)
        if _in_the_way(channels, turn, disc.buffer(-TOUCHING_MM)) or taken.intersects(
            disc.buffer(PLATE_WEB_MM)
        ):
            continue
        pins.append(pin)
        taken = taken.union(disc)
    return tuple(pins)


def pin_discs(pins: tuple[Pin, ...]) -> list[Any]:
    """The pins themselves, as shapely geometry."""
    import shapely

    return [shapely.Point(pin.centre).buffer(pin.diameter_mm / 2, quad_segs=16) for pin in pins]


def pin_obstacles(pins: tuple[Pin, ...]) -> Any:
    """Where no wall may stand because of the pins."""
    import shapely

    return shapely.union_all(
        [shapely.Point(pin.centre).buffer(pin.diameter_mm / 2 + PLATE_WEB_MM, quad_segs=16) for pin in pins]
    )


def _in_the_way(channels: Channels, turn: Turn, disc: Any) -> bool:
    """Whether a pin stands nearer to its wire than a wall would, or nearer to another than the clearance."""
    mine = channels.index[turn.wire]
    return any(
        channels.around(index, channels.face_mm if index == mine else channels.reach_mm).intersects(disc)
        for index in range(len(channels.wires))
    )


def _held(channels: Channels, turn: Turn, walls: Any) -> float:
    """The share of a turn's inside that has a wall."""
    import shapely

    probes = shapely.points(face_probes(channels, turn, STEP_MM, TOUCH_MM))
    return float(shapely.contains(walls, probes).mean())


def _pin(channels: Channels, turn: Turn, config: JigConfig) -> Pin | None:
    if turn.stretch or turn.max_curvature_per_mm <= 0:
        return None
    side = 1.0 if turn.inside == "left" else -1.0
    _, points, normals, curvature = channels.stations(turn, STEP_MM)
    tightest = int((side * curvature).argmax())
    bend = float(side * curvature[tightest])
    if bend <= 0:
        return None
    room = 2 * (1 / bend - channels.face_mm)
    diameter = math.floor(room / PIN_STEP_MM + 1e-6) * PIN_STEP_MM
    hairpin = is_hairpin(turn, channels.wires[channels.index[turn.wire]])
    small = hairpin and math.pi / 4 * room**2 < config.min_wall_area
    if (room >= config.min_wall_width and not small) or diameter < SMALLEST_PIN_MM - 1e-9:
        return None
    centre = points[tightest] + side / bend * normals[tightest]
    return Pin(turn, (float(centre[0]), float(centre[1])), round(diameter, 6))
