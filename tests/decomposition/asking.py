"""Short ways to ask for wires, for the tests."""

from __future__ import annotations

from typing import Any

from wrapit.config.decomposition import DecompositionConfig
from wrapit.decomposition.model import Solution
from wrapit.decomposition.stage import decompose
from wrapit.drawing.model import Drawing


def config(**keys: Any) -> DecompositionConfig:
    return DecompositionConfig.model_validate(keys)


def wires(solution: Solution) -> list[set[int]]:
    return [{t.segment for t in trail.traversals} for trail in solution.trails]


def solved(drawing: Drawing, **keys: Any) -> Solution:
    return decompose(drawing, config(**keys))[0]
