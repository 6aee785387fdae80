"""What has a true size: parts that cover the whole and overlap, however large."""

from __future__ import annotations

import itertools

import pytest
from hypothesis import given
from hypothesis import strategies as st

from wrapit.instructions.model import Strip
from wrapit.instructions.print.sheets import OVERLAP_MM, TrueSize, parts_of, strip_parts
from wrapit.pages.model import Picture


@given(st.floats(1, 3000), st.floats(40, 300))
def test_parts_cover_the_whole_and_overlap(length_mm: float, room_mm: float) -> None:
    parts = parts_of(length_mm, room_mm)
    assert parts[0].low == 0
    assert parts[-1].high == pytest.approx(length_mm)
    assert [part.first for part in parts] == [True] + [False] * (len(parts) - 1)
    assert [part.last for part in parts] == [False] * (len(parts) - 1) + [True]
    for part in parts:
        assert 0 < part.high - part.low <= room_mm + 1e-9
    for before, after in itertools.pairwise(parts):
        assert before.high - after.low == pytest.approx(OVERLAP_MM)
    # No part shows nothing new.
    assert all(part.high - part.low > OVERLAP_MM for part in parts[1:])


@given(st.floats(20, 400), st.floats(20, 400))
def test_a_large_piece_is_parted_both_ways(width: float, height: float) -> None:
    sheet = TrueSize(Picture((-5.0, 3.0), (width - 5, height + 3), 2.0, ()), (186.0, 240.0))
    across = {(part[0].low, part[0].high) for part in sheet.parts}
    up = {(part[1].low, part[1].high) for part in sheet.parts}
    assert len(sheet.parts) == len(across) * len(up)
    assert max(high for _, high in across) == pytest.approx(width)
    assert max(high for _, high in up) == pytest.approx(height)
    # From the upper left, as one reads.
    assert sheet.parts[0][0].first
    assert sheet.parts[0][1].last


def test_rows_of_a_strip_say_which_they_are() -> None:
    parts = strip_parts(Strip(1, 400.0, ()), 186.0)
    assert [(part.part, part.count) for part in parts] == [(1, 3), (2, 3), (3, 3)]
    (alone,) = strip_parts(Strip(1, 100.0, ()), 186.0)
    assert (alone.part, alone.count) == (1, 1)
