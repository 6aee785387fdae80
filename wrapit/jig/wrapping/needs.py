"""Which walls are needed: on the inside of sharp turns, and wherever else a taut wire would stray.

The paper (section 5) puts walls on the inside of turns and leaves the ground around them free to wrap. Here
the wire is laid under tension round these walls (`courses`); where it would stray, another wall is put on
the side it strays to, and so on until it lies as drawn.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from wrapit.config import JigConfig
from wrapit.errors import Finding
from wrapit.geometry.arrays import runs
from wrapit.jig.channel import Channels
from wrapit.jig.model import Course
from wrapit.jig.paired.between import carried
from wrapit.jig.wall_ground import wall_polygons
from wrapit.jig.wrapping.courses import courses
from wrapit.jig.wrapping.free_sides import free_sides
from wrapit.wires.model import Side, Turn

# How long a piece of wall is added at a time: the next longer one where a wall of that length is planned
# already, but doesn't stand, or doesn't help. Planned is what is planned but for SAME_MM at its ends.
PIECES_MM = (4.0, 8.0, 12.0)
SAME_MM = 0.5
# A wire that strays further than FAR has lost its way round what should hold it: it gets pieces all along,
# each APART from the next, as what is between may do without. What bends by less than STRAIGHT is straight.
FAR_MM = 2.0
APART_MM = 12.0
STRAIGHT_RAD = 0.03
# What strays by this much more or less strays alike: walls' corners are round to 5e-3 mm.
ALIKE_MM = 0.02
# Walls on one side of a wire with less between them are one: as a multiple of the narrowest wall.
JOINED = 3.0
# What walls may hold of spans (`Channels.walled`).
_Walled = Callable[[Iterable[Turn]], tuple[Turn, ...]]
# Rounds of adding walls, after which what strays is reported as it is.
ROUNDS = 60


@dataclass(frozen=True, eq=False)
class NeededWalls:
    """Walls with the spans that they hold, what was dropped, and how the wires lie round them.

    `room` is the free ground for fingers (shapely), None where none was asked for.
    """

    polygons: tuple[tuple[Any, tuple[Turn, ...]], ...]
    findings: tuple[Finding, ...]
    held: tuple[Turn, ...]
    room: Any
    laid: tuple[Course, ...]


def planned_walls(
    channels: Channels, config: JigConfig, obstacles: Any, pins: Sequence[Any] = ()
) -> NeededWalls:
    """The walls that `config.support` asks for, and how the wires lie round them and round `pins` (shapely).

    No wall stands on the `obstacles` (shapely).
    """
    if config.support == "taut":
        walls = _needed(channels, config, obstacles, pins)
    else:
        walls = _standing(channels, config, obstacles, pins, channels.turns)
    return replace(walls, laid=carried(channels, walls.laid))


def _needed(channels: Channels, config: JigConfig, obstacles: Any, pins: Sequence[Any]) -> NeededWalls:
    """As little wall as keeps each taut wire within `taut_tolerance` of the drawing, where there is room."""
    apart_mm = JOINED * config.min_wall_width
    walled = channels.walled
    held = walled(_joined(channels.turns, apart_mm))
    for _ in range(ROUNDS):
        walls = _standing(channels, config, obstacles, pins, held)
        more = [
            piece for course in walls.laid for piece in _more(course, config.taut_tolerance, held, walled)
        ]
        if not more:
            break
        held = walled(_joined([*held, *more], apart_mm))
    return walls


def _standing(
    channels: Channels, config: JigConfig, obstacles: Any, pins: Sequence[Any], held: tuple[Turn, ...]
) -> NeededWalls:
    with_room = config.support == "taut" and config.room > 0
    free = free_sides(channels, held, config.room) if with_room else None
    polygons, dropped = wall_polygons(channels, config, obstacles, held, free)
    laid = courses(channels, [*(polygon for polygon, _ in polygons), *pins])
    return NeededWalls(tuple(polygons), dropped, held, free, laid)


def _more(course: Course, tolerance_mm: float, held: Sequence[Turn], walled: _Walled) -> Iterator[Turn]:
    """Pieces of wall for each stretch that strays: where it strays furthest, and at others where it does far.

    A place that has a wall already gets the next longer one, and at last none.
    """
    for first, last in runs(course.off_mm > tolerance_mm):
        chosen: list[float] = []
        off_mm = course.off_mm[first : last + 1]
        for furthest in first + np.argsort(-np.round(off_mm / ALIKE_MM), kind="stable"):
            if chosen and course.off_mm[furthest] <= FAR_MM:
                break
            at_mm = _middle(course, int(furthest))
            if all(abs(at_mm - other) >= APART_MM for other in chosen):
                chosen.append(at_mm)
                yield from _piece(course, at_mm, held, walled)


def _middle(course: Course, place: int) -> float:
    """Where the middle is of all that strays about as far around a place: rounding doesn't choose."""
    over_mm = course.off_mm - (course.off_mm[place] - ALIKE_MM)
    less = np.flatnonzero(over_mm < 0)
    before, after = less[less < place], less[less > place]
    alike = slice(int(before[-1]) + 1 if len(before) else 0, int(after[0]) if len(after) else len(over_mm))
    return float(np.average(course.at_mm[alike], weights=over_mm[alike]))


def _piece(course: Course, at_mm: float, held: Sequence[Turn], walled: _Walled) -> Iterator[Turn]:
    """The shortest piece of wall at a place that isn't planned yet, if there is one: less what leans."""
    end_mm, place = float(course.at_mm[-1]), int(np.abs(course.at_mm - at_mm).argmin())
    side = _side(course, place)
    for length_mm in PIECES_MM:
        low, high = max(0.0, at_mm - length_mm / 2), min(end_mm, at_mm + length_mm / 2)
        piece = Turn(course.wire, low, high, side, 0.0, stretch=True)
        fresh = [each for each in walled([piece]) if not _planned(each, held)]
        if fresh:
            yield from fresh
            return


def _side(course: Course, place: int) -> Side:
    """Where a wall has to stand: to which side of the drawn wire the taut one strays.

    One that strays far lies at no place of its own; there the drawn wire's own bend tells.
    """
    drawn = course.drawn
    here = drawn[place]
    if course.off_mm[place] > FAR_MM:
        arm = max(1, int(PIECES_MM[0] / (course.at_mm[1] - course.at_mm[0])))
        before, after = here - drawn[max(place - arm, 0)], drawn[min(place + arm, len(drawn) - 1)] - here
        bend = before[0] * after[1] - before[1] * after[0]
        if abs(bend) > STRAIGHT_RAD * np.linalg.norm(before) * np.linalg.norm(after):
            return "left" if bend > 0 else "right"
    along = drawn[min(place + 1, len(drawn) - 1)] - drawn[max(place - 1, 0)]
    start, end = course.taut[:-1], course.taut[1:]
    if not len(start):
        start = end = course.taut
    way = end - start
    share = np.clip(((here - start) * way).sum(axis=1) / np.maximum((way**2).sum(axis=1), 1e-12), 0, 1)
    feet = start + share[:, None] * way
    # Of all places of the taut wire the one that lies as far away as was measured.
    apart = np.linalg.norm(feet - here, axis=1)
    foot = feet[int(np.abs(apart - course.off_mm[place]).argmin())] - here
    return "left" if along[0] * foot[1] - along[1] * foot[0] > 0 else "right"


def _planned(piece: Turn, held: Iterable[Turn]) -> bool:
    """Whether a wall is planned all along there already."""
    return any(
        (span.wire, span.inside) == (piece.wire, piece.inside)
        and span.start_mm <= piece.start_mm + SAME_MM
        and piece.end_mm - SAME_MM <= span.end_mm
        for span in held
    )


def _joined(spans: Iterable[Turn], apart_mm: float) -> tuple[Turn, ...]:
    """Spans of one side that overlap or come within `apart_mm` are one."""
    joined: list[Turn] = []
    for span in sorted(spans, key=lambda span: (span.wire, span.inside, span.start_mm)):
        last = joined[-1] if joined else None
        near = last and (last.wire, last.inside) == (span.wire, span.inside)
        if last and near and span.start_mm - last.end_mm <= apart_mm:
            joined[-1] = replace(
                last,
                end_mm=max(last.end_mm, span.end_mm),
                max_curvature_per_mm=max(last.max_curvature_per_mm, span.max_curvature_per_mm),
                stretch=last.stretch and span.stretch,
            )
        else:
            joined.append(span)
    return tuple(joined)
