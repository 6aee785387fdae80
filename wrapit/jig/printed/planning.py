"""Plans the printed jigs of a piece: walls, plates, and what they hold; no kernel."""

from __future__ import annotations

from dataclasses import dataclass

from wrapit.config import JigConfig
from wrapit.errors import Finding, JigError
from wrapit.geometry import Region
from wrapit.jig.channel import Channels
from wrapit.jig.findings import form_findings, stray_findings, support_findings, unheld_findings
from wrapit.jig.model import Hold, JigPlan, SameShape, TurnSupport
from wrapit.jig.paired.no_room import bead_findings
from wrapit.jig.parting.grouping import parted
from wrapit.jig.printed.plan import plan_jig, walls_of
from wrapit.jig.printed.seats import check_seats, seats_near
from wrapit.jig.support import really_held
from wrapit.jig.wall_face import Face, plain_finding
from wrapit.jig.walls_and_pins import StandingWalls
from wrapit.jig.wrapping.hemmed import hemmed_findings, hemmed_share
from wrapit.wires.model import Wire


@dataclass(frozen=True, eq=False)
class PlannedJigs:
    """The jigs of a piece, and the wires that another's jig serves as they have its shape."""

    jigs: tuple[PlannedJig, ...]
    forms: tuple[SameShape, ...]


@dataclass(frozen=True, eq=False)
class PlannedJig:
    """A plan with its walls, whose exact faces are made once they are asked for."""

    channels: Channels
    plan: JigPlan
    standing: StandingWalls
    findings: tuple[Finding, ...]

    @property
    def faces(self) -> tuple[Face, ...]:
        """The walls' exact faces."""
        return self.standing.faces

    @property
    def support(self) -> tuple[TurnSupport, ...]:
        """What the faces hold of each turn."""
        return self.standing.support

    @property
    def walls(self) -> tuple[Region, ...]:
        """The faces' outlines."""
        return tuple(face.region for face in self.faces)

    @property
    def gap_mm(self) -> float | None:
        """The smallest gap between any wall and any wire; None without walls."""
        return min((face.gap_mm for face in self.faces), default=None)

    @property
    def how_well(self) -> dict[str, Hold]:
        """How well each wire is held."""
        return self.standing.how_well

    @property
    def hemmed(self) -> float:
        """Share of the wires' length with walls close by on both sides."""
        return hemmed_share(self.channels, [wall.outline for wall in self.plan.walls])

    @property
    def held(self) -> tuple[TurnSupport, ...]:
        """The support of each turn, with pins, and where a taut wire keeps to the drawing without a wall."""
        return really_held(self.support, self.plan.pins, self.plan.laid)


def plan_jigs(wires: tuple[Wire, ...], config: JigConfig) -> tuple[PlannedJigs, tuple[Finding, ...]]:
    """The printed jig of these wires, or several; and what the maker should know about them.

    Overbent wires (`springback: compensate`) get a jig each: they don't meet as drawn.
    Raises JigError where no jig can be planned as asked.
    """
    _check_wishes(wires, config)

    def plan(group: tuple[Wire, ...], name: str, others: tuple[Wire, ...]) -> PlannedJig:
        return _planned(group, seats_near(group, others, config) if others else config, name)

    parting = parted(wires, config, plan)
    findings = [*bead_findings(wires), *parting.findings, *form_findings(parting.forms)]
    for jig in parting.jigs:
        laid = jig.plan.laid
        findings += [*jig.findings, *plain_finding(jig.faces, jig.plan.name), *stray_findings(laid)]
        findings += [*support_findings(jig.channels, jig.plan.pins, jig.support, laid, config)]
        findings += hemmed_findings(jig.channels, [wall.outline for wall in jig.plan.walls])
        findings += unheld_findings(jig.held, config)
    return PlannedJigs(parting.jigs, parting.forms), tuple(findings)


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
    standing = walls_of(wires, config)
    return PlannedJig(standing.channels, plan, standing, findings)
