"""The whole config, as the YAML file spells it."""

from __future__ import annotations

from typing import Literal

from pydantic import Field, field_validator

from wrapit.config.bail import BailConfig
from wrapit.config.block import Block
from wrapit.config.decomposition import DecompositionConfig
from wrapit.config.jig import JigConfig
from wrapit.config.plate import PlateConfig
from wrapit.config.quantities import Gauge, Length, PositiveLength
from wrapit.config.tracing import TracingConfig
from wrapit.materials import MetalName, Temper
from wrapit.units import awg_diameter_mm

Output = Literal["step", "stl", "3mf", "dxf", "guide"]


class WireConfig(Block):
    """The metal."""

    gauge: Gauge = awg_diameter_mm(18)
    """Thickness: `18 AWG`, `swg18` or a diameter such as `1.0 mm`."""

    metal: MetalName = "copper"
    """For weight, springback and how tightly it bends; see `wrapit materials`."""

    temper: Temper = "dead soft"
    """How hard the metal is drawn; soft wire bends more tightly."""


class GuideConfig(Block):
    """The step-by-step guide."""

    binding_gauge: Gauge = awg_diameter_mm(28)
    """Thin wire that ties the wires together."""

    binding_turns: int = Field(default=5, ge=1, le=50)
    """Turns of binding wire at each connection."""

    margin: Length = 50.0
    """Extra wire to hold and bend, both ends of a wire together (at least 15 % of its length)."""


class Config(Block):
    """One piece of jewellery: a drawing, a size, a wire; the rest has defaults."""

    name: str = Field(default="", pattern=r"^[\w][\w .-]*$|^$")
    """Name of the piece and of its output folder; the config's file name unless given."""

    drawing: str = Field(min_length=1)
    """The drawing, relative to the config: .png .jpg .bmp .tif .webp, .svg or .json."""

    size: PositiveLength | None = None
    """Longest side of the piece; needed for bitmaps, optional for SVG and JSON drawings."""

    wire: WireConfig = WireConfig()
    tracing: TracingConfig = TracingConfig()
    decomposition: DecompositionConfig = DecompositionConfig()
    jig: JigConfig = JigConfig()
    plate: PlateConfig = PlateConfig()
    guide: GuideConfig = GuideConfig()
    bail: BailConfig | None = None
    """A loop to hang the piece from, `{at: top, diameter: 5 mm}`; none unless given."""

    pair: bool = False
    """Also write the jig and the wires of the mirror image, for a pair of earrings."""

    outputs: tuple[Output, ...] = ("step", "stl", "3mf", "dxf", "guide")
    """Which files to write beside the drawing, the wires and the report."""

    @field_validator("size")
    @classmethod
    def _plausible(cls, size_mm: float | None) -> float | None:
        if size_mm is not None and not 3 <= size_mm <= 1000:
            raise ValueError(f"{size_mm:g} mm is no size for wire jewellery; choose between 3 mm and 1000 mm")
        return size_mm
