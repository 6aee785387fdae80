"""A refusal of a drawing: prompt, in words, with a remedy."""

from __future__ import annotations

import time
from pathlib import Path

import pytest

from wrapit.config import TracingConfig
from wrapit.drawing.stage import trace
from wrapit.errors import DrawingError

PATIENCE_S = 15.0


def refusal(path: Path) -> str:
    begin = time.process_time()
    with pytest.raises(DrawingError) as caught:
        trace(path, TracingConfig(), 40.0)
    assert time.process_time() - begin < PATIENCE_S
    assert caught.value.remedy
    assert "()" not in str(caught.value)
    return str(caught.value)
