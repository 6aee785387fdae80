"""Lines that are mirror images of one another, so that they are treated alike."""

from __future__ import annotations

import math
from typing import Final

import numpy as np

from wrapit.drawing.reflection import NO_IMAGE, images_of
from wrapit.fit.sketch import Sketch

# Less of a drawing than this having images is chance, not symmetry.
_SYMMETRIC: Final = 0.6


def mirror_pairs(sketch: Sketch) -> dict[int, int]:
    """For each line that has one its mirror image (itself, on the axis); nothing if the whole isn't mirrored.

    A mirrored figure has its axis along a principal axis of its lines, upright or level where all are alike.
    """
    numbers = sorted(sketch.lines)
    curves = [sketch.lines[number].curve for number in numbers]
    points = np.concatenate([curve.sampled(0.25) for curve in curves])
    xx, xy, _, yy = np.cov(points.T).ravel()
    principal = math.atan2(2 * xy, xx - yy) / 2
    across_mm = float(np.ptp(points, axis=0).max())
    angles = (math.pi / 2, 0.0, principal, principal + math.pi / 2)
    images, share = images_of(curves, angles, across_mm)
    if share < _SYMMETRIC:
        return {}
    return {numbers[e]: numbers[images[2 * e] // 2] for e in range(len(numbers)) if images[2 * e] != NO_IMAGE}
