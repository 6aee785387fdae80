"""The proven optimum of drawings whose closed loops share no segment, block by block.

A weak wire runs along whole blocks: removing a junction never parts a ring, so a wire that leaves
part of a ring to another one touches that at two junctions. So all that the rest of a drawing has to
know of what hangs on a junction is whether a wire passes through it, and at how many junctions in
there that wire touches others if it has all of the block: none, one, or enough.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import chain

from wrapit.decomposition.blocks import as_cactus
from wrapit.decomposition.crossing import OutOfWorkError, Work, options_at
from wrapit.decomposition.local import LocalCosts
from wrapit.decomposition.model import NO_MATE
from wrapit.decomposition.modes import Branch
from wrapit.decomposition.options import Option, useful
from wrapit.decomposition.problem import Answer, Problem

_WORK = 40  # choices looked at for each segment
_LEAST_WORK = 20_000


def solved_by_blocks(problem: Problem) -> Answer | None:
    """The best matching of a connected piece without bridges, with no rule but forbidden transitions.

    None where it has rings that share a segment, or takes too much work.
    """
    graph, weak_cost = problem.graph, problem.weights.robustness
    cactus = as_cactus(graph)
    if cactus is None:
        return None
    pair = LocalCosts(problem).pair
    work = Work(_LEAST_WORK + _WORK * graph.segments)
    options: dict[int, list[Option]] = {}
    try:
        for junction in reversed(cactus.order):
            branches = [
                Branch(block.doors, _ring([options[j] for j in block.junctions], weak_cost))
                if len(block.doors) == 2
                else Branch(block.doors, [o._replace(cost=o.cost + 1.0) for o in options[block.junctions[0]]])
                for block in cactus.hanging[junction]
            ]
            options[junction] = options_at(cactus.doors[junction], branches, pair, weak_cost, work)
    except OutOfWorkError:
        return None
    (best,) = options[cactus.order[0]]
    mate = [NO_MATE] * (2 * graph.segments)
    for a, b in _pairs(best):
        mate[a], mate[b] = b, a
    energy = problem.energy(mate).total
    return Answer(tuple(mate), work.done, min(best.cost, energy), energy - best.cost < 1e-9)


def _ring(around: Sequence[Sequence[Option]], weak_cost: float) -> list[Option]:
    """What a ring can do, from what the junctions along it can."""
    # By the number of junctions where the ring is parted, and that of contacts, each up to 2: parted
    # twice, it has a wire in between, and nothing of it can be weak.
    best: dict[tuple[int, int], tuple[float, tuple[Option, ...]]] = {(0, 0): (len(around) + 1.0, ())}
    for options in around:
        longer: dict[tuple[int, int], tuple[float, tuple[Option, ...]]] = {}
        for (parted, contacts), (cost, chosen) in best.items():
            for option in options:
                parts = min(2, parted + (not option.through))
                key = parts, 2 if parts == 2 else min(2, contacts + option.contacts)
                if key not in longer or cost + option.cost < longer[key][0]:
                    longer[key] = cost + option.cost, (*chosen, option)
        best = longer
    return useful(
        (
            Option(cost, parted == 0, contacts, (), chosen)
            for (parted, contacts), (cost, chosen) in best.items()
        ),
        weak_cost,
    )


def _pairs(option: Option) -> Iterator[tuple[int, int]]:
    """All transitions of an option and its parts."""
    level: Iterable[Option] = [option]
    while level := list(level):
        yield from chain.from_iterable(part.pairs for part in level)
        level = chain.from_iterable(part.parts for part in level)
