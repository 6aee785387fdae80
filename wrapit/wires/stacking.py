"""How high each wire lies where it passes over others that were laid before it."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

import numpy as np

from wrapit.geometry import BSpline, FloatArray
from wrapit.geometry.arclength import ArcLength
from wrapit.wires.beside.pairs import side_by_side
from wrapit.wires.model import DoubleRun
from wrapit.wires.nearness import Near, Neighbours

# How closely wires are compared: heights change by 1e-3 mm with a third more or less.
STEP_MM = 0.1
RAMP_DIAMETERS = 2.5  # a wire rises over another along this many diameters, gently enough to bend by hand
# A wire raised over itself may come to lie higher elsewhere: with 4 rounds our drawings are the same.
SELF_ROUNDS = 6
# How sparse profiles are, for a smooth sweep: heights change by less than 1e-4 mm with a third more or less.
PROFILE_STEP = 6  # stations between the points of a profile
SELF_DIAMETERS = 3.0  # a wire meets itself only farther apart than this along its length

Profile = tuple[tuple[float, float], ...]


def lay_wires(
    splines: Sequence[BSpline], diameter_mm: float, doubles: Sequence[Sequence[DoubleRun]] = ()
) -> list[Profile]:
    """For each wire, in the order in which they are laid, its height profile (at_mm, z_mm).

    A later wire rests on the earlier ones: wherever two centrelines are nearer than a diameter in the
    plane, the later is raised until they are one diameter apart in space, but for runs side by side
    (`doubles` of each wire). Flat wires have no points.
    """
    lines = [ArcLength(spline) for spline in splines]
    stations = [each.stations(STEP_MM) for each in lines]
    points = [each.spline.at(each.parameter(at_mm)) for each, at_mm in zip(lines, stations, strict=True)]
    if not points:
        return []
    cloud = Neighbours.of(np.concatenate(points), diameter_mm)
    heights, every_mm = np.zeros(len(cloud)), np.concatenate(stations)
    owner = np.repeat(np.arange(1, len(stations) + 1), [len(each) for each in stations])
    runs = dict(enumerate(doubles, start=1))
    profiles: list[Profile] = []
    first = 0
    for number, at_mm in enumerate(stations, start=1):
        laid = slice(first, first + len(at_mm))
        pairs = (
            near.chosen(~side_by_side(number, near, every_mm, owner, runs, diameter_mm)) if runs else near
            for near in cloud.before(laid)
        )
        heights[laid] = z_mm = _resting(pairs, laid, at_mm, heights, diameter_mm)
        profiles.append(_points(at_mm, z_mm) if z_mm.max() > 1e-9 else ())
        first += len(at_mm)
    return profiles


def layers_of(profile: Profile, diameter_mm: float) -> int:
    """How many wires lie upon one another where a wire with this height profile lies highest."""
    return 1 + math.ceil(max((z for _, z in profile), default=0.0) / diameter_mm - 1e-3)


def _resting(
    pairs: Iterable[Near], laid: slice, at_mm: FloatArray, heights: FloatArray, d: float
) -> FloatArray:
    """Heights of the stations `laid` of one wire, above those before them that are near."""
    needed, meetings = np.zeros(len(at_mm)), []
    for near in pairs:
        rise = np.sqrt(np.maximum(d**2 - near.apart2, 0.0))
        below = near.earlier < laid.start
        np.maximum.at(needed, near.later[below] - laid.start, (heights[near.earlier] + rise)[below])
        later, earlier = near.later[~below] - laid.start, near.earlier[~below] - laid.start
        itself = at_mm[later] - at_mm[earlier] > SELF_DIAMETERS * d
        meetings.append((later[itself], earlier[itself], rise[~below][itself]))
    profile = _ramped(needed, d)
    for _ in range(SELF_ROUNDS):
        for later, earlier, rise in meetings:
            np.maximum.at(needed, later, profile[earlier] + rise)
        raised = _ramped(needed, d)
        if np.array_equal(raised, profile):
            break
        profile = raised
    return profile


def _ramped(needed: FloatArray, d: float) -> FloatArray:
    """A smooth profile nowhere below `needed`: the highest need near, averaged twice."""
    from scipy.ndimage import maximum_filter1d, uniform_filter1d

    half = round(RAMP_DIAMETERS * d / STEP_MM / 2)
    profile = maximum_filter1d(needed, 4 * half + 1, mode="nearest")
    for _ in range(2):
        profile = uniform_filter1d(profile, 2 * half + 1, mode="nearest")
    return np.where(profile > 1e-9, np.maximum(profile, needed), 0.0)


def _points(at_mm: FloatArray, z_mm: FloatArray) -> tuple[tuple[float, float], ...]:
    """The profile at its ends and where it is raised, close enough for a smooth curve through the points."""
    coarse = np.unique(np.r_[np.arange(0, len(at_mm), PROFILE_STEP), len(at_mm) - 1])
    high = z_mm[coarse] > 0
    near = high | np.r_[high[1:], False] | np.r_[False, high[:-1]]
    near[[0, -1]] = True
    return tuple((round(float(at_mm[i]), 6), round(float(z_mm[i]), 6)) for i in coarse[near])
