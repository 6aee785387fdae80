"""The laser-cut jig: an inlay of sheet parts, and what the laser draws for it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from wrapit.geometry import FloatArray, Region
from wrapit.jig.contours import Contour
from wrapit.jig.model import Pin, SameShape
from wrapit.wires.model import Wire

PartRole = Literal["bottom", "pocket plate", "island", "wall"]


@dataclass(frozen=True, eq=False)
class LaserPart:
    """A part cut from sheet: `shape` is the finished part where it lies in the jig.

    `contours` are what the laser draws there: cuts half a kerf outside of the part, and engraving.
    `copies` are stacked upon one another; `label` is engraved on it or beside it.
    """

    label: str
    role: PartRole
    jig: str
    shape: Region
    thickness_mm: float
    contours: tuple[Contour, ...]
    copies: int = 1


@dataclass(frozen=True, eq=False)
class Placed:
    """A part on a sheet: turned by right angles, then shifted."""

    part: LaserPart
    quarters: int
    shift: tuple[float, float]

    @property
    def contours(self) -> tuple[Contour, ...]:
        """What the laser draws, on the sheet."""
        return tuple(contour.moved(self.quarters, self.shift) for contour in self.part.contours)


@dataclass(frozen=True, eq=False)
class LaserSheet:
    """One sheet of material with its parts; its lower left corner is the origin.

    `marks` are engraved beside the parts.
    """

    number: int
    thickness_mm: float
    width_mm: float
    height_mm: float
    placed: tuple[Placed, ...]
    marks: tuple[Contour, ...] = ()

    @property
    def contours(self) -> tuple[Contour, ...]:
        """Everything that the laser draws on this sheet, part after part."""
        return (*self.marks, *(contour for placed in self.placed for contour in placed.contours))


@dataclass(frozen=True)
class LaserChecks:
    """What was measured on the sheets as they are drawn; None where there is nothing to measure."""

    closed_contours: int
    min_cut_distance_mm: float | None
    min_web_mm: float | None
    cut_length_mm: float
    engraved_length_mm: float


@dataclass(frozen=True, eq=False)
class LaserJig:
    """All parts, their sheets, and the measurements; `wall_height_mm` is what stands above the plate.

    `pins` are nails or rods that stand in holes where a turn is too tight for a wall. `laid` are the wires
    that each jig is for, by its name, as they lie in it, `taut` the courses (m, 2) of those that stray there
    visibly; `forms` are wires that have the shape of one.
    """

    parts: tuple[LaserPart, ...]
    laid: Mapping[str, tuple[Wire, ...]]
    taut: Mapping[str, tuple[FloatArray, ...]]
    forms: tuple[SameShape, ...]
    sheets: tuple[LaserSheet, ...]
    kerf_mm: float
    fit_mm: float
    wall_height_mm: float
    pins: tuple[Pin, ...]
    checks: LaserChecks
