"""Fixtures for all kinds of drawings: strokes as ink, traced or to be saved as any kind of picture."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from tests.drawing.bitmap.crosses import CROSS, SHAPE
from tests.drawing.bitmap.figures import SIZE_PX
from tests.drawing.generated import Points, render
from wrapit.config import TracingConfig
from wrapit.drawing.model import Drawing
from wrapit.drawing.stage import trace
from wrapit.errors import Finding


@pytest.fixture
def traced(tmp_path: Path) -> Callable[..., tuple[Drawing, tuple[Finding, ...]]]:
    def run(
        curves: list[Points], width_px: float, tracing: TracingConfig | None = None
    ) -> tuple[Drawing, tuple[Finding, ...]]:
        path = tmp_path / "drawing.png"
        Image.fromarray(render(curves, width_px, (SIZE_PX, SIZE_PX))).save(path)
        return trace(path, tracing or TracingConfig(), 50.0)

    return run


@pytest.fixture(scope="session")
def ink() -> np.ndarray:
    """Two crossing strokes as grey levels (h, w)."""
    return render(CROSS, 9.0, SHAPE)
