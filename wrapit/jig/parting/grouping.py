"""Which wires share a jig: as few jigs as hold every wire well."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Generic, Protocol, TypeVar

import numpy as np

from wrapit.config import JigConfig
from wrapit.errors import Finding
from wrapit.geometry import FloatArray
from wrapit.jig.channel import CHANNEL_PAD_MM, Channels
from wrapit.jig.findings import free_finding, split_finding
from wrapit.jig.model import Hold, SameShape
from wrapit.jig.openings.holes import hole_obstacles, start_holes
from wrapit.jig.paired.leaning import walled
from wrapit.jig.parting.same_shape import same_shapes
from wrapit.jig.wall_ground import ROUGH_STEP_MM, TOUCH_MM, face_probes
from wrapit.wires.model import Turn, Wire

# What the jig of all wires is called; several are called after theirs.
ONE_JIG = "jig"
# When another jig is worth its plate: a badly held wire gains WORTH_A_JIG of support, or strays along less of
# its length by WORTH_STRAYING; or one jig less costs each wire no more than EASE. No measurement set them; a
# third up or down changes the groups of neither leaf nor butterfly.
WORTH_A_JIG = 0.1
WORTH_STRAYING = 0.05
EASE = 0.02
# Steps of the search for groups, after which the best so far is taken. With losses drawn at random twelve
# wires take under 0.01 s and end by themselves, thirty stop after 0.8 s.
WORK = 20_000


class Planned(Protocol):
    """A jig planned so far that it is known what it holds."""

    @property
    def how_well(self) -> dict[str, Hold]:
        """How well each of its wires is held."""
        ...


P = TypeVar("P", bound=Planned)


@dataclass(frozen=True, eq=False)
class Parting(Generic[P]):
    """The jigs of a piece, the wires that another's jig serves as they have its shape, and why."""

    jigs: tuple[P, ...]
    forms: tuple[SameShape, ...] = ()
    findings: tuple[Finding, ...] = ()


def parted(
    wires: tuple[Wire, ...], config: JigConfig, plan: Callable[[tuple[Wire, ...], str, tuple[Wire, ...]], P]
) -> Parting[P]:
    """One jig for all wires, or several where one would hold a wire badly; and why.

    `plan(wires, name, others)` plans the jig of some wires; `others` are all that are parted over jigs, or
    none where one jig is for all. Where jigs are parted, wires of one shape share one form.
    """
    if config.split == "single" or len(wires) == 1:
        return Parting((plan(wires, ONE_JIG, ()),))
    # A wire without turns and long stretches needs no jig of its own, and its holes take room from others.
    bent = tuple(wire for wire in wires if wire.turns) or wires
    # A seat is beside one wire, not beside all of its shape.
    forms = () if config.seats else same_shapes(bent)
    copies = {form.wire for form in forms}
    held = tuple(wire for wire in bent if wire.name not in copies)
    handmade = tuple(map(free_finding, (wire.name for wire in wires if wire not in bent)))

    def planned(group: tuple[Wire, ...]) -> P:
        return plan(group, ONE_JIG if group == bent else _name(group), held)

    if config.split == "per-wire" or config.springback == "compensate":
        return Parting(tuple(planned((wire,)) for wire in held), forms, handmade)
    single = plan(wires, ONE_JIG, ())
    rule = _Rule.of(config)
    shared = {name: rule.quality(hold) for name, hold in single.how_well.items()}
    if min(shared.values(), default=1.0) >= rule.enough:
        return Parting((single,))
    apart = {wire.name: planned((wire,)) for wire in held}
    alone = {name: hold for each in apart.values() for name, hold in each.how_well.items()}
    weak = [name for name in alone if shared[name] < rule.enough]
    if all(rule.quality(alone[name]) - shared[name] < rule.worth for name in weak):
        return Parting((single,))

    def well(group: tuple[Wire, ...]) -> list[tuple[tuple[Wire, ...], P]]:
        """The group's jig; a wire that is held badly all the same beside the others gets one of its own."""
        jig = apart[group[0].name] if len(group) == 1 else planned(group)
        held_here = {name: rule.quality(hold) for name, hold in jig.how_well.items()}
        worst = min(group, key=lambda wire: held_here.get(wire.name, 1.0))
        quality = held_here.get(worst.name, 1.0)
        if len(group) == 1 or quality >= rule.enough:
            return [(group, jig)]
        if rule.quality(alone[worst.name]) - quality < rule.worth:
            return [(group, jig)]
        rest = tuple(wire for wire in group if wire is not worst)
        return [*well(rest), *well((worst,))]

    turns = {name: hold.turns for name, hold in alone.items()}
    jigs = [part for group in grouped(held, turns, config) for part in well(group)]
    parts = tuple(jig for _, jig in sorted(jigs, key=lambda part: part[0][0].number))
    split = {name: hold for part in parts for name, hold in part.how_well.items()}
    gained = any(rule.quality(split[name]) - shared[name] >= rule.worth for name in weak)
    lost = any(rule.quality(hold) < min(shared[name], rule.enough) for name, hold in split.items())
    if lost or not gained:
        return Parting((single,))
    worst = min(weak, key=lambda name: (shared[name], name))
    said = []
    if len(parts) > 1:
        said.append(split_finding(worst, single.how_well[worst], split[worst], len(parts), config))
    return Parting(parts, forms, (*said, *handmade))


@dataclass(frozen=True)
class _Rule:
    """How a hold becomes one number, how large that has to be, and what gain is worth another jig."""

    by_turns: bool
    enough: float
    worth: float

    @staticmethod
    def of(config: JigConfig) -> _Rule:
        if config.support == "turns":
            return _Rule(True, config.min_turn_support, WORTH_A_JIG)
        return _Rule(False, 1 - config.max_strays, WORTH_STRAYING)

    def quality(self, hold: Hold) -> float:
        return hold.turns if self.by_turns else 1 - hold.strays


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
        turns = [turn for turn in channels.turns if not turn.stretch]
        if not turns:
            continue
        face, inside = _probes(channels, turns, half)
        for j in range(len(wires)):
            if i != j:
                # What leans on the other needs no wall beside it.
                walls = walled(turns, (wires[i], wires[j]))
                near, deep = (face, inside) if walls == tuple(turns) else _probes(channels, walls, half)
                lost = shapely.contains(reaches[j], deep) | shapely.contains(tails[j], near)
                free = ~shapely.contains(channels.area, deep)
                losses[i, j] = float((lost & free).sum()) / len(face)
    return losses


def _probes(channels: Channels, turns: Sequence[Turn], half_mm: float) -> tuple[Any, Any]:
    """Points (shapely, (m,) each) at the faces of walls along these turns, and half a wall deeper."""
    import shapely

    face, inside = (
        [face_probes(channels, turn, ROUGH_STEP_MM, depth) for turn in turns] for depth in (TOUCH_MM, half_mm)
    )
    none = np.empty((0, 2))
    return shapely.points(np.concatenate([none, *face])), shapely.points(np.concatenate([none, *inside]))
