"""Where a wire meets the others and is tied to them."""

from __future__ import annotations

from collections.abc import Sequence

from wrapit.decomposition.model import Trail
from wrapit.drawing.model import Drawing
from wrapit.wires.model import Binding

Spans = Sequence[tuple[float, float]]


def find_bindings(
    drawing: Drawing, trails: Sequence[Trail], names: Sequence[str], spans_mm: Sequence[Spans]
) -> list[tuple[Binding, ...]]:
    """For each wire its connections, in its own order; a wire that crosses itself is tied to itself."""
    visits = [_visits(drawing, trail, spans) for trail, spans in zip(trails, spans_mm, strict=True)]
    passing: dict[int, list[str]] = {}
    for name, stops in zip(names, visits, strict=True):
        for junction, _ in stops:
            passing.setdefault(junction, []).append(name)
    return [
        tuple(
            Binding(junction, at_mm, others, (float(point[0]), float(point[1])))
            for junction, at_mm in stops
            if (others := _others(passing[junction], name))
            for point in [drawing.junctions[junction].point]
        )
        for name, stops in zip(names, visits, strict=True)
    ]


def _others(passing: Sequence[str], name: str) -> tuple[str, ...]:
    others = list(passing)
    others.remove(name)
    return tuple(sorted(set(others)))


def _visits(drawing: Drawing, trail: Trail, spans: Spans) -> list[tuple[int, float]]:
    """Each junction that a trail stands on, with the arc length there."""
    stops = []
    for index, (step, span) in enumerate(zip(trail.traversals, spans, strict=True)):
        segment = drawing.segments[step.segment]
        first, last = (segment.end, segment.start) if step.reversed else (segment.start, segment.end)
        if index == 0:
            stops.append((first, span[0]))
        stops.append((last, span[1]))
    return stops
