"""What the user asks of the wires, in terms of half-edges."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from wrapit.decomposition.graph import Graph
from wrapit.decomposition.model import NO_MATE, Pair, half_edges


@dataclass(frozen=True)
class Rules:
    """Conditions on a matching; pairs are sorted half-edges.

    `forbidden` transitions never happen; of each group in `required` one does; at one of each group
    of half-edges in `ends` a wire ends; `same` segments lie on one wire, `apart` segments on two; no
    wire is longer than `longest_mm`, and there are no more than `most_wires`.
    """

    forbidden: frozenset[Pair] = frozenset()
    required: tuple[tuple[Pair, ...], ...] = ()
    ends: tuple[tuple[int, ...], ...] = ()
    same: tuple[Pair, ...] = ()
    apart: tuple[Pair, ...] = ()
    longest_mm: float | None = None
    most_wires: int | None = None

    def renumbered(self, number: Mapping[int, int]) -> Rules:
        """The rules about the half-edges that have a new number."""

        def pairs(group: Iterable[Pair]) -> Iterator[Pair]:
            return ((number[a], number[b]) for a, b in group if a in number and b in number)

        def segments(group: Iterable[Pair]) -> Iterator[Pair]:
            return ((a // 2, b // 2) for a, b in pairs((2 * e, 2 * f) for e, f in group))

        return Rules(
            forbidden=frozenset(pairs(self.forbidden)),
            required=tuple(group for group in (tuple(pairs(group)) for group in self.required) if group),
            ends=tuple(
                group
                for group in (tuple(number[h] for h in ends if h in number) for ends in self.ends)
                if group
            ),
            same=tuple(segments(self.same)),
            apart=tuple(segments(self.apart)),
            longest_mm=self.longest_mm,
            most_wires=self.most_wires,
        )


SLACK_MM = 1e-9
"""By so much a wire may exceed the longest: sums of lengths in another order differ by less."""

NO_RULES = Rules()
"""What most drawings come with: nothing is asked."""


def broken(graph: Graph, rules: Rules, mate: Sequence[int]) -> int:
    """How many conditions a matching breaks, wires that are too long or too many counted one by one."""
    if rules == NO_RULES:
        return 0
    count = sum(mate[a] == b for a, b in rules.forbidden)
    count += sum(all(mate[a] != b for a, b in group) for group in rules.required)
    for ends in rules.ends:
        count += not any(mate[h] == NO_MATE and in_use(graph, mate, h >> 1) for h in ends)
    count += sum(f not in wire_through(mate, e) for e, f in rules.same)
    count += sum(f in wire_through(mate, e) for e, f in rules.apart)
    if rules.longest_mm is not None:
        count += sum(length > rules.longest_mm + SLACK_MM for length in _lengths(graph, mate))
    if rules.most_wires is not None:
        count += max(0, wires(graph, mate) - rules.most_wires)
    return count


def wires(graph: Graph, mate: Sequence[int]) -> int:
    """How many wires a matching without rings makes: half the half-edges in use without a mate."""
    return sum(other == NO_MATE and in_use(graph, mate, h >> 1) for h, other in enumerate(mate)) // 2


def in_use(graph: Graph, mate: Sequence[int], e: int) -> bool:
    """Whether a segment is part of a wire: strokes always, what is optional where it joins something."""
    start, end = half_edges(e)
    return e not in graph.optional or mate[start] != NO_MATE or mate[end] != NO_MATE


def wire_through(mate: Sequence[int], e: int) -> set[int]:
    """Segments of the wire (or ring) that runs along a segment."""
    segments = {e}
    for h in half_edges(e):
        x = mate[h]
        while x != NO_MATE and x >> 1 not in segments:
            segments.add(x >> 1)
            x = mate[x ^ 1]
    return segments


def _lengths(graph: Graph, mate: Sequence[int]) -> Iterator[float]:
    seen: set[int] = set()
    for e in range(graph.segments):
        if e not in seen and in_use(graph, mate, e):
            wire = wire_through(mate, e)
            seen |= wire
            yield sum(graph.lengths_mm[f] for f in sorted(wire))
