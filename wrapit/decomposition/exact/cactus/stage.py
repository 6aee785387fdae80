"""The proven optimum of drawings whose closed loops share no segment, block by block.

A weak wire runs along whole blocks: removing a junction never parts a ring, so a wire that leaves
part of a ring to another one touches that at two junctions. So all that the rest of a drawing has to
know of what hangs on a junction is whether a wire passes through it, and at how many junctions in
there that wire touches others if it has all of the block: none, one, or enough.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from wrapit.decomposition.exact.cactus.blocks import HangingBlock, as_cactus
from wrapit.decomposition.exact.cactus.cut_junction import OutOfWorkError, WorkCounter, options_at
from wrapit.decomposition.exact.cactus.modes import Branch
from wrapit.decomposition.exact.cactus.options import ENOUGH, Option, useful
from wrapit.decomposition.exact.junction_matching import LocalCosts
from wrapit.decomposition.model import NO_MATE
from wrapit.decomposition.problem import CLOSE, Answer, Problem

# Choices looked at for each segment, and at least, before the junctions with many ends are left to others.
# On 145 graphs (29 of them of this kind, up to 214 segments) 0 to 52 and 2000 to 26 000 prove the same in
# the same time.
_WORK = 40
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
    work = WorkCounter(_LEAST_WORK + _WORK * graph.segments)
    options: dict[int, list[Option]] = {}
    try:
        for junction in reversed(cactus.order):
            branches = [
                Branch(block.doors, _hanging(block, options, weak_cost)) for block in cactus.hanging[junction]
            ]
            options[junction] = options_at(cactus.doors[junction], branches, pair, weak_cost, work)
    except OutOfWorkError:
        return None
    (best,) = options[cactus.order[0]]
    mate = [NO_MATE] * (2 * graph.segments)
    for a, b in _pairs(best):
        mate[a], mate[b] = b, a
    least, energy = graph.segments + best.cost, problem.energy(mate).total
    return Answer(tuple(mate), work.done, min(least, energy), energy - least < CLOSE)


def _hanging(block: HangingBlock, options: Mapping[int, list[Option]], weak_cost: float) -> list[Option]:
    """What a block can do, from what the junctions along it can."""
    if len(block.doors) == 1:
        return options[block.junctions[0]]
    # By the number of junctions where the ring is parted, and that of contacts, each up to 2: parted
    # twice, it has a wire in between, and nothing of it can be weak.
    best = {(0, 0): Option(0.0, True, 0)}
    for junction in block.junctions:
        longer: dict[tuple[int, int], Option] = {}
        for (parted, _), before in best.items():
            for option in options[junction]:
                cost, parts = before.cost + option.cost, min(2, parted + (not option.through))
                contacts = ENOUGH if parts == 2 else min(ENOUGH, before.contacts + option.contacts)
                if (parts, contacts) not in longer or cost < longer[parts, contacts].cost:
                    longer[parts, contacts] = Option(cost, not parts, contacts, (), (before, option))
        best = longer
    return useful(best.values(), weak_cost)


def _pairs(option: Option) -> Iterator[tuple[int, int]]:
    """All transitions of an option and its parts."""
    parts = [option]
    while parts:
        part = parts.pop()
        yield from part.pairs
        parts += part.parts
