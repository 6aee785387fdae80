"""What the user asks of the wires, in terms of half-edges."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations

from wrapit.decomposition.graph import Graph
from wrapit.decomposition.model import NO_MATE, Pair, half_edges


@dataclass(frozen=True)
class Rules:
    """Conditions on a matching; pairs are sorted half-edges.

    `forbidden` transitions never happen; of each group in `required` one does; at one of each group
    of half-edges in `ends` a wire ends; of the lines of each group in `same` one wire has them all,
    each by any of its runs; `apart` segments lie on two wires; no wire is longer than `longest_mm`, and no
    connected piece has more than `most_wires`.
    """

    forbidden: frozenset[Pair] = frozenset()
    required: tuple[tuple[Pair, ...], ...] = ()
    ends: tuple[tuple[int, ...], ...] = ()
    same: tuple[tuple[tuple[int, ...], ...], ...] = ()
    apart: tuple[Pair, ...] = ()
    longest_mm: float | None = None
    most_wires: int | None = None

    def renumbered(self, number: Mapping[int, int]) -> Rules:
        """The rules about the half-edges that have a new number."""

        def pairs(group: Iterable[Pair]) -> Iterator[Pair]:
            return ((number[a], number[b]) for a, b in group if a in number and b in number)

        def runs(lines: Iterable[tuple[int, ...]]) -> tuple[tuple[int, ...], ...]:
            kept = (tuple(number[2 * e] // 2 for e in line if 2 * e in number) for line in lines)
            return tuple(line for line in kept if line)

        return Rules(
            forbidden=frozenset(pairs(self.forbidden)),
            required=tuple(group for group in (tuple(pairs(group)) for group in self.required) if group),
            ends=tuple(
                group
                for group in (tuple(number[h] for h in ends if h in number) for ends in self.ends)
                if group
            ),
            same=tuple(lines for lines in map(runs, self.same) if len(lines) > 1),
            apart=tuple((a // 2, b // 2) for a, b in pairs((2 * e, 2 * f) for e, f in self.apart)),
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
    count += sum(min(len(missed) for _, missed in wires_and_missed(mate, lines)) for lines in rules.same)
    count += sum(f in wire_through(mate, e) for e, f in rules.apart)
    if rules.longest_mm is not None:
        count += sum(length > rules.longest_mm + SLACK_MM for length in _lengths(graph, mate))
    if rules.most_wires is not None:
        count += sum(max(0, n - rules.most_wires) for n in wires_of_pieces(graph, mate).values())
    return count


def wires_of_pieces(graph: Graph, mate: Sequence[int]) -> dict[int, int]:
    """How many wires a matching without rings makes of each connected piece: half the ends in use."""
    free = (h >> 1 for h, other in enumerate(mate) if other == NO_MATE and in_use(graph, mate, h >> 1))
    return {piece: ends // 2 for piece, ends in Counter(graph.piece_of[e] for e in free).items()}


def contradict(graph: Graph, rules: Rules) -> bool:
    """Whether it can be seen at once that no matching keeps the rules: which search finds out slowly.

    Lines that lie on one wire and on two, and more lines of a piece that lie on a wire each than it has.
    """
    apart = {frozenset(pair) for pair in rules.apart}
    for lines in rules.same:
        if any(frozenset((one[0], other[0])) in apart for one, other in combinations(lines, 2)):
            return True
    if rules.most_wires is None or not apart:
        return False
    strokes = sorted({e for pair in rules.apart for e in pair if e not in graph.optional})
    for first in strokes:
        some = [first]
        for e in strokes:
            if all(graph.piece_of[e] == graph.piece_of[f] and frozenset((e, f)) in apart for f in some):
                some.append(e)
        if len(some) > rules.most_wires:
            return True
    return False


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


def wires_and_missed(
    mate: Sequence[int], lines: Sequence[tuple[int, ...]]
) -> list[tuple[set[int], list[tuple[int, ...]]]]:
    """The wire through each run of the first of these lines, and those of the lines that it has no run of."""
    wires_there = [wire_through(mate, e) for e in lines[0]]
    return [(wire, [line for line in lines if wire.isdisjoint(line)]) for wire in wires_there]


def _lengths(graph: Graph, mate: Sequence[int]) -> Iterator[float]:
    seen: set[int] = set()
    for e in range(graph.segments):
        if e not in seen and in_use(graph, mate, e):
            wire = wire_through(mate, e)
            seen |= wire
            yield sum(graph.lengths_mm[f] for f in sorted(wire))
