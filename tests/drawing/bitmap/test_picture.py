"""Pictures of any scale are brought to one where strokes are a dozen pixels wide."""

from __future__ import annotations

import numpy as np
import pytest
from PIL import Image

from tests.drawing.bitmap.crosses import CROSS, KINDS, SHAPE, junction
from tests.drawing.generated import degrees, render
from wrapit.config import TracingConfig
from wrapit.drawing.stage import trace


@pytest.mark.parametrize(("factor", "width"), [(0.28, 2.2), (1.0, 8.0), (4.0, 60.0)])
def test_size_in_pixels_hardly_matters(factor, width, tmp_path):
    shape = (int(SHAPE[0] * factor), int(SHAPE[1] * factor))
    Image.fromarray(render([curve * factor for curve in CROSS], width, shape)).save(tmp_path / "scaled.png")
    drawing, _ = trace(tmp_path / "scaled.png", TracingConfig(), 40.0)
    assert degrees(drawing) == KINDS
    a, b = CROSS[0] * factor, CROSS[1] * factor
    t = np.linalg.solve(np.column_stack([a[1] - a[0], b[0] - b[1]]), b[0] - a[0])[0]
    assert np.linalg.norm(junction(drawing) - (a[0] + t * (a[1] - a[0]))) < 0.06 * width + 0.1
