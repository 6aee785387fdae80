"""Builds the jig: plan, exact faces, one solid, and the proof that it holds the wires."""

from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING, Literal

from wrapit.config import JigConfig
from wrapit.errors import Finding, JigError, KernelError
from wrapit.jig.model import Jig, JigPlan, JigSet, Part
from wrapit.jig.printed.planning import PlannedJig, PlannedJigs, plan_jigs
from wrapit.jig.printed.solid import jig_solid
from wrapit.jig.support import refuse_unheld
from wrapit.jig.wall_face import CLEARANCE_TOLERANCE_MM
from wrapit.wires.model import Wire

if TYPE_CHECKING:
    from wrapit.kernel.terraces import Terraced

# Light grey: wires of every metal stand out against it.
COLOUR = "#c8ccd4"


def build_jig(wires: tuple[Wire, ...], config: JigConfig) -> tuple[JigSet, tuple[Finding, ...]]:
    """The printed jig of these wires, or several where one would hold a wire badly; checked.

    Raises JigError where no jig can be made or one fails its check, UnheldError where it would hold too
    little, KernelError where the kernel fails.
    """
    planned, findings = plan_held(wires, config)
    jigs, more = build_planned(planned, config)
    return jigs, (*findings, *more)


def plan_held(wires: tuple[Wire, ...], config: JigConfig) -> tuple[PlannedJigs, tuple[Finding, ...]]:
    """The plan of each jig, before any kernel.

    Raises JigError where no jig can be made or one fails its check, UnheldError where it would hold too
    little.
    """
    planned, findings = plan_jigs(wires, config)
    refuse_unheld((one for jig in planned.jigs for one in jig.held), config)
    for part in planned.jigs:
        _check_gap(part)
    return planned, findings


def build_planned(planned: PlannedJigs, config: JigConfig) -> tuple[JigSet, tuple[Finding, ...]]:
    """The solids of planned jigs; a finding for each outline that the kernel takes as straight lines only.

    Raises KernelError where the kernel fails.
    """
    built = [_built(part, config) for part in planned.jigs]
    jigs = tuple(jig for jig, _ in built)
    findings = tuple(finding for _, plain in built for finding in plain)
    split: Literal["single", "per-wire"] = "per-wire" if len(jigs) > 1 or planned.forms else "single"
    return JigSet(split, jigs, planned.forms, overbent=config.springback == "compensate"), findings


def _built(part: PlannedJig, config: JigConfig) -> tuple[Jig, tuple[Finding, ...]]:
    plan, made, findings = _solid(part, config)
    from wrapit.kernel.measures import box_mm, count_solids

    low, high = box_mm(made.solid)
    width, depth, height = (high - low).tolist()
    jig = Jig(
        name=plan.name,
        wires=plan.wires,
        part=Part(plan.name, made.solid, COLOUR, (low, high)),
        walls=part.walls,
        plate=plan.ground,
        plan=plan,
        valid=True,
        solids=count_solids(made.solid),
        volume_mm3=made.volume_mm3,
        support=part.support,
        min_wall_to_wire_mm=part.gap_mm,
        hemmed=part.hemmed,
        size_mm=(width, depth, height),
    )
    return jig, (*findings, *(_plain_outline(plan.name, place) for place in made.plain))


def _solid(part: PlannedJig, config: JigConfig) -> tuple[JigPlan, Terraced, tuple[Finding, ...]]:
    """The plan as it is built, its solid, and a note where that is sound only without the wires' course."""
    try:
        return part.plan, jig_solid(part.plan, part.walls, config), ()
    except KernelError:
        if part.plan.groove is None:
            raise
        plan = dataclasses.replace(part.plan, groove=None)
        return plan, jig_solid(plan, part.walls, config), (_no_course(plan.name),)


def _no_course(jig: str) -> Finding:
    return Finding(
        "note",
        "no-course",
        jig,
        "with the wires' course engraved it would be no sound solid, so its plate has no grooves",
        "nothing needs to be done; the guide shows where the wires run",
    )


def _plain_outline(jig: str, place: str) -> Finding:
    return Finding(
        "warning",
        "plain-outline",
        f"{jig} at {place}",
        "an outline has no sound exact face, so its sides are short straight lines, within 0.001 mm",
        "nothing needs to be done; a piece 1 mm larger may have an exact one",
    )


def _check_gap(part: PlannedJig) -> None:
    gap = part.gap_mm
    if gap is not None and gap < part.channels.inside_gap_mm - CLEARANCE_TOLERANCE_MM:
        raise JigError(
            f"a wall comes within {gap:.4f} mm of a wire",
            part.plan.name,
            "change jig.clearance or the size a little",
        )
