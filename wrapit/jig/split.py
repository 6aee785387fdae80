"""Which wires share a jig: as few jigs as hold every wire well."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from wrapit.config import JigConfig
from wrapit.geometry import FloatArray
from wrapit.jig.blanks import TOUCH_MM, face_probes
from wrapit.jig.course import CHANNEL_PAD_MM, Course
from wrapit.jig.holes import hole_obstacles, start_holes
from wrapit.wires.model import Wire

PROBE_STEP_MM = 0.2
EASE = 0.02  # of support, given up for one jig less


def grouped(wires: Sequence[Wire], alone: Mapping[str, float], config: JigConfig) -> list[tuple[Wire, ...]]:
    """Groups of wires, each wire with enough support beside the others by estimate.

    `alone` is each wire's support in a jig of its own. A wire joins the first group where its turns and
    theirs stay supported, longest wires first (first fit, like colouring a graph of conflicts).
    """
    losses = support_losses(wires, config)
    goal = [min(config.split_turn_support, alone.get(wire.name, 1.0) - EASE) for wire in wires]
    groups: list[list[int]] = []
    for index in sorted(range(len(wires)), key=lambda i: (-wires[i].length_mm, i)):
        for group in groups:
            together = [*group, index]
            if all(
                alone.get(wires[i].name, 1.0) - sum(losses[i, j] for j in together if j != i) >= goal[i]
                for i in together
            ):
                group.append(index)
                break
        else:
            groups.append([index])
    return [tuple(wires[i] for i in sorted(group)) for group in sorted(groups, key=min)]


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
