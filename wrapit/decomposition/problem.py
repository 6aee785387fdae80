"""What a solver is asked, and what it answers."""

from __future__ import annotations

from dataclasses import dataclass

from wrapit.decomposition.graph import Graph
from wrapit.decomposition.model import Weights


@dataclass(frozen=True, eq=False)
class Problem:
    """One graph to divide into trails, with the weights of the energy."""

    graph: Graph
    weights: Weights


@dataclass(frozen=True)
class Answer:
    """A matching, and what the solver proved about it.

    `iterations` counts the solver's own steps; `lower_bound` is None where nothing was proved.
    """

    mate: tuple[int, ...]
    iterations: int
    lower_bound: float | None = None
