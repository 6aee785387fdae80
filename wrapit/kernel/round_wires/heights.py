"""Heights along a wire, as one smooth function: level where the wire lies, cubic where it rises and sinks."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from wrapit.geometry import FloatArray

# Over which part of its diameter is a kink of the heights rounded? Less makes a lifted wire rise faster, more
# keeps it up for longer; 30 % either way change the number of faces by 2 %, volumes by less than 1e-4.
LIFT_ROUNDING = 0.6
# How near to the rounded heights do the cubics run? 1 to 10 µm change the number of faces by 1 %; it is far
# below what a wire is bent to.
HEIGHT_TOLERANCE_MM = 0.004
# How many samples has each rounding? 4 to 8 make no difference to the volume (5.6e-5 of it).
_SAMPLES = 6
# How long are the first cubics tried? The longest ramp of one layer is about five diameters.
_LONGEST_MM = 4.8


def smooth_heights(lifts: Sequence[tuple[float, float]], total_mm: float, diameter_mm: float) -> Any:
    """The height over the planar length, a piecewise cubic of scipy with a continuous first derivative.

    It runs above `lifts`, straight ramps between (at_mm, z_mm), by less than `HEIGHT_TOLERANCE_MM` too little
    at most: the mean over a window of the maximum over the same window is never below the value itself.
    Where that is level the result is, too; between, few cubics with two continuous derivatives follow it.
    """
    from scipy.interpolate import PPoly
    from scipy.ndimage import maximum_filter1d, uniform_filter1d

    count = 1 + max(8, math.ceil(total_mm / (LIFT_ROUNDING * diameter_mm) * _SAMPLES))
    at = np.linspace(0.0, total_mm, count)
    kinks, heights = np.array(lifts).T
    sharp = np.interp(at, kinks, heights)
    # A peak between two samples counts for the next one.
    np.maximum.at(sharp, np.searchsorted(at, kinks).clip(max=count - 1), heights)
    rounded = maximum_filter1d(sharp, 2 * _SAMPLES + 1, mode="nearest")
    for _ in range(2):
        rounded = uniform_filter1d(rounded, _SAMPLES + 1, mode="nearest")
    knots, pieces = [0.0], []
    for first, last in _stretches(rounded):
        if np.ptp(rounded[first : last + 1]) < 1e-9:
            ends, cubics = at[[first, last]], np.array([[0.0], [0.0], [0.0], [rounded[first]]])
        else:
            ends, cubics = _cubics(at[first : last + 1], rounded[first : last + 1])
        knots += ends[1:].tolist()
        pieces.append(cubics)
    return PPoly(np.concatenate(pieces, axis=1), np.array(knots))


def _stretches(rounded: FloatArray) -> list[tuple[int, int]]:
    """First and last sample of each stretch that is level, or is not."""
    changing = np.abs(np.diff(rounded)) > 1e-9
    ends = np.flatnonzero(np.diff(changing)) + 1
    return list(itertools.pairwise([0, *ends.tolist(), len(rounded) - 1]))


def _cubics(at: FloatArray, heights: FloatArray) -> tuple[FloatArray, FloatArray]:
    """As few cubics as follow the samples, level at both ends: their ends and coefficients."""
    from scipy.interpolate import CubicSpline

    count = max(1, math.ceil((at[-1] - at[0]) / _LONGEST_MM))
    while True:
        chosen = np.unique(np.round(np.linspace(0, len(at) - 1, count + 1)).astype(int))
        spline = CubicSpline(at[chosen], heights[chosen], bc_type="clamped")
        if len(chosen) == len(at) or np.abs(spline(at) - heights).max() < HEIGHT_TOLERANCE_MM:
            return at[chosen], spline.c
        count *= 2
