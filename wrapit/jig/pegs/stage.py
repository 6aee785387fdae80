"""The board with pegs as a kind of jig: the paper's own first attempt (section 5)."""

from __future__ import annotations

import math
from collections import Counter
from typing import Final

from wrapit.config import Config
from wrapit.errors import Finding, JigError, UnheldError
from wrapit.geometry import Region
from wrapit.geometry.outlines.loops import circle, rounded_rectangle
from wrapit.jig.bench.model import Bench, Contact, Handling
from wrapit.jig.bench.touching import in_order, round_runs
from wrapit.jig.channel import Channels
from wrapit.jig.made import Each, JigMaker, Made, View, Wires, one_by_one, reported
from wrapit.jig.pegs.board_page import peg_page
from wrapit.jig.pegs.drawing import board_drawing
from wrapit.jig.pegs.model import Peg, PegPlan, hole_name
from wrapit.jig.pegs.placing import place_pegs


def make(wires: Wires, config: Config, _: Each = one_by_one) -> Made:
    """The board for all wires of a piece; see `JigMaker`."""
    plan = _plan(wires, config)
    if plan.held_share < config.jig.least_support:
        raise UnheldError(
            f"pegs would hold {math.floor(100 * plan.held_share)}% of the turns, "
            f"less than jig.least_support ({config.jig.least_support:.0%})"
        )
    bench = _bench(plan, wires)
    kinds = [kind for kind in ("dxf", "svg") if kind in config.outputs]
    return Made(
        block="pegs",
        numbers=_numbers(plan),
        findings=_findings(plan, config),
        drawings=(board_drawing(plan, wires),),
        views=(View("preview", wires, bench.walls, bench.plate),),
        handling=Handling((bench,)),
        page=peg_page(plan, bench, [f"pegs.{kind}" for kind in kinds], pair=config.pair),
    )


def held(wires: Wires, config: Config) -> float:
    """The share of the turns' length that would follow a peg."""
    return _plan(wires, config).held_share


def _bench(plan: PegPlan, wires: Wires) -> Bench:
    """The board with its pegs, and the turns that each wire makes round them."""
    board = plan.board
    round_pegs = {wire.name: [*round_runs(wire, wires)] for wire in wires}
    for index, peg in enumerate(plan.pegs):
        name = hole_name(peg.cell)
        for turn, _ in peg.turns:
            contact = Contact(turn.start_mm, turn.end_mm, turn.inside, "peg", index, name, peg.diameter_mm)
            round_pegs[turn.wire].append(contact)
    return Bench(
        "board",
        wires,
        tuple(Region(circle(board.place(peg.cell), peg.diameter_mm / 2)) for peg in plan.pegs),
        Region(rounded_rectangle(*board.corners, 3.0)),
        {name: in_order(found) for name, found in round_pegs.items()},
        anchored=False,
    )


def _plan(wires: Wires, config: Config) -> PegPlan:
    if not wires:
        raise JigError("there are no wires to make a jig for")
    return place_pegs(Channels.of(wires, config.jig), config.pegs)


def _numbers(plan: PegPlan) -> dict[str, object]:
    sizes = Counter(peg.diameter_mm for peg in plan.pegs)
    left, bottom, right, top = plan.board.corners
    return {
        "pegs": [_peg_numbers(plan, peg) for peg in plan.pegs],
        "needed": {f"{size:g}": count for size, count in sorted(sizes.items())},
        "turns_served": sum(len(peg.turns) for peg in plan.pegs),
        "turns_unserved": len(plan.unserved),
        "turn_support": reported(plan.held_share),
        "columns": plan.board.columns,
        "rows": plan.board.rows,
        "pitch_mm": plan.board.pitch_mm,
        "size_mm": [reported(right - left), reported(top - bottom)],
    }


def _peg_numbers(plan: PegPlan, peg: Peg) -> dict[str, object]:
    place = [*map(reported, plan.board.place(peg.cell))]
    return {"hole": hole_name(peg.cell), "diameter_mm": peg.diameter_mm, "at": place}


def _findings(plan: PegPlan, config: Config) -> tuple[Finding, ...]:
    smallest = min(config.pegs.diameters)
    return tuple(
        Finding(
            "warning",
            "no-peg",
            f"{turn.wire} at {(turn.start_mm + turn.end_mm) / 2:.0f} mm",
            "no peg on the board stands right for this turn",
            "bend it by hand there, add a diameter to pegs.diameters "
            f"(the thinnest is {smallest:g} mm), or take a board with a smaller pegs.pitch",
            severity=abs(turn.max_curvature_per_mm),
            wire=turn.wire,
            places_mm=((turn.start_mm + turn.end_mm) / 2,),
        )
        for turn in plan.unserved
    )


# The kind, as `jig.kinds` lists it.
PEGS: Final = JigMaker("pegs", solid=False, make=make, held=held)
