"""Seats: round pockets in the plate that hold beads or stones while wire is laid round them."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from wrapit.config import JigConfig, SeatConfig
from wrapit.errors import Finding, JigError
from wrapit.geometry.bspline import chain_of
from wrapit.jig.channel import Channels
from wrapit.jig.model import Seat
from wrapit.jig.openings.room import FOOT_MM, PLATE_WEB_MM
from wrapit.jig.wall_height import wall_height_mm
from wrapit.wires.model import Wire, WireBead

# Plate under a pocket: four layers of 0.2 mm, so that it doesn't print as a hole.
FLOOR_MM = 0.8
# A bead that reaches less than a layer of print into the plate needs no pocket.
_LAYER_MM = 0.2
# How deep a bead sits that is sewn on: as one that the config names.
_SEWN_MM = float(SeatConfig.model_fields["depth"].default)
# What helps where a bead has no seat.
_BY_HAND = "put the bead on when the wire is out of the jig, or make the piece larger"


def seats_of(config: JigConfig, diameter_mm: float) -> tuple[Seat, ...]:
    """The seats as they are built: pockets wider than the beads by the clearance all round.

    A post is as high as the walls beside wire of this diameter, but never higher than the bead.
    """
    walls_mm = wall_height_mm(1, diameter_mm, config)
    return tuple(
        Seat(
            seat.at,
            seat.diameter,
            seat.diameter + 2 * config.clearance,
            seat.depth,
            seat.post,
            max(0.0, min(walls_mm, seat.diameter - seat.depth)),
        )
        for seat in config.seats
    )


def check_seats(channels: Channels, config: JigConfig) -> None:
    """Raises JigError, naming the seat, where one can't be built or is in the way of a wire or another."""
    planned = seats_of(config, channels.diameter_mm)
    for seat, built in zip(config.seats, planned, strict=True):
        _check_size(seat, config)
        _check_wires(channels, built)
    for first, second in itertools.combinations(planned, 2):
        apart = math.dist(first.centre, second.centre) - (first.diameter_mm + second.diameter_mm) / 2
        if apart < PLATE_WEB_MM:
            raise JigError(
                f"it and the seat at {_xy(second)} are nearer than {PLATE_WEB_MM:g} mm",
                f"seat at {_xy(first)}",
                f"move one by {PLATE_WEB_MM - apart:.1f} mm or more",
            )


def check_holes(seats: Sequence[Seat], rims: Any) -> None:
    """Raises JigError where a start hole (shapely geometry of all) runs into a pocket."""
    for seat in seats:
        web = rims.distance(_disc(seat, 0.0))
        if web < PLATE_WEB_MM:
            raise JigError(
                "a wire ends there, and its start hole would run into the pocket",
                f"seat at {_xy(seat)}",
                f"move it {PLATE_WEB_MM - web:.1f} mm or more away from the wire's end, or make it smaller",
            )


def seat_obstacles(seats: Sequence[Seat], around_mm: float = FOOT_MM) -> Any:
    """Where nothing else may stand because of the seats, as shapely geometry."""
    import shapely

    return shapely.union_all([_disc(seat, around_mm) for seat in seats])


def seats_near(group: Sequence[Wire], wires: Sequence[Wire], config: JigConfig) -> JigConfig:
    """The config of the jig for a group of the wires: its seats are those that one of them passes nearest."""
    import shapely

    if not config.seats or len(group) == len(wires):
        return config
    lines = [shapely.LineString(chain_of(wire.centreline).sampled(0.05)) for wire in wires]
    seats = []
    for seat in config.seats:
        middle = shapely.Point(seat.at)
        apart = [line.distance(middle) for line in lines]
        if wires[apart.index(min(apart))] in group:
            seats.append(seat)
    return config.model_copy(update={"seats": tuple(seats)})


def bead_seats(
    wires: Sequence[Wire], config: JigConfig, taken: Any
) -> tuple[tuple[Seat, ...], tuple[Finding, ...]]:
    """Seats for the beads that have room for one beside what is `taken` (shapely); notes about the others.

    A threaded bead's middle is at the wire's height: its pocket lets the wire lie on the plate, and goes
    through where less than `FLOOR_MM` would be left.
    """
    channels = Channels.of(tuple(wires), config)
    seats: list[Seat] = []
    said: list[Finding] = []
    for wire in wires:
        for bead, place in zip(wire.beads, wire.bead_places, strict=True):
            seat = _under(wire, bead, (float(place[0]), float(place[1])), config)
            if seat.depth_mm < _LAYER_MM:
                continue
            problem = _problem(seat, seats, taken, channels)
            if problem:
                said.append(_told("bead-without-seat", wire, bead, problem, _BY_HAND))
                continue
            seats.append(seat)
            below_mm = seat.depth_mm - config.base_thickness
            if below_mm > wire.diameter_mm:
                problem = f"the bead reaches {below_mm:.1f} mm through the plate"
                remedy = f"lay the jig on two strips, or set jig.base_thickness to {seat.depth_mm:.1f} mm"
                said.append(_told("bead-below-plate", wire, bead, problem, remedy))
    return tuple(seats), tuple(said)


def mirrored_seats(config: JigConfig) -> JigConfig:
    """The config of the mirrored jig: seats with left and right exchanged."""
    seats = tuple(seat.model_copy(update={"at": (-seat.at[0], seat.at[1])}) for seat in config.seats)
    return config.model_copy(update={"seats": seats})


def _check_size(seat: SeatConfig, config: JigConfig) -> None:
    where = f"seat at ({seat.at[0]:g}, {seat.at[1]:g}) mm"
    if seat.depth > config.base_thickness - FLOOR_MM + 1e-9:
        raise JigError(
            f"a pocket of {seat.depth:g} mm leaves less than {FLOOR_MM:g} mm of the plate under it",
            where,
            f"make it {config.base_thickness - FLOOR_MM:.1f} mm deep or less, or raise jig.base_thickness",
        )
    if seat.post and not config.min_wall_width <= seat.post < seat.diameter / 2:
        raise JigError(
            f"a post of {seat.post:g} mm can't be printed in a pocket of {seat.diameter:g} mm",
            where,
            f"make it from {config.min_wall_width:g} mm to half the bead's diameter, or leave it out",
        )


def _check_wires(channels: Channels, seat: Seat) -> None:
    """A pocket reaches under no wire."""
    point = np.array([seat.centre])
    near = channels.outliner.curves.nearest(point, seat.diameter_mm / 2 + 2 * channels.diameter_mm)
    short = (seat.diameter_mm + channels.diameter_mm) / 2 - float(near.distance[0])
    if short <= 1e-9:
        return
    smaller = f", or make it {2 * short:.1f} mm smaller" if 4 * short < seat.diameter_mm else ""
    raise JigError(
        f"a wire passes {float(near.distance[0]):.1f} mm from its middle and would lie over the pocket",
        f"seat at {_xy(seat)}",
        f"move it {short:.1f} mm away from the wire{smaller}",
    )


def _under(wire: Wire, bead: WireBead, place: tuple[float, float], config: JigConfig) -> Seat:
    pocket_mm = bead.diameter_mm + 2 * config.clearance
    if bead.threaded:
        height_mm = wire.diameter_mm / 2 + float(wire.heights_mm(np.array([bead.at_mm]))[0])
        depth_mm = bead.diameter_mm / 2 + config.clearance - height_mm
        if depth_mm > config.base_thickness - FLOOR_MM:
            depth_mm = max(depth_mm, config.base_thickness)
    else:
        depth_mm = min(_SEWN_MM, bead.diameter_mm / 2, config.base_thickness - FLOOR_MM)
    return Seat(place, bead.diameter_mm, pocket_mm, depth_mm, 0.0, 0.0, bead.threaded)


def _problem(seat: Seat, seats: Sequence[Seat], taken: Any, channels: Channels) -> str:
    """Why a seat has no room; nothing where it has."""
    outline = seat_obstacles([seat], 0.0)
    if outline.distance(taken) < PLATE_WEB_MM:
        return "it is too near to a start hole or another seat for a pocket"
    if any(outline.distance(seat_obstacles([other], 0.0)) < PLATE_WEB_MM for other in seats):
        return "it is too near to another bead for a pocket"
    if not seat.threaded:
        reach_mm = seat.diameter_mm / 2 + channels.diameter_mm
        near = channels.outliner.curves.nearest(np.array([seat.centre]), reach_mm)
        if float(near.distance[0]) < (seat.diameter_mm + channels.diameter_mm) / 2 - 1e-9:
            return "a wire would lie over its pocket"
    return ""


def _told(code: str, wire: Wire, bead: WireBead, message: str, remedy: str) -> Finding:
    where = f"{wire.name} at {bead.at_mm:.0f} mm"
    return Finding(
        "note",
        code,
        where,
        f"{message} (bead of {bead.diameter_mm:g} mm)",
        remedy,
        wire=wire.name,
        places_mm=(bead.at_mm,),
    )


def _disc(seat: Seat, around_mm: float) -> Any:
    import shapely

    return shapely.Point(seat.centre).buffer(seat.diameter_mm / 2 + around_mm, quad_segs=32)


def _xy(seat: Seat) -> str:
    return f"({seat.centre[0]:g}, {seat.centre[1]:g}) mm"
