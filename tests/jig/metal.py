"""Wires made directly from curves, without a drawing, and their jigs."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from wrapit.config import JigConfig
from wrapit.geometry import BezierChain, BSpline, FloatArray, from_chain, straight
from wrapit.geometry.bspline import chain_of
from wrapit.geometry.outlines.loops import Arc, as_chain
from wrapit.jig.model import Jig
from wrapit.jig.printed.stage import build_jig
from wrapit.wires.model import Wire
from wrapit.wires.stacking import lay_wires, layers_of
from wrapit.wires.turns import find_turns

AWG18_MM = 1.0237


def wires_of(
    chains: Sequence[BezierChain], config: JigConfig | None = None, diameter_mm: float = AWG18_MM
) -> tuple[Wire, ...]:
    """One wire along each chain, with its turns and heights."""
    config = config or JigConfig()
    splines = [from_chain(chain) for chain in chains]
    lifts = lay_wires(splines, diameter_mm)
    return tuple(
        Wire(
            number=index,
            centreline=spline,
            diameter_mm=diameter_mm,
            length_mm=chain.length,
            cut_length_mm=chain.length + 50,
            traversals=(),
            segment_spans_mm=(),
            turns=find_turns(f"wire-{index:02d}", spline, config)[0],
            bindings=(),
            min_bend_radius_mm=1.0,
            max_deviation_from_drawing_mm=0.0,
            layers=layers_of(lift, diameter_mm),
            mass_g=1.0,
            closed=bool(np.allclose(chain.start, chain.end)),
            colour="#b87333",
            lifts=lift,
        )
        for index, (chain, spline, lift) in enumerate(zip(chains, splines, lifts, strict=True), start=1)
    )


def config(**values: object) -> JigConfig:
    """Jig settings as a user would write them."""
    return JigConfig.model_validate(values)


def only(chains: Sequence[BezierChain], **values: object) -> Jig:
    """The single jig of wires along these chains."""
    settings = config(**values)
    jigs, _ = build_jig(wires_of(chains, settings), settings)
    assert jigs.split == "single"
    (jig,) = jigs.jigs
    return jig


def circle(radius_mm: float, centre: tuple[float, float] = (0.0, 0.0)) -> BezierChain:
    """A closed circle, counter-clockwise."""
    return as_chain(Arc(centre, radius_mm, 0.0, 2 * math.pi))


def line(start: tuple[float, float], end: tuple[float, float]) -> BezierChain:
    """A straight wire."""
    return straight(start, end)


def arcs(start: tuple[float, float], heading_rad: float, *parts: tuple[float, float]) -> BezierChain:
    """Tangent arcs and lines: (radius, turn in degrees; positive is left), or (length, 0) for a line."""
    at, heading = np.array(start), heading_rad
    pieces = []
    for size, degrees in parts:
        if degrees == 0:
            end = at + size * np.array([math.cos(heading), math.sin(heading)])
            pieces.append(straight(at, end).points)
        else:
            sweep = math.radians(degrees)
            left = np.array([-math.sin(heading), math.cos(heading)]) * math.copysign(1.0, sweep)
            centre = at + size * left
            first = math.atan2(*(at - centre)[::-1])
            pieces.append(as_chain(Arc((centre[0], centre[1]), size, first, sweep)).points)
            heading += sweep
        pieces[-1] = pieces[-1].copy()
        pieces[-1][0, 0] = at
        at = pieces[-1][-1, 3]
    return BezierChain(np.concatenate(pieces))


def through(points: FloatArray, closed: bool = False) -> BezierChain:
    """A smooth wire through points."""
    from scipy.interpolate import CubicSpline

    points = np.asarray(points, dtype=float)
    if closed:
        points = np.concatenate([points, points[:1]])
    u = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    spline = CubicSpline(u, points, bc_type="periodic" if closed else "natural")
    value, slope = spline(u), spline(u, 1)
    third = (np.diff(u) / 3)[:, None]
    cubics = np.stack(
        [value[:-1], value[:-1] + third * slope[:-1], value[1:] - third * slope[1:], value[1:]], axis=1
    )
    if closed:
        cubics[-1, 3] = cubics[0, 0]
    return BezierChain(cubics)


def spiral(pitch_mm: float, turns: float, inner_mm: float = 2.0) -> BezierChain:
    """An Archimedean spiral from inside out."""
    angle = np.linspace(0, 2 * math.pi * turns, int(16 * turns) + 1)
    radius = inner_mm + pitch_mm * angle / (2 * math.pi)
    return through(np.column_stack([radius * np.cos(angle), radius * np.sin(angle)]))


def scribble(rng: np.random.Generator, size_mm: float, points: int, closed: bool = False) -> BezierChain:
    """A random smooth wire that may cross itself."""
    steps = rng.normal(size=(points, 2))
    smooth = np.cumsum(steps, axis=0)
    smooth -= smooth.min(axis=0)
    smooth *= size_mm / max(float(smooth.max()), 1e-9)
    far = np.concatenate([[True], np.linalg.norm(np.diff(smooth, axis=0), axis=1) > 0.05 * size_mm])
    return through(smooth[far] if far.sum() > 3 else smooth, closed)


def spline_chain(poles: FloatArray, knots: FloatArray) -> BezierChain:
    """The Béziers of a cubic B-spline."""
    return chain_of(BSpline(3, poles, knots))
