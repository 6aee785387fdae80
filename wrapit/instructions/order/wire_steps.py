"""The steps of one wire: where it starts, what the hand does, where it passes over, how it ends."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from wrapit.errors import Finding
from wrapit.instructions.model import Crossing, Step, Tie
from wrapit.instructions.order.bead_words import sewing_said, threading_said
from wrapit.instructions.order.beside_words import beside_said
from wrapit.instructions.order.move_words import bail_said, heading_of, lead_said, short_said, turn_said
from wrapit.instructions.order.moves import Move, moves_along
from wrapit.instructions.order.repeats import Stretch, stretches_of
from wrapit.jig.bench.from_above import ONE_HOLE_MM
from wrapit.jig.bench.model import NO_WALL, Bench, Contact
from wrapit.pages.model import Length, Span, Text, listed, text
from wrapit.wires.model import Wire

# What the hand does where the jig alone doesn't, by the finding: each has a text `caution-…`.
BY_HAND: Final = (
    "strays",
    "hemmed",
    "weak-turn",
    "weak-stretch",
    "turn-without-wall",
    "loose-end",
    "no-peg",
    "bead-between-runs",
)
# As on a compass with the picture's top as north.
DIRECTIONS: Final = (
    "right", "upper-right", "up", "upper-left", "left", "lower-left", "down", "lower-right",
)  # fmt: skip
# More places to tie than this on the way are counted, not named: their letters come when they are tied.
MANY_TIES: Final = 4
# The stretch that a start is shown with, to see which way to go.
FIRST_MM: Final = 6.0
# So far from a start the way is told: past the bend of a tail, and the eye sees it on the picture.
AHEAD_MM: Final = 1.5


@dataclass(frozen=True, eq=False)
class Laid:
    """A wire as it is made: in which bench (None: by hand), after which others, with what to mind."""

    wire: Wire
    bench: Bench | None
    earlier: tuple[Wire, ...]
    ties: Mapping[int, Tie]
    crossings: tuple[Crossing, ...]
    findings: tuple[Finding, ...]
    bridges: frozenset[int] = frozenset()

    @property
    def contacts(self) -> Sequence[Contact]:
        """What it lies round."""
        return self.bench.contacts[self.wire.name] if self.bench is not None else ()

    @property
    def anchored(self) -> bool:
        """Whether its tails go down into holes."""
        return self.bench is not None and self.bench.anchored


def wire_steps(laid: Laid, overbend: Sequence[Text]) -> tuple[Step, ...]:
    """From the start to the end of one wire; `overbend` is what to know of springing back before."""
    moves = moves_along(laid.wire, laid.contacts)
    stretches, rest = stretches_of(moves)
    return (
        _start(laid, overbend),
        *(_shape(laid, stretch) for stretch in stretches),
        _end(laid, rest, moves[-1].end_mm),
    )


def _start(laid: Laid, overbend: Sequence[Text]) -> Step:
    wire = laid.wire
    cut = text("start-cut", cut=Length(wire.cut_length_mm), tail=Length(wire.tail_mm))
    if laid.anchored:
        placed = text("start-hole", hole=wire.number)
    elif laid.bench is not None:
        placed = text("start-board")
    else:
        placed = text("start-hand")
    cautions = []
    if laid.bench is not None and wire.name in laid.bench.unmarked:
        cautions.append(text("start-unmarked", hole=wire.number))
    way = text("start-way", way=text(f"way-{direction(wire)}"))
    return Step(
        "start",
        text("heading-start", wire=wire.number),
        (cut, placed, way, *overbend),
        cautions=tuple(cautions),
        wire=wire.number,
        end_mm=min(FIRST_MM, wire.length_mm),
    )


def direction(wire: Wire) -> str:
    """Which of DIRECTIONS a wire goes off to."""
    u = np.linspace(*wire.centreline.domain, 400)
    points = wire.centreline.at(u)
    away_mm = np.linalg.norm(points - points[0], axis=1)
    ahead = points[np.argmax(away_mm >= min(AHEAD_MM, away_mm.max()))] - points[0]
    return DIRECTIONS[round(math.atan2(ahead[1], ahead[0]) / (math.pi / 4)) % len(DIRECTIONS)]


def _shape(laid: Laid, stretch: Stretch) -> Step:
    first = stretch.moves[0]
    texts = [*(lead_said(stretch.lead, stretch.turn) if stretch.lead is not None else ())]
    if not stretch.plain:
        texts.append(text("repeat-pattern", moves=listed(short_said(move) for move in stretch.period)))
    elif stretch.turn.kind == "bail":
        texts.append(bail_said(laid.wire, stretch.turn))
    else:
        texts.append(turn_said(stretch.turn, laid.bench is None))
    if stretch.times > 1:
        texts.append(text("repeat-times", times=stretch.times, moves=len(stretch.moves)))
    start, end = first.start_mm, stretch.moves[-1].end_mm
    walls = [each.index for move in stretch.moves for each in move.contacts if each.index != NO_WALL]
    return _with_notes(
        laid,
        Step(
            "shape",
            heading_of(stretch),
            tuple(texts),
            wire=laid.wire.number,
            start_mm=start,
            end_mm=end,
            moves=stretch.moves,
            times=stretch.times,
            walls=tuple(dict.fromkeys(walls)),
        ),
    )


def _end(laid: Laid, rest: Sequence[Move], length_mm: float) -> Step:
    """How the wire ends: with its last straight run, if there is one."""
    wire = laid.wire
    start_mm = rest[0].start_mm if rest else length_mm
    texts = []
    if rest:
        texts.append(text("end-run", length=Span(start_mm, length_mm)))
    if not laid.anchored:
        texts.append(text("end-mark"))
    elif wire.closed:
        texts.append(text("end-same-hole", hole=wire.number))
    else:
        texts.append(_end_hole(laid))
    step = Step(
        "end",
        text("heading-end", wire=wire.number),
        tuple(texts),
        wire=wire.number,
        start_mm=start_mm,
        end_mm=length_mm,
        moves=tuple(rest),
    )
    return _with_notes(laid, step)


def _end_hole(laid: Laid) -> Text:
    """Into which hole the end goes: another's start, if it lies there, or one without a number."""
    assert laid.bench is not None
    end = laid.wire.ends[1]
    for other in laid.bench.wires:
        if math.dist(other.ends[0], end) < ONE_HOLE_MM:
            return text("end-numbered-hole", hole=other.number)
    return text("end-hole")


def _with_notes(laid: Laid, step: Step) -> Step:
    """The step with what happens on its way: crossings, ties to come, doubled runs, what to mind."""
    wire = laid.wire

    def within(at_mm: float) -> bool:
        return at_mm >= step.start_mm and (at_mm < step.end_mm or step.kind == "end")

    crossings = tuple(each for each in laid.crossings if within(each.at_mm))
    met = [
        (laid.ties[binding.junction].letter, binding.at_mm)
        for binding in wire.bindings
        if binding.junction in laid.ties and within(binding.at_mm)
    ]
    first = (
        *threading_said(wire, within),
        *beside_said(wire, laid.bench.wires if laid.bench is not None else (), within),
    )
    notes = [*sewing_said(wire, within), *_crossing_notes(wire, crossings)]
    bridges = [run for run, traversal in enumerate(wire.traversals) if traversal.segment in laid.bridges]
    if _along(wire, step, bridges):
        notes.append(text("note-bridge"))
    if len(met) > MANY_TIES:
        notes.append(text("note-many-ties", count=len(met)))
    elif met:
        places = listed(text("tie-at", letter=letter, at=Length(at_mm)) for letter, at_mm in met)
        notes.append(text("note-ties", places=places, count=len(met)))
    return replace(
        step,
        texts=(*first, *step.texts, *notes),
        cautions=tuple(_cautions(laid.findings, within)),
        crossings=crossings,
        ties=tuple(dict.fromkeys(letter for letter, _ in met)),
    )


def _crossing_notes(wire: Wire, crossings: Sequence[Crossing]) -> Iterator[Text]:
    """One sentence for all crossings over the same wires."""
    by_wires: dict[tuple[int, ...], list[float]] = {}
    for crossing in crossings:
        by_wires.setdefault(crossing.over, []).append(crossing.at_mm)
    for over, places in by_wires.items():
        others = [text("wire-number", wire=number) for number in over if number != wire.number]
        under = others + [text("itself")] * (wire.number in over)
        yield text("note-over", under=listed(under), places=listed(map(Length, places)))


def _along(wire: Wire, step: Step, runs: Sequence[int]) -> bool:
    """Whether more than half of a step lies along these traversals, or all of one of them lies within it."""
    spans = [wire.segment_spans_mm[run] for run in runs]
    shared = [max(0.0, min(end, step.end_mm) - max(start, step.start_mm)) for start, end in spans]
    whole = any(0 < end - start <= both + 1e-6 for (start, end), both in zip(spans, shared, strict=True))
    return whole or sum(shared) > (step.end_mm - step.start_mm) / 2 > 0


def _cautions(findings: Sequence[Finding], within: Callable[[float], bool]) -> Iterator[Text]:
    """One sentence for all places of a kind that a step passes."""
    for code in BY_HAND:
        places = sorted(
            at_mm
            for finding in findings
            if finding.code == code
            for at_mm in finding.places_mm
            if within(at_mm)
        )
        if places:
            yield text(f"caution-{code}", places=listed(map(Length, places)))
