"""The wires of a jig as curves to measure against: places by arc length, normals, nearest points."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any, Final

import numpy as np

from wrapit.config import JigConfig
from wrapit.geometry import BezierChain, FloatArray, unit
from wrapit.geometry.arclength import ArcLength
from wrapit.geometry.bezier import evenly_evaluated
from wrapit.geometry.bspline import chain_of
from wrapit.geometry.outlines.exact import Outliner
from wrapit.jig.paired.leaning import walled
from wrapit.wires.model import Side, Turn, Wire

# How a polygon stands for a channel. Chords stray from the centreline by SAGITTA, the buffer's 32 segments a
# quarter from its arcs by 0.71 mm · (1 − cos(π/128)) = 2.1e-4: a polygon PAD too wide holds the true channel
# (sum 3.1e-4 against the pad of 3e-4, and chord and buffer don't err at one place in one direction). A side
# of a wall's polygon that lies within SLACK, four times PAD, of a channel is that channel's, and is made
# exact. Leaf and butterfly: SLACK and SAGITTA 30 % up or
# down change nothing, PAD moves the support by 0.003.
SAGITTA_MM = 1e-4
CHANNEL_PAD_MM = 3e-4
CHANNEL_SLACK_MM = 1.2e-3
# On which side of a wire a turn is held, as a factor of the left normal.
SIDES: Final[dict[Side, float]] = {"left": 1.0, "right": -1.0}
# How many groups of wires are remembered with what was measured of them, from one kind of jig to the next? As
# many as are with their walls (`walls_and_pins`).
_REMEMBERED = 100


@dataclass(frozen=True, eq=False)
class Channels:
    """What the wires that share one jig take up, each with its clearance.

    On the side where a wall holds a wire, that lies on it: there `inside_gap_mm` is enough.
    All have one diameter; ValueError otherwise, or without any wire.
    """

    wires: tuple[Wire, ...]
    clearance_mm: float
    inside_gap_mm: float

    def __post_init__(self) -> None:
        if len({wire.diameter_mm for wire in self.wires}) != 1:
            raise ValueError("a jig takes one or more wires of one diameter")

    def __reduce__(self) -> tuple[type[Channels], tuple[tuple[Wire, ...], float, float]]:
        """What another process gets: not what was measured here, which is many times as much."""
        return Channels, (self.wires, self.clearance_mm, self.inside_gap_mm)

    @staticmethod
    def of(wires: tuple[Wire, ...], config: JigConfig) -> Channels:
        """The wires' channels with the configured clearance; one kind of jig gets those of another."""
        return _remembered(wires, config.clearance, min(config.inside_gap, config.clearance))

    @property
    def diameter_mm(self) -> float:
        """Diameter of the wires."""
        return self.wires[0].diameter_mm

    @property
    def reach_mm(self) -> float:
        """From a wire's centreline to a wall that it only passes."""
        return self.diameter_mm / 2 + self.clearance_mm

    @property
    def face_mm(self) -> float:
        """From a wire's centreline to the face of a wall that holds it."""
        return self.diameter_mm / 2 + self.inside_gap_mm

    @cached_property
    def turns(self) -> tuple[Turn, ...]:
        """The turns and long stretches that walls are to hold, wire after wire."""
        return self.walled(turn for wire in self.wires for turn in wire.turns)

    def walled(self, spans: Iterable[Turn]) -> tuple[Turn, ...]:
        """What of these spans walls are to hold: nothing where a run is bent round another one beside it."""
        return walled(spans, self.wires)

    @cached_property
    def chains(self) -> tuple[BezierChain, ...]:
        """The centrelines as cubics, one chain for each wire."""
        return tuple(chain_of(wire.centreline) for wire in self.wires)

    @cached_property
    def outliner(self) -> Outliner:
        """Makes exact outlines of polygons that lie against the wires' channels."""
        return Outliner.of(self.chains, (self.face_mm, self.reach_mm), CHANNEL_SLACK_MM)

    @cached_property
    def area(self) -> Any:
        """Everything that a wire and its clearance take up, as shapely geometry, CHANNEL_PAD_MM too wide."""
        import shapely

        return shapely.union_all([self.around(index, self.reach_mm) for index in range(len(self.wires))])

    def around(self, index: int, distance_mm: float) -> Any:
        """Everything within a distance of wire `index`, as shapely geometry, CHANNEL_PAD_MM too wide."""
        key = index, distance_mm
        if key not in self._around:
            self._around[key] = self.lines[index].buffer(distance_mm + CHANNEL_PAD_MM, quad_segs=32)
        return self._around[key]

    @cached_property
    def _around(self) -> dict[tuple[int, float], Any]:
        return {}

    @cached_property
    def lines(self) -> tuple[Any, ...]:
        """The centrelines as shapely lines whose chords keep within SAGITTA_MM of them."""
        import shapely

        return tuple(shapely.LineString(self._polyline(index)) for index in range(len(self.wires)))

    def stations(self, turn: Turn, step_mm: float, extra_mm: float = 0.0) -> tuple[FloatArray, ...]:
        """Arc lengths (m,), points (m, 2), left normals (m, 2), curvatures (m,) along a turn.

        `extra_mm` prolongs the turn at both ends, as far as the wire goes.
        """
        index = self.index[turn.wire]
        length, spline = self._lengths[index], self.wires[index].centreline
        low, high = max(0.0, turn.start_mm - extra_mm), min(length.total_mm, turn.end_mm + extra_mm)
        at_mm = np.linspace(low, high, max(2, 1 + int(np.ceil((high - low) / step_mm))))
        u = length.parameter(at_mm)
        tangent = unit(spline.derivative(u))
        return at_mm, spline.at(u), np.column_stack([-tangent[:, 1], tangent[:, 0]]), spline.curvature(u)

    def place(self, turn: Turn) -> str:
        """Where a turn is, for a person: `wire-02 at 41 mm`."""
        return f"{turn.wire} at {(turn.start_mm + turn.end_mm) / 2:.0f} mm"

    @cached_property
    def index(self) -> dict[str, int]:
        """Which wire has a name."""
        return {wire.name: index for index, wire in enumerate(self.wires)}

    @cached_property
    def _lengths(self) -> tuple[ArcLength, ...]:
        return tuple(ArcLength(wire.centreline) for wire in self.wires)

    def _polyline(self, index: int) -> FloatArray:
        """The centreline as points whose chords keep within SAGITTA_MM of it."""
        curves = self.outliner.curves
        pieces = curves.pieces[curves.first[index] : curves.last[index] + 1]
        # The chord of a cubic strays by at most 1/8 of its largest second derivative (per unit parameter).
        second = 6 * np.linalg.norm(np.diff(pieces, n=2, axis=1), axis=2).max(axis=1)
        counts = np.maximum(1, np.ceil(np.sqrt(second / (8 * SAGITTA_MM)))).astype(np.int64)
        return np.concatenate([pieces[:1, 0], evenly_evaluated(pieces, counts)])


@lru_cache(_REMEMBERED)
def _remembered(wires: tuple[Wire, ...], clearance_mm: float, inside_gap_mm: float) -> Channels:
    return Channels(wires, clearance_mm, inside_gap_mm)
