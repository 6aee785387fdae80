"""What the maker should know about a decomposition."""

from __future__ import annotations

from collections.abc import Iterable

from wrapit.decomposition.energy import weak_trails
from wrapit.decomposition.graph import Graph, fewest_possible_wires, pieces
from wrapit.decomposition.json_file import wire_name
from wrapit.decomposition.model import Solution
from wrapit.decomposition.second_runs import SideBySide, cramped
from wrapit.errors import Finding


def findings_of(
    graph: Graph, solution: Solution, room: SideBySide | None = None, proves_more: str = ""
) -> tuple[Finding, ...]:
    """Weak wires, doubled ones, separate pieces, answers that are not proven, and more wires than needed.

    `room` is what two wires side by side need; `proves_more` is what the user can do for a proof, empty where
    the solver promises none.
    """
    return (
        *_weak(graph, solution),
        *(_run_twice(solution, room) if graph.second_runs else _doubled(solution)),
        *_pieces(graph, solution),
        *_unproven(solution, proves_more),
        *_more_than_needed(graph, solution),
    )


def _weak(graph: Graph, solution: Solution) -> list[Finding]:
    return [
        Finding(
            "warning",
            "weak-wire",
            wire_name(index),
            "it is tied to the others at one junction only and can swing about it",
            "extend its line until it meets another one, or set decomposition.refine_dangling: auto",
        )
        for index in weak_trails(graph, solution.trails)
    ]


def _doubled(solution: Solution) -> list[Finding]:
    if not solution.doubled:
        return []
    return [
        Finding(
            "note",
            "doubled-wire",
            "decomposition",
            f"hanging lines are doubled back over themselves: segments {_named(solution.doubled)}",
            "set decomposition.refine_dangling: never to leave them hanging",
        )
    ]


def _run_twice(solution: Solution, room: SideBySide | None) -> list[Finding]:
    if not solution.doubled:
        return []
    drawing = solution.decomposition.drawing
    named = _named(solution.doubled)
    findings = [
        Finding(
            "note",
            "doubled-wire",
            "decomposition",
            f"{solution.doubled_mm:.0f} mm of the lines have two wires side by side: segments {named}",
            "allow more wires with decomposition.max_wires for fewer of them",
        )
    ]
    if tight := sorted(cramped(drawing, room) & set(solution.doubled)):
        findings.append(
            Finding(
                "warning",
                "cramped-double",
                "decomposition",
                f"segments {_named(tight)} are too short or bend too tightly for two wires side by side",
                "allow more wires with decomposition.max_wires, make the piece larger, or use thinner wire",
            )
        )
    return findings


def _named(segments: Iterable[int]) -> str:
    return ", ".join(map(str, segments))


def _pieces(graph: Graph, solution: Solution) -> list[Finding]:
    used = graph.subgraph(
        [e for e in range(graph.segments) if e not in graph.bridges or e in solution.bridges_used]
    )
    count = len(pieces(used))
    if count == 1:
        return []
    return [
        Finding(
            "warning",
            "separate-pieces",
            "drawing",
            f"the wires make {count} pieces that nothing joins",
            "join them with a line, set decomposition.bridges: true, or make them as pieces of their own",
        )
    ]


def _unproven(solution: Solution, proves_more: str) -> list[Finding]:
    if not proves_more or solution.optimal:
        return []
    gap = solution.energy.total - (solution.lower_bound or 0.0)
    return [
        Finding(
            "warning",
            "not-proven-best",
            "decomposition",
            f"better wires may exist: the energy {solution.energy.total:.4f} is at most {gap:.4f} too high",
            proves_more,
        )
    ]


def _more_than_needed(graph: Graph, solution: Solution) -> list[Finding]:
    fewest = fewest_possible_wires(graph)
    if len(solution.trails) <= fewest:
        return []
    return [
        Finding(
            "note",
            "more-wires-than-needed",
            "decomposition",
            f"{len(solution.trails)} wires, where {fewest} could cover the drawing",
            "lower weights.smoothness or weights.robustness, or drop constraints, for fewer wires",
        )
    ]
