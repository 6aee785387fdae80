"""How the drawing is divided into wires."""

from __future__ import annotations

from typing import Literal

from pydantic import Field, field_validator

from wrapit.config.block import Block

Operator = Literal["join", "split", "permute", "bridge"]


class WeightsConfig(Block):
    """The weights of the energy (paper, section 4.2)."""

    smoothness: float = Field(default=0.1, ge=0)
    """Cost of one radian of bend where a wire passes a junction; above 0.106 more wires may win."""

    robustness: float = Field(default=0.9, ge=0)
    """Cost of a wire that touches the others at one junction only; above 1 it may buy a wire."""

    bridges: float = Field(default=0.1, ge=0)
    """Cost of each added bridge."""


class AnnealingConfig(Block):
    """Schedule of the paper's Algorithm 1, read by the solver `annealing`."""

    temperature: float = Field(default=100.0, gt=0)
    """Temperature at the start."""

    cooling: float = Field(default=1e-4, ge=1e-7, lt=1)
    """Share of the temperature lost in each iteration."""

    end_temperature: float = Field(default=1e-4, gt=0)
    """The search ends below this temperature."""

    operators: tuple[Operator, ...] = Field(default=("join", "split", "permute", "bridge"), min_length=1)
    """The changes that are tried, each as often as the others."""

    @field_validator("operators")
    @classmethod
    def _can_move(cls, operators: tuple[Operator, ...]) -> tuple[Operator, ...]:
        if "join" not in operators:
            raise ValueError("without 'join' every segment stays a wire of its own; add 'join'")
        return operators


class ExactConfig(Block):
    """Read by the solver `exact`."""

    budget: int = Field(default=200_000, ge=0)
    """Work that integer programming may take for each piece of the drawing, counted as unknowns ×
    nodes of its search, not in seconds, so that every machine finds the same. Most drawings need none."""


class DecompositionConfig(Block):
    """How the drawing is divided into wires."""

    solver: Literal["exact", "annealing"] = "exact"
    """`exact`: the proven best; `annealing`: the paper's search."""

    seed: int = Field(default=1, ge=0)
    """Start of the random numbers; the same seed gives the same wires."""

    weights: WeightsConfig = WeightsConfig()
    exact: ExactConfig = ExactConfig()
    annealing: AnnealingConfig = AnnealingConfig()
