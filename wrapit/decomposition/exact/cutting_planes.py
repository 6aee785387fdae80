"""Inequalities that an integer matching breaks: rings, weak wires that go unpaid, the user's rules."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence, Set
from dataclasses import dataclass, field

from wrapit.decomposition.energy import contacts_of
from wrapit.decomposition.exact.ring_bound import ring_of
from wrapit.decomposition.graph import Graph
from wrapit.decomposition.model import NO_MATE, Pair, half_edges, ordered
from wrapit.decomposition.problem import Problem
from wrapit.decomposition.rules import SLACK_MM, in_use, wire_through, wires_and_missed
from wrapit.decomposition.trails import trails_of, walk

Weak = tuple[tuple[int, ...], int]


@dataclass(frozen=True)
class Cut:
    """Σ coefficient · x ≤ limit over transitions, optional segments in use and weak wires.

    `weak` names the variable that is subtracted: one, if the wire along these segments hangs at the
    junction.
    """

    transitions: dict[Pair, float]
    limit: float
    used: dict[int, float] = field(default_factory=dict)
    weak: Weak | None = None


def ring_cuts(graph: Graph, mate: Sequence[int]) -> Iterator[Cut]:
    """For each ring, that it isn't one; and how often all of them together have to be linked."""
    nodes, rings = ring_of(mate)
    for ring in range(1, rings + 1):
        on_it = {h >> 1 for h, node in enumerate(nodes) if node == ring}
        # One transition less than segments in use, of which one at least always is.
        certain = on_it - graph.optional
        some = on_it | _spare(graph, mate, on_it) if certain else on_it
        used = dict.fromkeys(sorted(some & graph.optional), -1.0) if certain else {}
        inside = _ends_of(some)
        yield Cut(dict.fromkeys(_within(graph, inside), 1.0), len(certain or on_it) - 1.0, used)
    if rings > 1:
        yield _partition_cut(graph, nodes, rings)


def weak_cuts(
    problem: Problem, mate: Sequence[int], paid: set[tuple[tuple[int, ...], int, int | None]]
) -> Iterator[Cut]:
    """For each weak wire of a matching without rings, that it has to be paid for; `paid` says which are.

    A wire along exactly these segments has one transition less than segments, and none that leads
    out. What is optional may come into use elsewhere and tie it down.
    """
    graph = problem.graph
    trails = trails_of(graph, mate)
    for trail, contacts in zip(trails, contacts_of(graph, trails), strict=True):
        if len(contacts) != 1:
            continue
        (junction,) = contacts
        segments = tuple(sorted(t.segment for t in trail.traversals))
        tie = _only_tie(graph, mate, segments, junction)
        if (segments, junction, tie) in paid:
            continue
        paid.add((segments, junction, tie))
        inside = _ends_of(segments)
        transitions = dict.fromkeys(_within(graph, inside), 1.0) | dict.fromkeys(_across(graph, inside), -1.0)
        junctions = {graph.junction_of[h] for h in inside} - {junction}
        used = {
            h >> 1: -1.0
            for j in sorted(junctions)
            for h in graph.incident[j]
            if h >> 1 in graph.optional and h not in inside
        }
        limit = len(segments) - 2.0
        if tie is not None:
            used[tie] = 1.0
            limit += 1.0
        yield Cut(transitions, limit, used, (segments, junction))


def rule_cuts(problem: Problem, mate: Sequence[int]) -> Iterator[Cut]:
    """For each rule that a matching breaks and that no row of the programme states from the start."""
    graph, rules = problem.graph, problem.rules
    for lines in rules.same:
        found = wires_and_missed(mate, lines)
        if all(missed for _, missed in found):
            # Whichever run of the first line the wire has, it goes on to what is missed there.
            across = [pair for wire, _ in found for pair in _across(graph, _ends_of(wire))]
            yield Cut(dict.fromkeys(across, -1.0), -1.0)
    if rules.longest_mm is not None:
        yield from _length_cuts(graph, mate, rules.longest_mm)


def exclusion_cut(graph: Graph, mate: Sequence[int]) -> Cut:
    """That a matching isn't this one, wherever its closed wires are left open.

    With its closed wires closed, any other matching has one transition less in common with it than
    it has itself, or some transition besides.
    """
    closed = {(a, b) for a, b in enumerate(mate) if a < b}
    wires = 0
    for h, other in enumerate(mate):
        if other == NO_MATE:
            far = walk(mate, h)[-1] ^ 1
            if h < far and far in graph.bends_rad[h] and in_use(graph, mate, h >> 1):
                closed.add((h, far))
                wires += 1
    transitions = {
        (a, b): 1.0 if (a, b) in closed else -1.0
        for a, mates in enumerate(graph.bends_rad)
        for b in mates
        if a < b
    }
    return Cut(transitions, len(closed) - wires - 1.0)


def _length_cuts(graph: Graph, mate: Sequence[int], longest_mm: float) -> Iterator[Cut]:
    """Segments of a total length need so many wires, and those of a wire that is too long more than one."""
    seen: set[int] = set()
    for e in range(graph.segments):
        if e in seen or not in_use(graph, mate, e):
            continue
        wire = wire_through(mate, e)
        seen |= wire
        if sum(graph.lengths_mm[f] for f in sorted(wire)) <= longest_mm + SLACK_MM:
            continue
        some, longest = wire | _spare(graph, mate, wire), longest_mm + SLACK_MM
        share = {e: graph.lengths_mm[e] / longest for e in sorted(some)}
        certain = some - graph.optional
        # As many wires as the length of what is in use needs, as a fraction; and in whole numbers what is
        # certain needs, or that all of this isn't one wire.
        yield Cut(
            dict.fromkeys(_within(graph, _ends_of(some)), 1.0),
            len(certain) - sum(share[e] for e in sorted(certain)),
            {e: share[e] - 1.0 for e in sorted(some & graph.optional)},
        )
        within = dict.fromkeys(_within(graph, _ends_of(wire)), 1.0)
        needed = math.ceil(sum(share[e] for e in sorted(wire - graph.optional)) - 1e-9)
        if needed > 1:
            used = dict.fromkeys(sorted(wire & graph.optional), -1.0)
            yield Cut(within, len(wire - graph.optional) - needed, used)
        else:
            yield Cut(within, len(wire) - 2.0)


def _partition_cut(graph: Graph, nodes: Sequence[int], rings: int) -> Cut:
    """q rings need q links to one another or to a wire end.

    At a junction with p passes of k rings, a transition that is lost links one ring; among those
    that lead from ring to ring at most a share of (k − 1) / k links anew, since leading back makes
    the last one. So Σ (p − all) + (p − own) · (k − 1) / k ≥ q.
    """
    transitions: dict[Pair, float] = {}
    limit = -float(rings)
    for ends in graph.incident:
        here = [h for h in ends if nodes[h]]
        kinds = len({nodes[h] for h in here})
        if not kinds:
            continue
        share = (kinds - 1) / kinds
        limit += len(here) / 2 * (1 + share)
        for a, b in _within(graph, set(here)):
            transitions[a, b] = 1.0 + (share if nodes[a] == nodes[b] else 0.0)
    return Cut(transitions, limit)


def _only_tie(graph: Graph, mate: Sequence[int], segments: Sequence[int], junction: int) -> int | None:
    """The optional segment that alone makes the junction a contact, if no stroke does."""
    others = [h >> 1 for h in graph.incident[junction] if h >> 1 not in segments]
    if any(e not in graph.optional for e in others):
        return None
    return min(e for e in others if in_use(graph, mate, e))


def _spare(graph: Graph, mate: Sequence[int], segments: Set[int]) -> set[int]:
    """The second runs of these segments that aren't in use."""
    return {
        e for e, run in graph.second_runs.items() if run.segment in segments and not in_use(graph, mate, e)
    }


def _ends_of(segments: Iterable[int]) -> set[int]:
    return {h for e in segments for h in half_edges(e)}


def _within(graph: Graph, inside: set[int]) -> list[Pair]:
    """Transitions between two of the half-edges."""
    return [(a, b) for a in sorted(inside) for b in graph.bends_rad[a] if a < b and b in inside]


def _across(graph: Graph, inside: set[int]) -> list[Pair]:
    """Transitions between one of the half-edges and one of the others."""
    return [ordered(a, b) for a in sorted(inside) for b in graph.bends_rad[a] if b not in inside]
