"""Plans the printed jigs of a piece: walls, plates, and what they hold; no kernel."""

from __future__ import annotations

from dataclasses import dataclass

from wrapit.config import JigConfig
from wrapit.errors import Finding, JigError
from wrapit.geometry import Region
from wrapit.jig.channel import Channels
from wrapit.jig.findings import support_findings, unheld_findings
from wrapit.jig.grouping import parted
from wrapit.jig.model import JigPlan, TurnSupport
from wrapit.jig.printed.plan import plan_jig
from wrapit.jig.printed.seats import check_seats, seats_near
from wrapit.jig.support import support_by_wire, turn_support, with_pins
from wrapit.jig.wall_face import Face, plain_finding, wall_face
from wrapit.jig.walls_and_pins import standing_walls
from wrapit.wires.model import Wire


@dataclass(frozen=True, eq=False)
class PlannedJig:
    """A plan with its exact wall faces and what they hold."""

    channels: Channels
    plan: JigPlan
    faces: tuple[Face, ...]
    support: tuple[TurnSupport, ...]
    findings: tuple[Finding, ...]

    @property
    def walls(self) -> tuple[Region, ...]:
        """The faces' outlines."""
        return tuple(face.region for face in self.faces)

    @property
    def gap_mm(self) -> float | None:
        """The smallest gap between any wall and any wire; None without walls."""
        return min((face.gap_mm for face in self.faces), default=None)

    @property
    def by_wire(self) -> dict[str, float]:
        """Supported share of each wire's turns."""
        return support_by_wire(self.support)

    @property
    def held(self) -> tuple[TurnSupport, ...]:
        """The support of each turn, pins counted."""
        return with_pins(self.support, self.plan.pins)


def plan_jigs(
    wires: tuple[Wire, ...], config: JigConfig
) -> tuple[tuple[PlannedJig, ...], tuple[Finding, ...]]:
    """The printed jig of these wires, or several; and what the maker should know about them.

    Overbent wires (`springback: compensate`) get a jig each: they don't meet as drawn.
    Raises JigError where no jig can be planned as asked.
    """
    _check_wishes(wires, config)

    def plan(group: tuple[Wire, ...], name: str, others: tuple[Wire, ...]) -> PlannedJig:
        return _planned(group, seats_near(group, others, config) if others else config, name)

    jigs, said = parted(wires, config, plan)
    findings = [*said]
    for jig in jigs:
        findings += [*jig.findings, *plain_finding(jig.faces, jig.plan.name)]
        findings += [*support_findings(jig.channels, jig.plan.pins, jig.support, config)]
        findings += unheld_findings(jig.held, config)
    return jigs, tuple(findings)


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
    check_seats(Channels.of(wires, config), config)


def _planned(wires: tuple[Wire, ...], config: JigConfig, name: str) -> PlannedJig:
    plan, findings = plan_jig(wires, config, name)
    if not config.seats:
        standing = standing_walls(wires, config)
        return PlannedJig(standing.channels, plan, standing.faces, standing.support, findings)
    channels = Channels.of(wires, config)
    faces = tuple(wall_face(channels, wall) for wall in plan.walls)
    support = turn_support(channels, [face.region for face in faces])
    return PlannedJig(channels, plan, faces, support, findings)
