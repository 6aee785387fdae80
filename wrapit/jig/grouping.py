"""Which wires share a jig: as few jigs as hold every wire well."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Protocol, TypeVar

import numpy as np

from wrapit.config import JigConfig
from wrapit.errors import Finding
from wrapit.geometry import FloatArray
from wrapit.jig.channel import CHANNEL_PAD_MM, Channels
from wrapit.jig.findings import free_finding, split_finding
from wrapit.jig.openings.holes import hole_obstacles, start_holes
from wrapit.jig.wall_ground import ROUGH_STEP_MM, TOUCH_MM, face_probes
from wrapit.wires.model import Wire

# What the jig of all wires is called; several are called after theirs.
ONE_JIG = "jig"
# When another jig is worth its plate: a badly held wire gains this much support, or one jig less costs each
# wire no more than EASE. No measurement set them; 30 % up or down changes the groups of neither leaf (two
# jigs) nor butterfly (one).
WORTH_A_JIG = 0.1
EASE = 0.02
# Steps of the search for groups, after which the best so far is taken. With losses drawn at random twelve
# wires take under 0.01 s and end by themselves, thirty stop after 0.8 s.
WORK = 20_000


class Planned(Protocol):
    """A jig planned so far that it is known what it holds."""

    @property
    def by_wire(self) -> dict[str, float]:
        """Supported share of each wire's turns."""
        ...


P = TypeVar("P", bound=Planned)


def parted(
    wires: tuple[Wire, ...], config: JigConfig, plan: Callable[[tuple[Wire, ...], str, tuple[Wire, ...]], P]
) -> tuple[tuple[P, ...], tuple[Finding, ...]]:
    """One jig for all wires, or several where one would hold a wire badly; and why.

    `plan(wires, name, others)` plans the jig of some wires; `others` are all that are parted over jigs, or
    none where one jig is for all.
    """
    if config.split == "single" or len(wires) == 1:
        return (plan(wires, ONE_JIG, ()),), ()
    # A wire without turns and long stretches needs no jig of its own, and its holes take room from others.
    held = tuple(wire for wire in wires if wire.turns) or wires
    handmade = tuple(map(free_finding, (wire.name for wire in wires if wire not in held)))

    def planned(group: tuple[Wire, ...]) -> P:
        return plan(group, ONE_JIG if group == held else _name(group), held)

    if config.split == "per-wire" or config.springback == "compensate":
        return tuple(planned((wire,)) for wire in held), handmade
    single = plan(wires, ONE_JIG, ())
    shared = single.by_wire
    if min(shared.values(), default=1.0) >= config.min_turn_support:
        return (single,), ()
    apart = {wire.name: planned((wire,)) for wire in held}
    alone = {name: share for each in apart.values() for name, share in each.by_wire.items()}
    weak = [name for name, share in shared.items() if share < config.min_turn_support]
    if all(alone[name] - shared[name] < WORTH_A_JIG for name in weak):
        return (single,), ()
    groups = grouped(held, alone, config)
    parts = tuple(apart[group[0].name] if len(group) == 1 else planned(group) for group in groups)
    split_by_wire = {name: share for part in parts for name, share in part.by_wire.items()}
    if all(split_by_wire[name] - shared[name] < WORTH_A_JIG for name in weak):
        return (single,), ()
    said = [split_finding(shared, len(groups), config.min_turn_support)] if len(groups) > 1 else []
    return parts, (*said, *handmade)


def _name(group: tuple[Wire, ...]) -> str:
    return "jig-" + "-".join([group[0].name, *(f"{wire.number:02d}" for wire in group[1:])])


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
    apart = [Channels.of((wire,), config) for wire in wires]
    half = config.min_wall_width / 2
    reaches = [channels.area.buffer(half - CHANNEL_PAD_MM, quad_segs=4) for channels in apart]
    tails = [hole_obstacles(start_holes(channels, config)) for channels in apart]
    for shape in (*reaches, *tails):
        shapely.prepare(shape)
    for i, channels in enumerate(apart):
        turns = [turn for turn in channels.wires[0].turns if not turn.stretch]
        if not turns:
            continue
        face, inside = (
            shapely.points(
                np.concatenate([face_probes(channels, turn, ROUGH_STEP_MM, depth) for turn in turns])
            )
            for depth in (TOUCH_MM, half)
        )
        free = ~shapely.contains(channels.area, inside)
        for j in range(len(wires)):
            if i != j:
                lost = shapely.contains(reaches[j], inside) | shapely.contains(tails[j], face)
                losses[i, j] = float((lost & free).sum()) / len(face)
    return losses
