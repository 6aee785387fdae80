"""Builds the jig: plan, exact faces, one solid, and the proof that it holds the wires."""

from __future__ import annotations

from typing import Literal

from wrapit.config import JigConfig
from wrapit.errors import Finding, JigError
from wrapit.geometry import Region
from wrapit.jig.course import Course
from wrapit.jig.faces import CLEARANCE_TOLERANCE_MM, plain_finding, wall_face
from wrapit.jig.model import Jig, JigSet, Part
from wrapit.jig.plan import plan_jig
from wrapit.jig.proof import free_finding, split_finding, support_findings
from wrapit.jig.seats import check_seats, seats_near
from wrapit.jig.solids import jig_solid
from wrapit.jig.split import grouped
from wrapit.jig.support import support_by_wire, turn_support
from wrapit.wires.model import Wire

COLOUR = "#c8ccd4"
WORTH_A_JIG = 0.1  # support that a badly held wire must gain


def build_jig(wires: tuple[Wire, ...], config: JigConfig) -> tuple[JigSet, tuple[Finding, ...]]:
    """The printed jig of these wires, or several where one would hold a wire badly; checked.

    Overbent wires (`springback: compensate`) get a jig each: they don't meet as drawn.
    Raises JigError where no jig can be made or one fails its check, KernelError where the kernel fails.
    """
    _check_wishes(wires, config)

    if config.split == "single" or len(wires) == 1:
        return _set([_Planned(wires, config, "jig")], config, ())
    # A wire without turns and long stretches needs no jig of its own, and its holes take room from others.
    held = tuple(wire for wire in wires if wire.turns) or wires
    handmade = tuple(map(free_finding, (wire.name for wire in wires if wire not in held)))

    def planned(group: tuple[Wire, ...]) -> _Planned:
        name = "jig" if group == held else _name(group)
        return _Planned(group, seats_near(group, held, config), name)

    if config.split == "per-wire" or config.springback == "compensate":
        return _set([planned((wire,)) for wire in held], config, handmade)
    single = _Planned(wires, config, "jig")
    shared = single.by_wire
    if min(shared.values(), default=1.0) >= config.min_turn_support:
        return _set([single], config, ())
    apart = {wire.name: planned((wire,)) for wire in held}
    alone = {name: share for each in apart.values() for name, share in each.by_wire.items()}
    weak = [name for name, share in shared.items() if share < config.min_turn_support]
    if all(alone[name] - shared[name] < WORTH_A_JIG for name in weak):
        return _set([single], config, ())
    groups = grouped(held, alone, config)
    parts = [apart[group[0].name] if len(group) == 1 else planned(group) for group in groups]
    split_by_wire = {name: share for part in parts for name, share in part.by_wire.items()}
    if all(split_by_wire[name] - shared[name] < WORTH_A_JIG for name in weak):
        return _set([single], config, ())
    said = [split_finding(shared, len(groups), config.min_turn_support)] if len(groups) > 1 else []
    return _set(parts, config, (*said, *handmade))


def _check_wishes(wires: tuple[Wire, ...], config: JigConfig) -> None:
    if not wires:
        raise JigError("there are no wires to make a jig for")
    if config.springback == "compensate":
        if config.split == "single" and len(wires) > 1:
            raise JigError(
                "overbent wires don't meet where they are drawn, so they can't share a jig",
                "jig.springback",
                "set jig.split to auto or per-wire, or jig.springback to report",
            )
        if config.seats:
            raise JigError(
                "overbent wires don't pass the seats where they are drawn",
                "jig.seats",
                "leave the seats out, or set jig.springback to report",
            )
    check_seats(Course.of(wires, config), config)


class _Planned:
    """A plan with its exact faces and what they hold; the solid comes later."""

    def __init__(self, wires: tuple[Wire, ...], config: JigConfig, name: str) -> None:
        self.course = Course.of(wires, config)
        self.plan, self.findings = plan_jig(wires, config, name)
        self.faces = tuple(wall_face(self.course, wall) for wall in self.plan.walls)
        self.walls = tuple(face.region for face in self.faces)
        self.support = turn_support(self.course, self.walls)
        self.by_wire = support_by_wire(self.support)


def _name(group: tuple[Wire, ...]) -> str:
    return "jig-" + "-".join([group[0].name, *(wire.name.removeprefix("wire-") for wire in group[1:])])


def _set(
    parts: list[_Planned], config: JigConfig, said: tuple[Finding, ...]
) -> tuple[JigSet, tuple[Finding, ...]]:
    jigs = tuple(_built(part, config) for part in parts)
    findings = [*said]
    for part in parts:
        findings += [*part.findings, *plain_finding(part.faces, part.plan.name)]
        findings += [*support_findings(part.course, part.plan, part.support, config)]
    split: Literal["single", "per-wire"] = "single" if len(jigs) == 1 else "per-wire"
    return JigSet(split, jigs, overbent=config.springback == "compensate"), tuple(findings)


def _built(part: _Planned, config: JigConfig) -> Jig:
    gap = _checked_gap(part, config)
    made = jig_solid(part.plan, part.walls, config)
    from wrapit.kernel.checks import count_solids, size_mm

    plan = part.plan
    openings = [*(hole.outline for hole in plan.holes), *plan.screw_holes]
    openings += [seat.pocket for seat in plan.seats]
    return Jig(
        name=plan.name,
        wires=plan.wires,
        part=Part(plan.name, made.solid, COLOUR),
        walls=part.walls,
        plate=Region(plan.plate.outline.outer, tuple(openings)),
        plan=plan,
        valid=True,
        solids=count_solids(made.solid),
        volume_mm3=made.volume_mm3,
        support=part.support,
        min_wall_to_wire_mm=gap,
        size_mm=size_mm(made.solid),
    )


def _checked_gap(part: _Planned, config: JigConfig) -> float | None:
    gap = min((face.gap_mm for face in part.faces), default=None)
    if gap is not None and gap < config.clearance - CLEARANCE_TOLERANCE_MM:
        raise JigError(
            f"a wall comes within {gap:.4f} mm of a wire",
            part.plan.name,
            "change jig.clearance or the size a little",
        )
    return gap
