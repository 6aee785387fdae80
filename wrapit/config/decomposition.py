"""How the drawing is divided into wires."""

from __future__ import annotations

from typing import Literal

from pydantic import Field, field_validator, model_validator

from wrapit.config.block import Block
from wrapit.config.quantities import PositiveLength

Operator = Literal["join", "split", "permute", "bridge"]


class WeightsConfig(Block):
    """The weights of the energy (paper, section 4.2)."""

    smoothness: float = Field(default=0.1, ge=0)
    """Cost of one radian of bend where a wire passes a junction; above 0.106 more wires may win."""

    robustness: float = Field(default=0.9, ge=0)
    """Cost of a wire that touches the others at one junction only; above 1 it may buy a wire."""

    bridges: float = Field(default=0.1, ge=0)
    """Cost of each added bridge."""

    symmetry: float = Field(default=0.0, ge=0)
    """Cost of each pair of mirrored junctions that wires pass in unlike ways."""


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

    budget: int = Field(default=2_000_000, ge=0)
    """Work that integer programming may take for each piece of the drawing, counted as unknowns ×
    nodes of its search, not in seconds, so that every machine finds the same. Most drawings need none."""


class ConstraintConfig(Block):
    """One wish about the wires; `drawing.svg` shows the numbers of segments and junctions."""

    same_wire: tuple[int, ...] | None = Field(default=None, min_length=2)
    """These segments lie on one wire."""

    different_wire: tuple[int, ...] | None = Field(default=None, min_length=2)
    """Each of these segments lies on another wire."""

    through: tuple[int, int] | None = None
    """A wire passes from one of these segments straight into the other."""

    not_through: tuple[int, int] | None = None
    """No wire passes from one of these segments into the other."""

    at: int | None = None
    """The junction of `through` or `not_through`, where the two segments meet at two."""

    start_at: int | None = None
    """A wire starts or ends at this junction."""

    cut_at: int | None = None
    """All wires end at this junction; none passes it."""

    max_wire_length: PositiveLength | None = None
    """No wire is longer along the drawing: what is left on the spool, less the tails."""

    @model_validator(mode="after")
    def _says_one_thing(self) -> ConstraintConfig:
        said = [key for key, value in self if value is not None and key != "at"]
        if len(said) != 1:
            raise ValueError(
                f"a constraint says one thing, not {len(said)}; "
                "write each as an entry of its own, such as same_wire: [3, 7]"
            )
        if self.at is not None and said[0] not in ("through", "not_through"):
            raise ValueError(f"'at' goes with through or not_through; take it away from {said[0]}")
        return self


class DecompositionConfig(Block):
    """How the drawing is divided into wires."""

    solver: Literal["exact", "annealing"] = "exact"
    """`exact`: the proven best; `annealing`: the paper's search."""

    seed: int = Field(default=1, ge=0)
    """Start of the random numbers; the same seed gives the same wires."""

    weights: WeightsConfig = WeightsConfig()

    mirror: Literal["auto", "vertical", "horizontal"] = "auto"
    """The mirror axis that `weights.symmetry` is about; `auto` finds it."""

    bridges: bool = False
    """Whether short straight bridges may be added between junctions that nearly meet."""

    refine_dangling: Literal["never", "auto"] = Field(
        default="never", json_schema_extra={"enum": ["never", "auto", False, True]}
    )
    """`auto`: a wire that hangs on one junction is taken in by its neighbour and doubled back."""

    constraints: tuple[ConstraintConfig, ...] = ()
    """Wishes about the wires."""

    exact: ExactConfig = ExactConfig()
    annealing: AnnealingConfig = AnnealingConfig()

    @field_validator("refine_dangling", mode="before")
    @classmethod
    def _read_switch(cls, value: object) -> object:
        """People also write `false` for `never`, `true` for `auto`."""
        return {False: "never", True: "auto"}[value] if isinstance(value, bool) else value
