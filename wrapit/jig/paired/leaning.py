"""Which spans of a run walls hold: none where another run lies on that side, as it is bent round that one."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

from wrapit.wires.model import DoubleRun, Side, Turn, Wire

# What is left of a span beside a doubled stretch and is shorter is no turn of its own: where two runs part,
# nothing of that size stands between them. In the tests' S and U with 1.0 or 2.0 the walls are the same.
LEAST_MM = 1.5


def doubles_in(wire: Wire, wires: Iterable[Wire]) -> tuple[DoubleRun, ...]:
    """The doubled stretches of a wire whose other run is of one of these wires."""
    names = {each.name for each in wires}
    return tuple(run for run in wire.doubles if run.other in names)


def walled(spans: Iterable[Turn], wires: Sequence[Wire]) -> tuple[Turn, ...]:
    """What walls are to hold of these spans, in their order: nothing where the run leans on another one.

    The inner one of two runs in a turn has the other on its outside, so its span stays whole.
    """
    runs = _runs(wires)
    if not any(runs.values()):
        return tuple(spans)
    return tuple(part for span in spans for part in _parts(span, runs[span.wire]))


def leaning(wire: Wire, wires: Sequence[Wire]) -> tuple[tuple[Turn, DoubleRun], ...]:
    """The parts of a wire's turns that lean on another run of these wires, each with the stretch it is in."""
    return tuple(
        (replace(turn, start_mm=low, end_mm=high), run)
        for turn in wire.turns
        for run in doubles_in(wire, wires)
        if run.side == turn.inside
        for low, high in [(max(turn.start_mm, run.start_mm), min(turn.end_mm, run.end_mm))]
        if high - low >= LEAST_MM
    )


def beside_mm(wire: Wire, wires: Iterable[Wire], side: Side) -> tuple[tuple[float, float], ...]:
    """Where another run of these wires lies on a side of a wire, from mm to mm."""
    return tuple((run.start_mm, run.end_mm) for run in doubles_in(wire, wires) if run.side == side)


def _runs(wires: Sequence[Wire]) -> dict[str, tuple[DoubleRun, ...]]:
    return {wire.name: doubles_in(wire, wires) for wire in wires}


def _parts(span: Turn, runs: Sequence[DoubleRun]) -> list[Turn]:
    """The parts of a span with no other run on their inside; the whole where there is none at all."""
    taken = sorted(
        (run.start_mm, run.end_mm)
        for run in runs
        if run.side == span.inside and run.start_mm < span.end_mm and span.start_mm < run.end_mm
    )
    if not taken:
        return [span]
    parts, at_mm = [], span.start_mm
    for start, end in [*taken, (span.end_mm, span.end_mm)]:
        if start - at_mm >= LEAST_MM:
            parts.append(replace(span, start_mm=at_mm, end_mm=start))
        at_mm = max(at_mm, end)
    return parts
