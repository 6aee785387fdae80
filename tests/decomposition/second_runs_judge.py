"""Small drawings with second runs, made at random, and the best of all their wires by trying.

All matchings are tried where they are few enough. Where they aren't, every choice of optional segments is,
and what is left then is a plain multigraph: its best matching comes from a solver of those that was itself
held against all matchings. Wishes are judged by what they say about the segments of the drawing.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from itertools import combinations, product

import numpy as np

from tests.decomposition.brute import best_by_trying, energy_by_definition, wires_of
from tests.decomposition.cases import connected, with_some_bridges
from wrapit.config.decomposition import ConstraintConfig
from wrapit.decomposition.constraints import rules_of
from wrapit.decomposition.exact.junction_matching import matchings_of
from wrapit.decomposition.exact.stage import solve_exactly
from wrapit.decomposition.graph import Graph, pieces
from wrapit.decomposition.model import Weights
from wrapit.decomposition.problem import Problem
from wrapit.decomposition.rules import Rules
from wrapit.decomposition.second_runs import with_second_runs
from wrapit.errors import ConfigError

Plain = Callable[[Problem], Sequence[int] | None]
LIMITS = (1, 2, 3, None)
PRICES = (0.0, 0.2, 1.0, 3.0)


def posed(
    seed: int, segments: int, *, bridged: bool = False, wished: bool = False
) -> tuple[Problem, list[ConstraintConfig]]:
    """A connected drawing of up to so many segments with second runs on offer, by turns with each limit of
    wires and each price; and the wishes that its rules come from."""
    rng = np.random.default_rng(seed)
    count = int(rng.integers(1, segments + 1))
    graph = connected(seed, count, int(rng.integers(max(1, count // 2), count + 2)))
    graph = with_second_runs(with_some_bridges(graph, rng) if bridged else graph)
    wishes = _some_wishes(graph, rng) if wished else []
    weights = Weights(doubling=PRICES[seed // len(LIMITS) % len(PRICES)])
    return Problem(graph, weights, rules_of(graph, wishes, True, LIMITS[seed % len(LIMITS)])), wishes


def matchings(graph: Graph) -> int:
    """How many matchings there are."""
    return math.prod(len(matchings_of(len(ends))) if len(ends) < 9 else 10**6 for ends in graph.incident)


def best_of_all(problem: Problem, wishes: Sequence[ConstraintConfig]) -> float:
    """Least energy over all matchings that grant the wishes; infinity where none does."""
    graph, most = problem.graph, problem.rules.most_wires
    return best_by_trying(graph, problem.weights, lambda mate: grants(graph, wishes, most, mate))


def best_of_all_choices(problem: Problem, plain: Plain) -> float:
    """Least energy over all choices of what is optional, each solved by `plain`; infinity where none is.

    Each chosen segment has to join something: what doesn't is no wire. Only for rules that say how
    many wires there may be; where a choice leaves several pieces, they share that number in all ways.
    """
    graph, best, most = problem.graph, math.inf, problem.rules.most_wires
    assert problem.rules == Rules(most_wires=most)
    optional = sorted(graph.optional)
    for used in (some for count in range(len(optional) + 1) for some in combinations(optional, count)):
        price = sum(problem.price(e) for e in used)
        if 1 + price >= best:
            continue
        segments = [e for e in range(graph.segments) if e not in graph.optional or e in used]
        part = problem.part(segments).graph
        chosen = replace(part, bridges=frozenset(), second_runs={})
        joins = tuple(
            tuple({(min(h, b), max(h, b)) for h in (2 * e, 2 * e + 1) for b in chosen.bends_rad[h]})
            for e in (segments.index(e) for e in used)
        )
        alone = Problem(chosen, problem.weights, Rules(required=joins))
        parts = [alone.part(piece) for piece in pieces(chosen)]
        shares: Iterable[tuple[int | None, ...]] = [(None,) * len(parts)]
        if most is not None:
            shares = [each for each in product(range(1, most + 1), repeat=len(parts)) if sum(each) <= most]
        for share in shares:
            best = min(
                best, price + sum(_least(part, n, plain) for part, n in zip(parts, share, strict=True))
            )
    return best


def plainly_solved(problem: Problem) -> tuple[int, ...] | None:
    """By the exact solver, of which other tests show that it solves plain graphs."""
    answer = solve_exactly(problem, 10_000_000)
    return None if answer is None else answer.mate


def _least(problem: Problem, most: int | None, plain: Plain) -> float:
    """The energy of a plain piece by its definition, of at most so many wires."""
    mate = plain(replace(problem, rules=replace(problem.rules, most_wires=most)))
    energy = math.inf if mate is None else energy_by_definition(problem.graph, mate, problem.weights)
    assert energy is not None
    return energy


def grants(graph: Graph, wishes: Sequence[ConstraintConfig], most: int | None, mate: Sequence[int]) -> bool:
    """Whether wires are as wished, by what the wishes say about the segments of the drawing."""
    runs = wires_of(graph, mate)
    assert runs is not None
    return (most is None or len(runs) <= most) and all(_granted(graph, wish, runs, mate) for wish in wishes)


def _granted(graph: Graph, wish: ConstraintConfig, runs: list[set[int]], mate: Sequence[int]) -> bool:
    wires = [{_line(graph, e) for e in wire} for wire in runs]
    transitions = [(a, b) for a, b in enumerate(mate) if a < b]
    passed = [
        {_line(graph, a // 2), _line(graph, b // 2)}
        for a, b in transitions
        if wish.at is None or graph.junction_of[a] == wish.at
    ]
    ends = {graph.junction_of[h] for wire in runs for e in wire for h in (2 * e, 2 * e + 1) if mate[h] < 0}
    longest_mm = max(sum(graph.lengths_mm[e] for e in wire) for wire in runs)
    return (
        (wish.same_wire is None or any(wire.issuperset(wish.same_wire) for wire in wires))
        and all(len(wire.intersection(wish.different_wire or ())) < 2 for wire in wires)
        and (wish.through is None or set(wish.through) in passed)
        and (wish.not_through is None or set(wish.not_through) not in passed)
        and (wish.start_at is None or wish.start_at in ends)
        and (wish.cut_at is None or all(graph.junction_of[a] != wish.cut_at for a, _ in transitions))
        and (wish.max_wire_length is None or longest_mm <= wish.max_wire_length + 1e-6)
    )


def _line(graph: Graph, e: int) -> int:
    return graph.second_runs[e].segment if e in graph.second_runs else e


def _some_wishes(graph: Graph, rng: np.random.Generator) -> list[ConstraintConfig]:
    """A handful of wishes that make sense one by one, and may well contradict one another."""
    lines = graph.segments - len(graph.second_runs)

    def some(least: int) -> list[int]:
        return rng.permutation(lines)[: int(rng.integers(least, 4))].tolist()

    drawn = [
        ("same_wire", some(2), 0.3),
        ("same_wire", some(2), 0.3),
        ("different_wire", some(2), 0.3),
        ("through", rng.permutation(lines)[:2].tolist(), 0.3),
        ("not_through", rng.permutation(lines)[:2].tolist(), 0.5),
        ("start_at", int(rng.integers(len(graph.incident))), 0.3),
        ("cut_at", int(rng.integers(len(graph.incident))), 0.2),
        ("max_wire_length", f"{max(graph.lengths_mm) * rng.uniform(1.0, 4.0):.3f} mm", 0.3),
    ]
    wishes = []
    for key, value, chance in drawn:
        if rng.random() > chance or (isinstance(value, list) and len(value) < 2):
            continue
        # Where two segments meet twice, the wish has to name the junction.
        for junction in [None, *range(len(graph.incident))] if "through" in key else [None]:
            wish = ConstraintConfig.model_validate({key: value, "at": junction})
            try:
                rules_of(graph, [wish], True)
            except ConfigError:
                continue  # makes no sense for this drawing
            wishes.append(wish)
            break
    return wishes
