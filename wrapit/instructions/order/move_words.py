"""Moves as sentences: to which side, by how much, round what, over which length."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Final

from wrapit.instructions.order.moves import Move
from wrapit.instructions.order.repeats import Stretch
from wrapit.pages.model import Length, Span, Text, Thickness, text
from wrapit.wires.model import Wire

# Wire that is led to the next wall makes a curve of this much by itself; more is for fingers.
LET_RUN_RAD: Final = math.radians(45)


def heading_of(stretch: Stretch) -> Text:
    """What a step along a wire is called."""
    if stretch.times > 1:
        return text("heading-repeat", times=stretch.times)
    turn = stretch.turn
    return text(f"heading-{turn.kind}", side=side_of(turn))


def lead_said(lead: Move, turn: Move) -> Iterator[Text]:
    """The straight run before a bend, and to what it leads."""
    length = Span(lead.start_mm, lead.end_mm)
    if turn.contacts:
        first = turn.contacts[0]
        yield text(f"lead-to-{first.around}", length=length, side=first.side, hole=first.label)
    else:
        yield text("lead-on", length=length)


def bail_said(wire: Wire, move: Move) -> Text:
    """The loop to hang the piece from, at one end of a wire."""
    assert wire.bail is not None
    rod = Thickness(wire.bail.inner_diameter_mm)
    return text("do-bail", length=Span(move.start_mm, move.end_mm), rod=rod)


def turn_said(move: Move, by_hand: bool) -> Text:
    """One bend, curve or wrap as a sentence."""
    made: str = move.kind
    hole, rod = "", Thickness(0.0)
    # Back beside itself a wire is bent round what stands in its narrow loop, not round its own first run.
    hairpin = move.kind == "hairpin"
    contacts = [each for each in move.contacts if not hairpin or each.around != "run"]
    if contacts:
        first = contacts[0]
        kind = "hairpin" if hairpin else "wrap"
        made, hole, rod = f"{kind}-{first.around}", first.label, Thickness(first.rod_mm)
    elif move.kind == "curve" and (by_hand or abs(move.turn_rad) > LET_RUN_RAD):
        made = "by-hand-curve"
    return text(
        f"do-{made}",
        side=side_of(move),
        angle=degrees(move),
        length=Span(move.start_mm, move.end_mm),
        radius=Length(move.radius_mm),
        turns=_turns(move),
        hole=hole,
        rod=rod,
        walls=len({contact.index for contact in move.contacts}),
    )


def short_said(move: Move) -> Text:
    """The same within a list: `120° to the left`."""
    return text(
        "short-turn" if move.kind != "straight" else "short-run",
        side=side_of(move),
        angle=degrees(move),
        length=Span(move.start_mm, move.end_mm),
    )


def side_of(move: Move) -> str:
    """To which side a move bends, in the direction of travel."""
    return "left" if move.turn_rad > 0 else "right"


def degrees(move: Move) -> int:
    """To five degrees, as a hand can tell."""
    return round(math.degrees(abs(move.turn_rad)) / 5) * 5


def _turns(move: Move) -> float:
    return round(abs(move.turn_rad) / math.tau, 1)
