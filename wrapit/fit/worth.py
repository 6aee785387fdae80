"""What a line is worth to the eye: how much of the picture goes with it."""

from __future__ import annotations

from typing import Final

import numpy as np

from wrapit.fit.faces import Faces
from wrapit.fit.model import Limits
from wrapit.fit.sketch import Sketch

# By where a line lies: the silhouette makes the animal; a leg or whisker outside it tells more than a line
# inside.
_SILHOUETTE: Final = 3.0
_OUTSIDE: Final = 2.0
# A silhouette that is broken anywhere is open: that costs so many mm, however short the line. Beside a face
# that has no room there is another line in its stead.
_OPEN_MM: Final = 15.0
# A place of a line counts in full where the next line is this many wire diameters away, and by the share of
# that where it is nearer: what runs along another line is hardly missed; some of it always is.
_APART: Final = 3.0
_LEAST_NOVELTY: Final = 0.2
# How finely that is looked at (mm), and how many places around each: those of its own line fill 2 × 3 wires.
_STEP_MM: Final = 0.25
_NEIGHBOURS: Final = 48


def worths(sketch: Sketch, faces: Faces, limits: Limits) -> dict[int, float]:
    """For each line its length in mm, weighted by where it lies and by how far it is from others."""
    from scipy.spatial import cKDTree

    numbers = sorted(sketch.lines)
    points = [sketch.lines[number].curve.sampled(_STEP_MM) for number in numbers]
    every, owner = np.concatenate(points), np.repeat(numbers, [len(each) for each in points])
    reach_mm = _APART * limits.diameter_mm
    count = min(_NEIGHBOURS, len(every))
    far, index = cKDTree(every).query(every, k=count, distance_upper_bound=reach_mm)
    far, index = far.reshape(len(every), count), index.reshape(len(every), count)
    other = np.append(owner, -1)[index] != owner[:, None]
    nearest = np.where(other, np.minimum(far, reach_mm), reach_mm).min(axis=1)
    novelty = np.maximum(_LEAST_NOVELTY, nearest / reach_mm)
    bounding = {line for face in faces.faces for line in face.lines}
    closing = {line for face in faces.faces if face.inside_mm >= limits.room_mm for line in face.lines}
    worth = {}
    for number in numbers:
        place = 1.0
        if number in faces.outline:
            place = _SILHOUETTE if number in bounding else _OUTSIDE
        worth[number] = place * sketch.lines[number].curve.length * float(novelty[owner == number].mean())
        if number in faces.outline and number in closing:
            worth[number] += _OPEN_MM
    return worth
