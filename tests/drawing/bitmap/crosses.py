"""Two straight strokes that cross, as the ink of many kinds of picture."""

from __future__ import annotations

import numpy as np

from wrapit.drawing.model import Drawing

SHAPE = (300, 360)

CROSS = [np.array([(40.0, 60), (320, 240)]), np.array([(60.0, 250), (300, 50)])]

KINDS = [1, 1, 1, 1, 4]


def junction(drawing: Drawing) -> np.ndarray:
    (index,) = (j for j, ends in enumerate(drawing.half_edges()) if len(ends) == 4)
    frame = drawing.pixel_frame
    assert frame is not None
    return (drawing.junctions[index].point - np.array(frame.origin_mm)) / frame.mm_per_px * [1, -1]
