"""Which wires share a jig: as few jigs as hold every wire well."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from wrapit.config import JigConfig
from wrapit.geometry import FloatArray
from wrapit.jig.channel import CHANNEL_PAD_MM, Course
from wrapit.jig.holes import hole_obstacles, start_holes
from wrapit.jig.wall_ground import TOUCH_MM, face_probes
from wrapit.wires.model import Wire

PROBE_STEP_MM = 0.2
EASE = 0.02  # of support, given up for one jig less
WORK = 20_000


def grouped(wires: Sequence[Wire], alone: Mapping[str, float], config: JigConfig) -> list[tuple[Wire, ...]]:
    """The fewest groups of wires in which each wire has enough support beside the others, by estimate.

    `alone` is each wire's support in a jig of its own. Enough is `split_turn_support`, or nearly what the
    wire has alone where that is less.
    """
    support = np.array([alone.get(wire.name, 1.0) for wire in wires])
    spare = support - np.minimum(config.split_turn_support, support - EASE)
    groups = fewest_groups(support_losses(wires, config), spare)
    return [tuple(wires[i] for i in group) for group in groups]


def fewest_groups(losses: FloatArray, spare: FloatArray) -> list[list[int]]:
    """The fewest groups in which no member i loses more than `spare[i]`, `losses[i, j]` to each other j.

    Branch and bound, the most conflicting member first; its first try is first fit. Beyond WORK steps the
    best so far is taken. Members and groups are in rising order.
    """
    order = sorted(range(len(spare)), key=lambda i: (-(losses[i].sum() + losses[:, i].sum()), i))
    best: list[list[int]] = [[i] for i in order]
    steps = 0

    def place(number: int, groups: list[list[int]]) -> None:
        nonlocal best, steps
        steps += 1
        if len(groups) >= len(best) or steps > WORK:
            return
        if number == len(order):
            best = [list(group) for group in groups]
            return
        for group in groups:
            group.append(order[number])
            if (losses[np.ix_(group, group)].sum(axis=1) <= spare[group] + 1e-12).all():
                place(number + 1, groups)
            group.pop()
        place(number + 1, [*groups, [order[number]]])

    place(0, [])
    return sorted(sorted(group) for group in best)


def support_losses(wires: Sequence[Wire], config: JigConfig) -> FloatArray:
    """Share of wire i's turns that lose their wall to the channel or holes of wire j, (n, n); about right.

    A wall is lost where the other channel leaves less than the narrowest wall beside it, and where the
    other's tails go down.
    """
    import shapely

    losses = np.zeros((len(wires), len(wires)))
    courses = [Course.of((wire,), config) for wire in wires]
    half = config.min_wall_width / 2
    reaches = [course.channels.buffer(half - CHANNEL_PAD_MM, quad_segs=4) for course in courses]
    tails = [hole_obstacles(start_holes(course, config)) for course in courses]
    for shape in (*reaches, *tails):
        shapely.prepare(shape)
    for i, course in enumerate(courses):
        turns = [turn for turn in course.wires[0].turns if turn.inside != "both"]
        if not turns:
            continue
        face, inside = (
            shapely.points(
                np.concatenate([face_probes(course, turn, PROBE_STEP_MM, depth) for turn in turns])
            )
            for depth in (TOUCH_MM, half)
        )
        free = ~shapely.contains(course.channels, inside)
        for j in range(len(wires)):
            if i != j:
                lost = shapely.contains(reaches[j], inside) | shapely.contains(tails[j], face)
                losses[i, j] = float((lost & free).sum()) / len(face)
    return losses
