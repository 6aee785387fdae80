"""Small graphs with wishes, bridges and rules, made at random; what the rules mean by their definition."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import product

import numpy as np

from tests.bench.graphs import all_even, random_multigraph
from tests.decomposition.brute import wires_of
from wrapit.decomposition.graph import Graph, pieces
from wrapit.decomposition.rules import Rules


def connected(seed: int, segments: int, junctions: int) -> Graph:
    graph = (all_even if seed % 3 == 0 else random_multigraph)(
        np.random.default_rng(seed), segments, junctions
    )
    return graph.subgraph(max(pieces(graph), key=len))


def some_rules(graph: Graph, rng: np.random.Generator) -> Rules:
    """A handful of wishes, which may well contradict one another."""
    pairs = [(a, b) for a, mates in enumerate(graph.bends_rad) for b in mates if a < b]
    segments = range(graph.segments)

    def pick(things: Sequence[object], chance: float) -> tuple[object, ...]:
        return tuple(thing for thing in things if rng.random() < chance / max(1, len(things)))

    couples = [(e, f) for e in segments for f in segments if e < f]
    longest = max(graph.lengths_mm) * rng.uniform(1.0, 2.5) if rng.random() < 0.4 else None
    return Rules(
        forbidden=frozenset(pick(pairs, 1.0)),
        required=tuple((pair,) for pair in pick(pairs, 0.5)),
        ends=pick([ends for ends in graph.incident if ends], 0.7),
        same=tuple(((e,), (f,)) for e, f in pick(couples, 0.6)),
        apart=pick(couples, 0.6),
        longest_mm=longest,
    )


def obeys(graph: Graph, rules: Rules, mate: Sequence[int]) -> bool:
    """The rules by their definition."""
    wires = wires_of(graph, mate)
    assert wires is not None
    used = set().union(*wires)
    wire_of = {e: index for index, wire in enumerate(wires) for e in wire}
    return (
        all(mate[a] != b for a, b in rules.forbidden)
        and all(any(mate[a] == b for a, b in group) for group in rules.required)
        and all(any(mate[h] < 0 and h // 2 in used for h in ends) for ends in rules.ends)
        and all(
            any(wire.issuperset(runs) for wire in wires for runs in product(*lines)) for lines in rules.same
        )
        and all(wire_of.get(e, -1) != wire_of.get(f, -2) for e, f in rules.apart)
        and (
            rules.longest_mm is None
            or all(sum(graph.lengths_mm[e] for e in wire) <= rules.longest_mm + 1e-6 for wire in wires)
        )
    )


def with_some_bridges(graph: Graph, rng: np.random.Generator) -> Graph:
    """Up to two segments that join two junctions become bridges, as long as a stroke is left at each."""
    bridges: set[int] = set()
    for e in rng.permutation(graph.segments)[:2].tolist():
        ends = {graph.junction_of[2 * e], graph.junction_of[2 * e + 1]}
        strokes_stay = all(
            any(h // 2 != e and h // 2 not in bridges for h in graph.incident[j]) for j in ends
        )
        if len(ends) == 2 and strokes_stay:
            bridges.add(e)
    return replace(graph, bridges=frozenset(bridges))


def closed_up(graph: Graph, mate: Sequence[int]) -> frozenset[tuple[int, int]]:
    """The transitions with closed wires closed, which says what a decomposition looks like."""
    pairs = {(a, b) for a, b in enumerate(mate) if a < b}
    wires = wires_of(graph, mate)
    assert wires is not None
    for wire in wires:
        a, b = sorted(h for e in wire for h in (2 * e, 2 * e + 1) if mate[h] < 0)
        if graph.junction_of[a] == graph.junction_of[b] and a // 2 != b // 2:
            pairs.add((a, b))
    return frozenset(pairs)
