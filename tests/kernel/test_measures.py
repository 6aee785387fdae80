"""Measures of solids whose volume and size are known."""

from __future__ import annotations

import math

import pytest

from tests.kernel.test_terraces import disc
from wrapit.kernel.measures import count_solids, size_mm, volume_mm3
from wrapit.kernel.terraces import terraced_solid


def test_volume_of_a_prism() -> None:
    made = terraced_solid(disc(0, 0, 5), 0.0, 4.0, [], [], "coin")
    assert volume_mm3(made.solid) == pytest.approx(100 * math.pi, rel=1e-9)
    assert size_mm(made.solid) == pytest.approx((10.0, 10.0, 4.0), abs=1e-6)
    assert count_solids(made.solid) == 1
