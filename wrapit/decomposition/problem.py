"""What a solver is asked, and what it answers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from wrapit.decomposition.energy import energy_of
from wrapit.decomposition.graph import Graph
from wrapit.decomposition.model import NO_MATE, Energy, Weights
from wrapit.decomposition.rules import NO_RULES, Rules, broken


@dataclass(frozen=True, eq=False)
class Problem:
    """One graph to divide into trails, with the weights of the energy and the user's rules.

    `mirror` gives the mirror image of each half-edge, empty where symmetry has no weight.
    """

    graph: Graph
    weights: Weights
    rules: Rules = NO_RULES
    mirror: tuple[int, ...] = ()

    def energy(self, mate: Sequence[int]) -> Energy:
        """The energy of a matching."""
        return energy_of(self.graph, mate, self.weights, self.mirror)

    def part(self, segments: Sequence[int]) -> Problem:
        """The problem of these segments alone, renumbered in order."""
        number = {h: index for index, h in enumerate(h for e in segments for h in (2 * e, 2 * e + 1))}
        mirror = tuple(number.get(self.mirror[h], NO_MATE) for h in number) if self.mirror else ()
        return Problem(self.graph.subgraph(segments), self.weights, self.rules.renumbered(number), mirror)

    def is_allowed(self, mate: Sequence[int]) -> bool:
        """Whether a matching breaks no rule."""
        return broken(self.graph, self.rules, mate) == 0


@dataclass(frozen=True)
class Answer:
    """A matching, and what the solver proved about it.

    `iterations` counts the solver's own steps; `lower_bound` is None where nothing was proved;
    `proven` says that the energy meets it.
    """

    mate: tuple[int, ...]
    iterations: int
    lower_bound: float | None = None
    proven: bool = False
