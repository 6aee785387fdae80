"""Engraved numbers: open where a digit is open, closed where it is closed, in few sides."""

from __future__ import annotations

import pytest
import shapely

from wrapit.jig.printed.digits import number_polygon
from wrapit.jig.printed.labels import HEIGHTS_MM, STROKE_MM
from wrapit.jig.printed.smoothed import ENGRAVED_FIT_MM, ENGRAVED_SLACK_MM, smoothed

EYES = {0: 1, 1: 0, 2: 0, 3: 0, 4: 1, 5: 0, 6: 1, 7: 0, 8: 2, 9: 1}


@pytest.mark.parametrize("height_mm", HEIGHTS_MM)
@pytest.mark.parametrize("digit", EYES)
def test_each_digit_is_one_stroke_with_its_eyes_open(digit: int, height_mm: float) -> None:
    inked = number_polygon(digit, height_mm, STROKE_MM)
    assert inked.geom_type == "Polygon"
    assert len(inked.interiors) == EYES[digit]
    region = smoothed(inked, inked.buffer(0.2), ENGRAVED_FIT_MM, ENGRAVED_SLACK_MM)
    assert sum(len(loop.edges) for loop in (region.outer, *region.holes)) <= 14


@pytest.mark.parametrize("height_mm", HEIGHTS_MM)
def test_digits_of_a_number_stand_apart(height_mm: float) -> None:
    for number in (10, 38, 69, 88, 257):
        parts = shapely.get_parts(number_polygon(number, height_mm, STROKE_MM))
        assert len(parts) == len(str(number))
