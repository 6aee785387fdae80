"""Lines that are mirror images of one another, so that they are treated alike."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

import numpy as np

from wrapit.drawing.reflection import NO_IMAGE, Axis, images_of
from wrapit.fit.sketch import Sketch

# Less of a drawing than this having images is chance, not symmetry.
_SYMMETRIC: Final = 0.6
# How finely lines are looked at for the axis (mm).
_STEP_MM: Final = 0.25


@dataclass(frozen=True, eq=False)
class Mirror:
    """For each line its mirror image, if it has one (itself, on the axis); none where chance would be one."""

    pairs: Mapping[int, int]
    axis: Axis


def mirror_of(sketch: Sketch) -> Mirror:
    """The mirror symmetry of a sketch.

    A mirrored figure has its axis along a principal axis of its lines, upright or level where all are alike.
    """
    numbers = sorted(sketch.lines)
    lines = [sketch.lines[number] for number in numbers]
    points = np.concatenate([line.curve.sampled(_STEP_MM) for line in lines])
    xx, xy, _, yy = np.cov(points.T).ravel()
    principal = math.atan2(2 * xy, xx - yy) / 2
    across_mm = float(np.ptp(points, axis=0).max())
    angles = (math.pi / 2, 0.0, principal, principal + math.pi / 2)
    spread = np.array([line.spread for line in lines])
    lengths = np.array([line.curve.length for line in lines])
    images, share, axis = images_of(spread, lengths, angles, across_mm)
    if share < _SYMMETRIC:
        return Mirror({}, axis)
    pairs = {
        numbers[e]: numbers[images[2 * e] // 2] for e in range(len(numbers)) if images[2 * e] != NO_IMAGE
    }
    return Mirror(pairs, axis)
