"""Strokes in the colour of what they lie on erase; light lines on dark are lines."""

from __future__ import annotations

import pytest

from tests.drawing.svg.seen.test_covers import codes
from tests.drawing.svg.test_stage import STROKE, traced
from wrapit.errors import DrawingError

LINE = f'<path {STROKE} d="M10 20 H90"/>'
GROUND = '<rect width="100" height="100" fill="{}"/>'


def stroke(colour, d="M10 60 H90 V90"):
    return f'<path fill="none" stroke="{colour}" stroke-width="2" d="{d}"/>'


@pytest.mark.parametrize(
    ("body", "erasing"),
    [
        (LINE + stroke("white"), True),
        (LINE + stroke("#fdfdfd"), True),
        (LINE + stroke("red"), False),
        (stroke("#fff") + stroke("#eee", "M10 20H90"), False),
        (stroke("white"), False),
        (GROUND.format("#222") + stroke("white"), False),
        (GROUND.format("#222") + stroke("white") + stroke("#222", "M20 70H80"), True),
        (GROUND.format("navy") + stroke("white") + stroke("yellow", "M10 20H90"), False),
        (LINE + '<rect x="5" y="50" width="90" height="45" fill="#124"/>' + stroke("white"), False),
        (LINE + '<rect x="5" y="50" width="90" height="45" fill="#124"/>' + stroke("#124"), True),
        (GROUND.format("#fff") + LINE + stroke("url(#none) white"), True),
    ],
)
def test_a_stroke_erases_if_it_has_the_colour_behind_it(tmp_path, body, erasing):
    drawing, findings = traced(tmp_path, body, components="join")
    assert ("erasing" in codes(findings)) == erasing
    assert drawing.length_mm > 0


def test_the_background_of_the_page_counts(tmp_path):
    style = "<style>svg{background:#123}</style>"
    assert "erasing" not in codes(traced(tmp_path, style + stroke("white") + LINE)[1])
    assert "erasing" in codes(traced(tmp_path, style + stroke("white") + stroke("#123", "M20 70H80"))[1])


def test_all_in_the_colour_of_the_paper_is_refused(tmp_path):
    with pytest.raises(DrawingError, match="colour of what they lie on"):
        traced(tmp_path, GROUND.format("white") + stroke("white") + stroke("#fafafa", "M1 1H9") + "")


def test_a_halo_below_the_upper_strand_of_a_knot_leaves_a_crossing(tmp_path):
    under, over = "M10 50 H90", "M50 10 V90"
    halo = f'<path fill="none" stroke="white" stroke-width="8" d="{over}"/>'
    body = stroke("black", under) + halo + stroke("black", over)
    drawing, findings = traced(tmp_path, body)
    assert sorted(map(len, drawing.half_edges())) == [1, 1, 1, 1, 4]
    assert codes(findings) == ["erasing"]
    # Without the upper strand it is a gap.
    assert "hidden" in codes(traced(tmp_path, stroke("black", under) + halo, components="join")[1])
