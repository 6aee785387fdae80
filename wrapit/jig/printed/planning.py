"""Plans a piece's jigs: one for all wires, or several where one would hold a wire badly; no kernel."""

from __future__ import annotations

from dataclasses import dataclass, replace

from wrapit.config import JigConfig
from wrapit.errors import Finding, JigError, UnheldError
from wrapit.geometry import Region
from wrapit.jig.channel import Course
from wrapit.jig.findings import free_finding, split_finding, support_findings
from wrapit.jig.grouping import grouped
from wrapit.jig.model import JigPlan, TurnSupport
from wrapit.jig.printed.plan import plan_jig
from wrapit.jig.printed.seats import check_seats, seats_near
from wrapit.jig.support import held_share, support_by_wire, turn_support
from wrapit.jig.wall_face import Face, plain_finding, wall_face
from wrapit.wires.model import Wire

WORTH_A_JIG = 0.1  # support that a badly held wire must gain


@dataclass(frozen=True, eq=False)
class PlannedJig:
    """A plan with its exact wall faces and what they hold."""

    course: Course
    plan: JigPlan
    faces: tuple[Face, ...]
    support: tuple[TurnSupport, ...]
    findings: tuple[Finding, ...]

    @property
    def walls(self) -> tuple[Region, ...]:
        """The faces' outlines."""
        return tuple(face.region for face in self.faces)

    @property
    def by_wire(self) -> dict[str, float]:
        """Supported share of each wire's turns."""
        return support_by_wire(self.support)


def plan_jigs(
    wires: tuple[Wire, ...], config: JigConfig
) -> tuple[tuple[PlannedJig, ...], tuple[Finding, ...]]:
    """The printed jig of these wires, or several; and what the maker should know about them.

    Overbent wires (`springback: compensate`) get a jig each: they don't meet as drawn.
    Raises JigError where no jig can be planned as asked.
    """
    _check_wishes(wires, config)
    jigs, said = _parted(wires, config)
    findings = [*said]
    for jig in jigs:
        findings += [*jig.findings, *plain_finding(jig.faces, jig.plan.name)]
        findings += [*support_findings(jig.course, jig.plan, jig.support, config)]
        findings += _unheld_wires(jig, config)
    return jigs, tuple(findings)


def held_by(jigs: tuple[PlannedJig, ...]) -> float:
    """The share of the length of all turns and long stretches that walls or pins hold; 1 if there are none.

    Both count here, by length: a large flower with three cusps that no wall fits into is held well. Of 177
    drawings, sizes and gauges measured, those worth making have 0.59 or more, the others 0.21 or less.
    """
    return held_share(one for jig in jigs for one in _with_pins(jig))


def refuse_unheld(jigs: tuple[PlannedJig, ...], config: JigConfig) -> None:
    """Raises UnheldError when the jigs hold less of the wires than `jig.least_support`."""
    held = held_by(jigs)
    if held < config.least_support:
        raise UnheldError(
            f"walls would hold {held:.0%} of the turns and long stretches, "
            f"less than jig.least_support ({config.least_support:.0%})"
        )


def _with_pins(jig: PlannedJig) -> list[TurnSupport]:
    """The support of each turn, where a pin in it holds it whole."""
    pinned = {pin.turn for pin in jig.plan.pins}
    return [replace(one, share=1.0) if one.turn in pinned else one for one in jig.support]


def _unheld_wires(jig: PlannedJig, config: JigConfig) -> list[Finding]:
    shares = support_by_wire(_with_pins(jig))
    return [
        Finding(
            "error",
            "unheld-wire",
            wire,
            f"the jig holds {share:.0%} of this wire's turns; the others are left to the hand",
            "make the piece larger, take thinner wire, or set jig.split to per-wire",
            severity=1 - share,
        )
        for wire, share in sorted(shares.items())
        if share < config.least_support
    ]


def _parted(wires: tuple[Wire, ...], config: JigConfig) -> tuple[tuple[PlannedJig, ...], tuple[Finding, ...]]:
    if config.split == "single" or len(wires) == 1:
        return (_planned(wires, config, "jig"),), ()
    # A wire without turns and long stretches needs no jig of its own, and its holes take room from others.
    held = tuple(wire for wire in wires if wire.turns) or wires
    handmade = tuple(map(free_finding, (wire.name for wire in wires if wire not in held)))

    def planned(group: tuple[Wire, ...]) -> PlannedJig:
        name = "jig" if group == held else _name(group)
        return _planned(group, seats_near(group, held, config), name)

    if config.split == "per-wire" or config.springback == "compensate":
        return tuple(planned((wire,)) for wire in held), handmade
    single = _planned(wires, config, "jig")
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


def _planned(wires: tuple[Wire, ...], config: JigConfig, name: str) -> PlannedJig:
    course = Course.of(wires, config)
    plan, findings = plan_jig(wires, config, name)
    faces = tuple(wall_face(course, wall) for wall in plan.walls)
    support = turn_support(course, [face.region for face in faces])
    return PlannedJig(course, plan, faces, support, findings)


def _name(group: tuple[Wire, ...]) -> str:
    return "jig-" + "-".join([group[0].name, *(f"{wire.number:02d}" for wire in group[1:])])
