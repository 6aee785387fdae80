"""Walls and pockets cut from sheet get exact outlines, or lines where none is found."""

from __future__ import annotations

import pytest
from shapely import Polygon

from wrapit.geometry import Line, Loop, Region
from wrapit.geometry.outlines.loops import (
    rounded_rectangle,
)
from wrapit.geometry.outlines.offsets import offset_region
from wrapit.jig.sheet.inlays import moved_outline


def area(loop: Loop) -> float:
    return Polygon(loop.sampled(1e-5)).area


def test_where_no_exact_outline_is_found_lines_take_its_place() -> None:
    loop = rounded_rectangle(0, 0, 10, 4, 1)

    def fails(_: Region, __: float) -> tuple[Region, ...]:
        raise ValueError("no meeting")

    def wrong(region: Region, distance_mm: float) -> tuple[Region, ...]:
        return offset_region(region, 2 * distance_mm)

    def collapsed(_: Region, __: float) -> tuple[Region, ...]:
        there, back = (0.0, 0.0), (10.0, 0.0)
        return (Region(Loop((Line(there, back), Line(back, there)))),)

    true = moved_outline(loop, 0.1, offset_region)
    assert true is not None
    assert true.exact
    for offset in (fails, wrong, collapsed):
        plain = moved_outline(loop, 0.1, offset)
        assert plain is not None
        assert not plain.exact
        assert area(plain.loop) == pytest.approx(area(true.loop), abs=0.02)
    assert moved_outline(loop, -2.1, fails) is None
