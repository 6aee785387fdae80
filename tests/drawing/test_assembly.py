"""From pixels to mm: size, place and numbers."""

from __future__ import annotations

import itertools

import pytest

from tests.drawing.bitmap.figures import ACROSS, line, turned


def test_size_is_the_longest_side_and_the_lower_left_is_zero(traced):
    drawing, _ = traced([line((60, 100), (360, 100), (360, 220))], 10.0)
    low, high = drawing.bounds_mm
    assert low == pytest.approx([0, 0], abs=0.01)
    assert high == pytest.approx([50, 20], abs=0.15)
    assert drawing.stroke_width_mm == pytest.approx(10 * 50 / 300, rel=0.08)


def test_junctions_are_numbered_from_top_to_bottom(traced):
    drawing, _ = traced([ACROSS, turned(ACROSS, 1.1)], 10.0)
    heights = [junction.point[1] for junction in drawing.junctions]
    assert all(upper > lower - 2e-3 for upper, lower in itertools.pairwise(heights))
    assert all(segment.start <= segment.end for segment in drawing.segments)
