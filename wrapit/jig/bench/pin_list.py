"""The pins of a jig, told: rods for turns that are too tight for a wall."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from wrapit.decomposition.json_file import wire_number
from wrapit.jig.model import Pin
from wrapit.pages.model import Block, Length, Paragraph, Points, text


def pin_blocks(pins: Iterable[Pin]) -> Iterator[Block]:
    """Which rods stand in which small holes; nothing where there are none."""
    items = tuple(
        text(
            "pin-line",
            wire=wire_number(pin.turn.wire),
            at=Length((pin.turn.start_mm + pin.turn.end_mm) / 2),
            rod=Length(pin.diameter_mm),
        )
        for pin in pins
    )
    if items:
        yield Paragraph(text("pins-how", pins=len(items)))
        yield Points(items)
