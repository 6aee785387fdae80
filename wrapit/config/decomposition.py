"""How the drawing is divided into wires."""

from __future__ import annotations

import math
from typing import Annotated, Final, Literal

from pydantic import Field, field_validator, model_validator

from wrapit.config.block import Block
from wrapit.config.quantities import Numbered, length, number, whole

SolverName = Literal["exact", "annealing"]
"""The ways to divide a drawing; `wrapit.decomposition.solvers` holds what each of them does."""

Operator = Literal["join", "split", "permute", "bridge", "double"]

MOST_ITERATIONS: Final = 100_000_000
"""Of the search by annealing: hours of work."""

MOST_CHOICES: Final = 12
"""Of the best ways to divide a drawing, so many are looked for: they take up to 1.4 s on our drawings, twice
as many up to 18 s, for each has to differ from all before it."""


class WeightsConfig(Block):
    """The weights of the energy (paper, section 4.2)."""

    smoothness: Annotated[float, number(0, 1_000)] = 0.1
    """Cost of one radian of bend where a wire passes a junction; above 0.106 more wires may win."""

    robustness: Annotated[float, number(0, 1_000)] = 0.9
    """Cost of a wire that touches the others at one junction only; above 1 it may buy a wire."""

    bridges: Annotated[float, number(0, 1_000)] = 0.1
    """Cost of each added bridge."""

    symmetry: Annotated[float, number(0, 1_000)] = 0.0
    """Cost of each pair of mirrored junctions that wires pass in unlike ways."""

    doubling: Annotated[float, number(0, 1_000)] = 1.0
    """Cost of running along a line of mean length a second time; read with `doubling` and `max_wires`."""


class AnnealingConfig(Block):
    """Schedule of the paper's Algorithm 1, read by the solver `annealing`."""

    temperature: Annotated[float, number(1e-9, 1e9)] = 100.0
    """Temperature at the start."""

    cooling: Annotated[float, number(1e-7, 0.99)] = 1e-4
    """Share of the temperature lost in each iteration."""

    end_temperature: Annotated[float, number(1e-12, 1e6)] = 1e-4
    """The search ends below this temperature."""

    operators: tuple[Operator, ...] = Field(
        default=("join", "split", "permute", "bridge", "double"), min_length=1, max_length=20
    )
    """The changes that are tried, each as often as the others."""

    @field_validator("operators")
    @classmethod
    def _can_move(cls, operators: tuple[Operator, ...]) -> tuple[Operator, ...]:
        if "join" not in operators:
            raise ValueError("without 'join' every segment stays a wire of its own; add 'join'")
        return operators

    @model_validator(mode="after")
    def _ends(self) -> AnnealingConfig:
        start, end = self.temperature, self.end_temperature
        if end >= start:
            raise ValueError(
                f"the search would end at {end:g}, before it starts at {start:g}; "
                "choose an end_temperature below temperature"
            )
        iterations = math.log(end / start) / math.log1p(-self.cooling)
        if iterations > MOST_ITERATIONS:
            enough = -math.expm1(math.log(end / start) / MOST_ITERATIONS)
            raise ValueError(
                f"this schedule takes {iterations:.3g} iterations, more than {MOST_ITERATIONS:,}; "
                f"choose a cooling of {math.ceil(enough * 1e9) / 1e9:g} or more"
            )
        return self


class ExactConfig(Block):
    """Read by the solver `exact`."""

    budget: Annotated[int, whole(0, 1_000_000_000)] = 2_000_000
    """Work that integer programming may take for each piece of the drawing, counted as unknowns ×
    nodes of its search, not in seconds, so that every machine finds the same. Most drawings need none."""


class ConstraintConfig(Block):
    """One wish about the wires; `drawing.svg` shows the numbers of segments and junctions (with `fit`, the
    coloured ones, not the grey ones)."""

    same_wire: tuple[Numbered, ...] | None = Field(
        default=None, min_length=2, max_length=1000, examples=[[3, 7]]
    )
    """These segments lie on one wire."""

    different_wire: tuple[Numbered, ...] | None = Field(
        default=None, min_length=2, max_length=1000, examples=[[1, 2]]
    )
    """Each of these segments lies on another wire."""

    through: tuple[Numbered, Numbered] | None = Field(default=None, examples=[[3, 7]])
    """A wire passes from one of these segments straight into the other."""

    not_through: tuple[Numbered, Numbered] | None = Field(default=None, examples=[[3, 7]])
    """No wire passes from one of these segments into the other."""

    at: Numbered | None = Field(default=None, examples=[4])
    """The junction of `through` or `not_through`, where the two segments meet at two."""

    start_at: Numbered | None = Field(default=None, examples=[4])
    """A wire starts or ends at this junction."""

    cut_at: Numbered | None = Field(default=None, examples=[4])
    """All wires end at this junction; none passes it."""

    max_wire_length: Annotated[float, length("1 mm", "100 m", "300 mm")] | None = Field(
        default=None, examples=["300 mm"]
    )
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

    solver: SolverName = "exact"
    """`exact`: the proven best; `annealing`: the paper's search."""

    seed: Annotated[int, whole(0, 2**53 - 1)] = 1
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

    max_wires: Annotated[int, whole(1, 1_000)] | None = Field(default=None, examples=[1])
    """No piece of the drawing takes more wires: 1 makes one line of it. Where that needs it,
    lines are run along twice, side by side."""

    doubling: bool = False
    """Whether a line may be run along twice wherever that is worth it to save a wire."""

    choice: Annotated[int, whole(1, 1_000)] = 1
    """Which of the best ways to divide it: 1 is the best, 2 the next; `--alternatives` draws them."""

    constraints: tuple[ConstraintConfig, ...] = Field(
        default=(), max_length=1000, examples=[[{"same_wire": [3, 7]}, {"start_at": 4}]]
    )
    """Wishes about the wires, each an entry of its own."""

    exact: ExactConfig = ExactConfig()
    annealing: AnnealingConfig = AnnealingConfig()

    @property
    def second_runs(self) -> bool:
        """Whether lines may be run along twice."""
        return self.doubling or self.max_wires is not None

    @field_validator("refine_dangling", mode="before")
    @classmethod
    def _read_switch(cls, value: object) -> object:
        """People also write `false` for `never`, `true` for `auto`."""
        return {False: "never", True: "auto"}[value] if isinstance(value, bool) else value
