"""The printed jig as a kind: solids, their numbers, and how they are seen and handled."""

from __future__ import annotations

import functools
from collections.abc import Sequence
from typing import TYPE_CHECKING, Final

from wrapit.config import Config
from wrapit.errors import Finding
from wrapit.jig.bench.model import Bench, Handling
from wrapit.jig.bench.touching import bench_of
from wrapit.jig.channel import Channels
from wrapit.jig.made import Each, JigMaker, Made, Planned, View, Wires, one_by_one
from wrapit.jig.model import Jig, JigSet, straying
from wrapit.jig.overbending import loose_ends
from wrapit.jig.printed.jig_numbers import jig_numbers
from wrapit.jig.printed.judging import judged
from wrapit.jig.printed.printing_page import print_page
from wrapit.jig.support import held_share

if TYPE_CHECKING:
    from wrapit.jig.printed.planning import PlannedJig, PlannedJigs


def plan(wires: Wires, config: Config) -> Planned:
    """Plans the printed jig of a piece, or several; see `JigMaker`."""
    from wrapit.jig.printed.stage import plan_held

    planned, findings = plan_held(wires, config.jig)
    loose = [finding for jig in planned.jigs for finding in loose_ends(jig.standing, config)]
    views = _views(planned.jigs, wires)
    return Planned(views, functools.partial(_made, planned, views, (*findings, *loose), wires, config))


def make(wires: Wires, config: Config, _: Each = one_by_one) -> Made:
    """The printed jig of a piece, or several; see `JigMaker`. Raises KernelError too."""
    return plan(wires, config).build()


def _made(
    planned: PlannedJigs,
    views: tuple[View, ...],
    findings: tuple[Finding, ...],
    wires: Wires,
    config: Config,
) -> Made:
    from wrapit.jig.printed.stage import build_planned

    jigs, more = build_planned(planned, config.jig)
    held = handling(jigs, wires, config)
    return Made(
        block="jig",
        numbers=jig_numbers(jigs, wires),
        findings=(*findings, *more),
        parts=tuple(jig.part for jig in jigs.jigs),
        views=views,
        handling=held,
        page=print_page(jigs, held.benches, config),
    )


def held(wires: Wires, config: Config) -> float:
    """The share of the wires that the jig would hold."""
    from wrapit.jig.printed.planning import plan_jigs

    return held_share(one for jig in plan_jigs(wires, config.jig)[0].jigs for one in jig.held)


def handling(jigs: JigSet, wires: Wires, config: Config) -> Handling:
    """What lies where in these jigs, for the guide's steps."""
    return Handling(
        tuple(_bench(jig, wires, config) for jig in jigs.jigs), jigs.forms, overbent=jigs.overbent
    )


def _bench(jig: Jig, wires: Wires, config: Config) -> Bench:
    mine = [wire for wire in wires if wire.name in jig.wires]
    labelled = {label.text for label in jig.plan.labels}
    return bench_of(
        jig.name,
        mine,
        jig.walls,
        jig.plate,
        jig.plan.pins,
        Channels.of(tuple(mine), config.jig).reach_mm,
        unmarked=[wire.name for wire in mine if str(wire.number) not in labelled],
        seats_mm=[seat.bead_mm for seat in jig.plan.seats if not seat.threaded],
    )


def _views(jigs: Sequence[PlannedJig], wires: Wires) -> tuple[View, ...]:
    """One view where one jig holds all wires; else the piece, and each jig with its own."""
    if len(jigs[0].plan.wires) == len(wires):
        return (_view("preview", wires, jigs[0]),)
    mine = [tuple(wire for wire in wires if wire.name in jig.plan.wires) for jig in jigs]
    each = [_view(f"preview-{jig.plan.name}", laid, jig) for jig, laid in zip(jigs, mine, strict=True)]
    return (View("preview", wires), *each)


def _view(stem: str, wires: Wires, jig: PlannedJig) -> View:
    heights = tuple(wall.height_mm for wall in jig.plan.walls)
    plan = jig.plan
    return View(stem, wires, jig.walls, plan.ground, straying(plan.laid), heights, plan.plate.thickness_mm)


# The kind, as `jig.kinds` lists it.
PRINTED: Final = JigMaker("printed", solid=True, make=make, held=held, plan=plan, judge=judged)
