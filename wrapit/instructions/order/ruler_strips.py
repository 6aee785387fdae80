"""A ruler strip for each wire: where its mark, its wraps and its ties lie along the straight wire."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from wrapit.instructions.model import Chapter, Strip, StripMark, Tie
from wrapit.jig.model import SameShape
from wrapit.wires.model import Wire


def strips_of(
    wires: Sequence[Wire],
    forms: Sequence[SameShape],
    chapters: Sequence[Chapter],
    ties: Sequence[Tie],
) -> tuple[Strip, ...]:
    """In the order of the wires; a wire made in another's place has that one's wraps."""
    number = {wire.name: wire.number for wire in wires}
    by_wire = {form.wire: form for form in forms}
    steps = [step for chapter in chapters for step in chapter.steps]
    strips = []
    for wire in wires:
        form = by_wire.get(wire.name)
        like = number[form.like] if form is not None else wire.number
        tail_mm = wire.tail_mm
        marks = [
            StripMark(tail_mm, tail_mm, "", "start"),
            StripMark(tail_mm + wire.length_mm, tail_mm + wire.length_mm, "", "end"),
        ]
        for place, step in enumerate(steps, start=1):
            if step.wire == like and step.kind == "shape":
                marks += [
                    StripMark(tail_mm + move.start_mm, tail_mm + move.end_mm, str(place), "wrap")
                    for move in step.moves
                    if move.kind != "straight"
                ]
        backwards = form is not None and form.reversed
        marks += list(_ties(wire, ties, tail_mm, backwards=backwards))
        ordered = sorted(marks, key=lambda mark: (mark.start_mm, mark.end_mm))
        strips.append(Strip(wire.number, wire.cut_length_mm, tuple(ordered)))
    return tuple(strips)


def _ties(wire: Wire, ties: Sequence[Tie], tail_mm: float, *, backwards: bool) -> Iterator[StripMark]:
    letters = {tie.junction: tie.letter for tie in ties}
    for binding in wire.bindings:
        if binding.junction in letters:
            at_mm = tail_mm + (wire.length_mm - binding.at_mm if backwards else binding.at_mm)
            yield StripMark(at_mm, at_mm, letters[binding.junction], "tie")
