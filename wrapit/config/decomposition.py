"""How the drawing is divided into wires."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from wrapit.config.block import Block


class WeightsConfig(Block):
    """The weights of the energy (paper, section 4.2)."""

    smoothness: float = Field(default=0.1, ge=0)
    """Cost of one radian of bend where a wire passes a junction."""

    robustness: float = Field(default=0.9, ge=0)
    """Cost of a wire that touches the others at fewer than two junctions."""

    bridges: float = Field(default=0.1, ge=0)
    """Cost of each added bridge."""


class AnnealingConfig(Block):
    """Schedule of the paper's Algorithm 1."""

    temperature: float = Field(default=100.0, gt=0)
    """Temperature at the start."""

    cooling: float = Field(default=1e-4, gt=0, lt=1)
    """Share of the temperature lost in each iteration."""

    end_temperature: float = Field(default=1e-4, gt=0)
    """The search ends below this temperature."""


class DecompositionConfig(Block):
    """How the drawing is divided into wires."""

    solver: Literal["annealing"] = "annealing"
    """`annealing`: the paper's search."""

    seed: int = Field(default=1, ge=0)
    """Start of the random numbers; the same seed gives the same wires."""

    weights: WeightsConfig = WeightsConfig()
    annealing: AnnealingConfig = AnnealingConfig()
