"""The whole config, as the YAML file spells it."""

from __future__ import annotations

from typing import Annotated, Final, Literal

from pydantic import Field, field_validator

from wrapit.config.bail import BailConfig
from wrapit.config.block import Block
from wrapit.config.decomposition import DecompositionConfig
from wrapit.config.jig import JigConfig
from wrapit.config.naming import LONGEST_NAME, LONGEST_PATH, name_problem, path_problem
from wrapit.config.pegs import PegsConfig
from wrapit.config.plate import PlateConfig
from wrapit.config.quantities import Numbered, length, whole, wire_gauge
from wrapit.config.tracing import TracingConfig
from wrapit.materials import MetalName, Temper
from wrapit.units import awg_diameter_mm

NAME_PATTERN: Final = r'^(?![ .-])[^\\/:*?"<>|\x00-\x1f]*(?<![ .])$'
"""For editors, which know no Unicode classes: `naming` says more exactly what a name is."""

JigKind = Literal["printed", "sheet", "pegs"]
Output = Literal["step", "stl", "3mf", "dxf", "svg", "html", "pdf"]
Language = Literal["en", "de"]
LengthUnit = Literal["mm", "in"]
Paper = Literal["A4", "letter"]


class WireConfig(Block):
    """The metal."""

    gauge: Annotated[float, wire_gauge("0.05 mm", "10 mm", "18 AWG")] = awg_diameter_mm(18)
    """Thickness: `18 AWG`, `swg18` or a diameter such as `1.0 mm`."""

    metal: MetalName = "copper"
    """For weight, springback and how tightly it bends; see `wrapit materials`."""

    temper: Temper = "dead soft"
    """How hard the metal is drawn; soft wire bends more tightly."""


class GuideConfig(Block):
    """The step-by-step guide."""

    binding_gauge: Annotated[float, wire_gauge("0.05 mm", "3 mm", "28 AWG")] = awg_diameter_mm(28)
    """Thin wire that ties the wires together."""

    binding_turns: Annotated[int, whole(1, 50)] = 5
    """Turns of binding wire at each connection."""

    margin: Annotated[float, length("0 mm", "1 m", "50 mm")] = 50.0
    """Extra wire to hold and bend, both ends of a wire together (at least 15 % of its length)."""

    language: Language = "en"
    """English or German."""

    units: LengthUnit = "mm"
    """Lengths in millimetres, or in inches to the sixteenth."""

    paper: Paper = "A4"
    """Sheets that `guide.pdf` is printed on: `A4` or US `letter`."""


class Config(Block):
    """One piece of jewellery: a drawing, a size, a wire; the rest has defaults."""

    name: str = Field(default="", json_schema_extra={"maxLength": LONGEST_NAME, "pattern": NAME_PATTERN})
    """Name of the piece and of its output folder; the config's file name unless given."""

    drawing: str = Field(json_schema_extra={"minLength": 1, "maxLength": LONGEST_PATH})
    """The drawing, relative to the config: .png .jpg .bmp .tif .webp, .svg or .json."""

    size: Annotated[float, length("3 mm", "1000 mm", "40 mm")] | None = None
    """Longest side of the piece; needed for bitmaps, optional for SVG and JSON drawings."""

    wire: WireConfig = WireConfig()
    tracing: TracingConfig = TracingConfig()
    decomposition: DecompositionConfig = DecompositionConfig()
    jig: JigConfig = JigConfig()
    plate: PlateConfig = PlateConfig()
    pegs: PegsConfig = PegsConfig()
    guide: GuideConfig = GuideConfig()
    bail: BailConfig | None = None
    """A loop to hang the piece from, `{at: top, diameter: 5 mm}`; none unless given."""

    fit: Literal["off", "gentle", "bold"] = Field(
        default="off", json_schema_extra={"enum": ["off", "gentle", "bold", False]}
    )
    """Make the drawing fit for this wire first: round what is too tight, merge and leave out what is too
    small, `gentle` only where it has to be, `bold` for few wires and much room."""

    keep: tuple[Numbered, ...] = Field(default=(), max_length=1000, examples=[[3, 7]])
    """Segments that `fit` doesn't leave out; numbers as in the drawing that was read."""

    drop: tuple[Numbered, ...] = Field(default=(), max_length=1000, examples=[[5]])
    """Segments that are left out; numbers as in the drawing that was read."""

    beads: Literal["never", "auto"] = Field(
        default="never", json_schema_extra={"enum": ["never", "auto", False, True]}
    )
    """`auto`: small closed loops and dots of the drawing become beads of their size."""

    pair: bool = False
    """Also write the jig and the wires of the mirror image, for a pair of earrings."""

    jigs: tuple[JigKind, ...] = Field(default=("printed", "sheet"), min_length=1, max_length=3)
    """Which jigs to make: `printed` (a 3D printer's), `sheet` (laser-cut), `pegs` (a board with pegs)."""

    outputs: tuple[Output, ...] = Field(
        default=("step", "stl", "3mf", "dxf", "svg", "html", "pdf"), max_length=7
    )
    """Formats to write beside drawing, wires and report; `html` is the guide, `pdf` a print of it."""

    @property
    def reading(self) -> TracingConfig:
        """How the drawing is read: with `fit`, pieces within it are joined, unless they may be beads."""
        if self.tracing.components != "auto":
            return self.tracing
        weighed = self.fit != "off" and self.beads == "never"
        return self.tracing.model_copy(update={"components": "weigh" if weighed else "largest"})

    @field_validator("name")
    @classmethod
    def _names_a_folder(cls, name: str) -> str:
        if name and (problem := name_problem(name)):
            raise ValueError(problem)
        return name

    @field_validator("fit", mode="before")
    @classmethod
    def _read_off(cls, value: object) -> object:
        """`off` is false for many programs that write YAML; true says not how much."""
        if value is True:
            raise ValueError("true doesn't say how much; write gentle or bold")
        return "off" if value is False else value

    @field_validator("beads", mode="before")
    @classmethod
    def _read_switch(cls, value: object) -> object:
        """People also write `false` for `never`, `true` for `auto`."""
        return {False: "never", True: "auto"}[value] if isinstance(value, bool) else value

    @field_validator("drawing")
    @classmethod
    def _is_a_path(cls, drawing: str) -> str:
        if problem := path_problem(drawing):
            raise ValueError(problem)
        return drawing
