"""Wires: the metal, as exact curves with their turns and connections."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np

from wrapit.decomposition.json_file import wire_name
from wrapit.decomposition.model import Traversal
from wrapit.geometry import BSpline, FloatArray
from wrapit.geometry.arclength import ArcLength

# Between a jump ring and the wire it hangs on: it swings, and the kernel sees two solids that don't touch.
RING_GAP_MM = 0.05
Side = Literal["left", "right"]


@dataclass(frozen=True)
class Turn:
    """A span of a wire that the jig has to hold, by arc length.

    `inside` is the side (seen in the direction of travel) where the wall stands. `stretch` says that it is
    no turn but a long stretch between turns.
    """

    wire: str
    start_mm: float
    end_mm: float
    inside: Side
    max_curvature_per_mm: float
    stretch: bool = False


@dataclass(frozen=True)
class Binding:
    """A place where this wire is tied to others."""

    junction: int
    at_mm: float
    others: tuple[str, ...]
    point: tuple[float, float]


@dataclass(frozen=True)
class Bail:
    """A round loop at one end of a wire, with its neck; `start_mm` and `end_mm` are places along the wire."""

    start_mm: float
    end_mm: float
    centre: tuple[float, float]
    inner_diameter_mm: float


@dataclass(frozen=True)
class DoubleRun:
    """A stretch of a wire along which another run of the same lines lies close beside it.

    `start_mm` and `end_mm` are places along this wire; the other run, of the wire `other` (this one or
    another), lies on its `side`, seen in its own direction of travel, `opposed` where that runs the other
    way. `first` says that this run is laid before the other.
    """

    start_mm: float
    end_mm: float
    other: str
    side: Side
    opposed: bool
    first: bool


@dataclass(frozen=True)
class WireBead:
    """A bead at a place along a wire, to its left by `aside_mm` (to its right if negative).

    At 0 it is threaded; any other is sewn to the wire with binding wire.
    """

    at_mm: float
    diameter_mm: float
    aside_mm: float = 0.0

    @property
    def threaded(self) -> bool:
        """Whether the wire runs through it."""
        return self.aside_mm == 0


@dataclass(frozen=True)
class JumpRing:
    """An upright ring hooked round the wire at a point, where that lies `height_mm` over the lowest layer.

    `outward` is the unit direction across the wire in which it hangs out; `free` says that it touches no
    other wire.
    """

    point: tuple[float, float]
    outward: tuple[float, float]
    height_mm: float
    inner_diameter_mm: float
    diameter_mm: float
    free: bool

    @property
    def radius_mm(self) -> float:
        """Of its centreline."""
        return (self.inner_diameter_mm + self.diameter_mm) / 2

    @property
    def centre(self) -> tuple[float, float, float]:
        """Its middle; the wire lies RING_GAP_MM from touching its inside."""
        out = self.radius_mm - self.diameter_mm - RING_GAP_MM
        (x, y), (u, v) = self.point, self.outward
        return x + out * u, y + out * v, self.height_mm

    @property
    def length_mm(self) -> float:
        """Wire in the ring."""
        return math.tau * self.radius_mm


@dataclass(frozen=True, eq=False)
class Wire:
    """One wire; its centreline is one exact cubic B-spline in the plane, in mm.

    `number` counts from 1, in the order in which the wires are laid; it is engraved and drawn, and names it.
    `segment_spans_mm[i]` is where traversal i starts and ends along the wire.
    """

    number: int
    centreline: BSpline
    diameter_mm: float
    length_mm: float
    cut_length_mm: float
    traversals: tuple[Traversal, ...]
    segment_spans_mm: tuple[tuple[float, float], ...]
    turns: tuple[Turn, ...]
    bindings: tuple[Binding, ...]
    min_bend_radius_mm: float
    max_deviation_from_drawing_mm: float
    layers: int
    mass_g: float
    closed: bool
    colour: str
    lifts: tuple[tuple[float, float], ...] = ()
    """Height of the centreline over the lowest layer, (at_mm, z_mm) smooth between; empty is flat."""

    bail: Bail | None = None
    beads: tuple[WireBead, ...] = ()
    """In their order along it."""

    doubles: tuple[DoubleRun, ...] = ()
    """Where it lies beside another run of the same lines, in their order along it."""

    def heights_mm(self, at_mm: FloatArray) -> FloatArray:
        """Heights (m,) of the centreline over the lowest layer at places (m,) along the wire."""
        return np.interp(at_mm, *np.array(self.lifts).T) if self.lifts else np.zeros(len(at_mm))

    @property
    def name(self) -> str:
        """What files and findings call it, such as `wire-01`."""
        return wire_name(self.number - 1)

    @property
    def tail_mm(self) -> float:
        """Spare wire at each end, to hold and to bend down."""
        return (self.cut_length_mm - self.length_mm) / 2

    @property
    def bead_places(self) -> FloatArray:
        """The middles of its beads, (n, 2)."""
        if not self.beads:
            return np.empty((0, 2))
        along = ArcLength(self.centreline).parameter(np.array([bead.at_mm for bead in self.beads]))
        ahead = self.centreline.derivative(along)
        left = np.stack([-ahead[:, 1], ahead[:, 0]], axis=1) / np.linalg.norm(ahead, axis=1)[:, None]
        aside = np.array([bead.aside_mm for bead in self.beads])
        return np.asarray(self.centreline.at(along) + aside[:, None] * left)

    @property
    def ends(self) -> FloatArray:
        """First and last point, (2, 2)."""
        return self.centreline.poles[[0, -1]]
