"""The printed jig as a kind: solids, their numbers, and how they are seen and handled."""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Callable
from typing import TYPE_CHECKING, Final

from wrapit.config import Config
from wrapit.errors import Finding
from wrapit.jig.made import GuidePage, Handling, JigMaker, Made, View, Wires, handled_in
from wrapit.jig.model import Jig, JigSet, straying
from wrapit.jig.overbending import loose_ends
from wrapit.jig.printed.jig_numbers import jig_numbers
from wrapit.jig.printed.judging import judged
from wrapit.jig.printed.printing_page import plan_print_page
from wrapit.jig.support import held_share

if TYPE_CHECKING:
    from wrapit.jig.printed.planning import PlannedJigs


def plan(wires: Wires, config: Config) -> Callable[[], Made]:
    """Plans the printed jig of a piece, or several; what it returns makes the solids. See `JigMaker`."""
    from wrapit.jig.printed.stage import plan_held

    planned, findings = plan_held(wires, config.jig)
    loose = [finding for jig in planned.jigs for finding in loose_ends(jig.standing, config)]
    return functools.partial(_made, planned, (*findings, *loose), wires, config)


def make(wires: Wires, config: Config) -> Made:
    """The printed jig of a piece, or several; see `JigMaker`. Raises KernelError too."""
    return plan(wires, config)()


def _made(planned: PlannedJigs, findings: tuple[Finding, ...], wires: Wires, config: Config) -> Made:
    from wrapit.jig.printed.stage import build_planned

    jigs, more = build_planned(planned, config.jig)
    return Made(
        block="jig",
        numbers=jig_numbers(jigs, wires),
        findings=(*findings, *more),
        parts=tuple(jig.part for jig in jigs.jigs),
        views=_views(jigs, wires),
        handling=handling(jigs),
        page=GuidePage(
            "print", "Print the jig", "printed/page.html.jinja", plan_print_page(jigs, wires, config)
        ),
    )


def held(wires: Wires, config: Config) -> float:
    """The share of the wires that the jig would hold."""
    from wrapit.jig.printed.planning import plan_jigs

    return held_share(one for jig in plan_jigs(wires, config.jig)[0].jigs for one in jig.held)


def handling(jigs: JigSet) -> Handling:
    """What the guide's steps say of these jigs."""
    return dataclasses.replace(
        handled_in({wire: jig.name for jig in jigs.jigs for wire in jig.wires}, jigs.forms),
        overbent=jigs.overbent,
        seats_mm=tuple(seat.bead_mm for jig in jigs.jigs for seat in jig.plan.seats),
    )


def _views(jigs: JigSet, wires: Wires) -> tuple[View, ...]:
    """One view where one jig holds all wires; else the piece, and each jig with its own."""
    if len(jigs.jigs[0].wires) == len(wires):
        return (_view("preview", wires, jigs.jigs[0]),)
    mine = [tuple(wire for wire in wires if wire.name in jig.wires) for jig in jigs.jigs]
    each = [_view(f"preview-{jig.name}", laid, jig) for jig, laid in zip(jigs.jigs, mine, strict=True)]
    return (View("preview", wires), *each)


def _view(stem: str, wires: Wires, jig: Jig) -> View:
    heights = tuple(wall.height_mm for wall in jig.plan.walls)
    return View(
        stem, wires, jig.walls, jig.plate, straying(jig.plan.laid), heights, jig.plan.plate.thickness_mm
    )


# The kind, as `jig.kinds` lists it.
PRINTED: Final = JigMaker("printed", solid=True, make=make, held=held, plan=plan, judge=judged)
