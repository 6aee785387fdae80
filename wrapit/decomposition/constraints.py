"""The user's constraints, checked against the drawing and turned into rules about half-edges."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

from wrapit.config.decomposition import ConstraintConfig
from wrapit.decomposition.graph import Graph, pieces
from wrapit.decomposition.model import Pair, half_edges, ordered
from wrapit.decomposition.rules import Rules
from wrapit.errors import ConfigError

# Where the user finds the numbers that constraints speak in.
_HELP = "drawing.svg shows the numbers of segments and junctions (with `fit`, the coloured ones)"


def rules_of(
    graph: Graph, constraints: Sequence[ConstraintConfig], bridges: bool, most_wires: int | None = None
) -> Rules:
    """The rules that the constraints make together, second runs included: a wish about a segment is one
    about both its runs, and met by either.

    Raises ConfigError, naming the constraint, for numbers that the drawing doesn't have and for
    what can't be whatever the wires. `bridges` says whether bridges may join the pieces.
    """
    forbidden: set[Pair] = set()
    required: list[tuple[Pair, ...]] = []
    ends: list[tuple[int, ...]] = []
    same: list[tuple[tuple[int, ...], ...]] = []
    apart: list[Pair] = []
    longest_mm: float | None = None
    for index, constraint in enumerate(constraints):
        where = f"decomposition.constraints.{index}"
        if constraint.same_wire is not None:
            _check_segments(graph, constraint.same_wire, where)
            _check_one_piece(graph, constraint.same_wire, bridges, where)
            same.append(tuple(_runs(graph, e) for e in constraint.same_wire))
        elif constraint.different_wire is not None:
            _check_segments(graph, constraint.different_wire, where)
            apart += [
                (run, other)
                for e, f in combinations(constraint.different_wire, 2)
                for run in _runs(graph, e)
                for other in _runs(graph, f)
            ]
        elif constraint.through is not None:
            required.append(_transitions(graph, constraint.through, constraint.at, where))
        elif constraint.not_through is not None:
            forbidden |= set(_transitions(graph, constraint.not_through, constraint.at, where))
        elif constraint.start_at is not None:
            ends.append(_half_edges(graph, constraint.start_at, where))
        elif constraint.cut_at is not None:
            forbidden |= set(combinations(_half_edges(graph, constraint.cut_at, where), 2))
        elif constraint.max_wire_length is not None:
            _check_lengths(graph, constraint.max_wire_length, where)
            longest_mm = min(constraint.max_wire_length, longest_mm or constraint.max_wire_length)
    return Rules(
        frozenset(forbidden),
        tuple(required),
        tuple(ends),
        tuple(same),
        tuple(apart),
        longest_mm,
        most_wires,
    )


def _runs(graph: Graph, e: int) -> tuple[int, ...]:
    """A segment, and its second run where one is offered."""
    return (e, *(other for other, run in graph.second_runs.items() if run.segment == e))


def _check_segments(graph: Graph, segments: Sequence[int], where: str) -> None:
    drawn = graph.segments - len(graph.second_runs)
    for e in segments:
        if not 0 <= e < drawn:
            raise ConfigError(
                f"there is no segment {e}; the drawing has segments 0 to {drawn - 1}", where, _HELP
            )
    if len(set(segments)) < len(segments):
        raise ConfigError("a segment is named twice", where, "name each segment once")


def _check_one_piece(graph: Graph, segments: Sequence[int], bridges: bool, where: str) -> None:
    whole = graph if bridges else graph.subgraph([e for e in range(graph.segments) if e not in graph.bridges])
    for piece in pieces(whole):
        inside = [e for e in segments if e in piece]
        if inside and len(inside) < len(segments):
            outside = next(e for e in segments if e not in inside)
            raise ConfigError(
                f"segments {inside[0]} and {outside} lie on pieces of the drawing that nothing joins",
                where,
                "join the pieces with a line, or set decomposition.bridges: true",
            )


def _transitions(graph: Graph, segments: tuple[int, int], at: int | None, where: str) -> tuple[Pair, ...]:
    """The transitions between two segments, at the junction if one is named."""
    _check_segments(graph, segments, where)
    first, second = segments
    found = [
        ordered(a, b)
        for one in _runs(graph, first)
        for other in _runs(graph, second)
        for a in half_edges(one)
        for b in half_edges(other)
        if graph.junction_of[a] == graph.junction_of[b]
    ]
    junctions = sorted({graph.junction_of[a] for a, _ in found})
    if not found:
        raise ConfigError(f"segments {first} and {second} don't meet", where, _HELP)
    if at is not None and at not in junctions:
        raise ConfigError(f"segments {first} and {second} don't meet at junction {at}", where, _HELP)
    if at is None and len(junctions) > 1:
        raise ConfigError(
            f"segments {first} and {second} meet at junctions {' and '.join(map(str, junctions))}",
            where,
            f"say which, for example at: {junctions[0]}",
        )
    return tuple(pair for pair in found if at is None or graph.junction_of[pair[0]] == at)


def _half_edges(graph: Graph, junction: int, where: str) -> tuple[int, ...]:
    if not 0 <= junction < len(graph.incident) or not graph.incident[junction]:
        raise ConfigError(
            f"there is no junction {junction} where segments end; "
            f"the drawing has junctions 0 to {len(graph.incident) - 1}",
            where,
            _HELP,
        )
    return graph.incident[junction]


def _check_lengths(graph: Graph, longest_mm: float, where: str) -> None:
    strokes = [e for e in range(graph.segments) if e not in graph.optional]
    longest = max(strokes, key=lambda e: graph.lengths_mm[e])
    if graph.lengths_mm[longest] > longest_mm:
        raise ConfigError(
            f"segment {longest} alone is {graph.lengths_mm[longest]:.1f} mm long",
            where,
            "allow longer wires, or make the piece smaller",
        )
