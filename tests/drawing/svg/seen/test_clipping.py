"""What is clipped away is no line, and is named."""

from __future__ import annotations

import math

import pytest

from tests.drawing.svg.test_stage import STROKE, traced

ROUND = '<clipPath id="c"><circle cx="50" cy="50" r="30"/></clipPath>'
LINE = f'<path {STROKE} d="M5 50 H95"/>'


@pytest.mark.parametrize(
    ("body", "length_mm"),
    [
        (f'{ROUND}<g clip-path="url(#c)">{LINE}</g>', 60),
        (f'{ROUND}<g clip-path="url(\'#c\')" transform="translate(0 10)">{LINE}</g>', 60),
        (f'<svg x="20" width="40" height="80">{LINE}</svg>', 35),
        (f'<svg x="5" width="40" height="80" overflow="visible">{LINE}</svg>', 90),
        (f'<path {STROKE} d="M50 50 H300"/>', 50),
        (
            '<clipPath id="h" clipPathUnits="objectBoundingBox"><rect width=".5" height="1"/></clipPath>'
            f'<rect clip-path="url(#h)" {STROKE} x="10" y="20" width="60" height="40"/>',
            100,
        ),
    ],
    ids=["circle", "moved", "viewport", "overflow", "page", "box"],
)
def test_only_what_is_seen_is_a_line(tmp_path, body, length_mm):
    drawing, findings = traced(tmp_path, body)
    # The cut lies where a quarter of the stroke is outside: half a mm farther at each end.
    assert drawing.length_mm == pytest.approx(length_mm, abs=1.1)
    assert ("clipped" in [finding.code for finding in findings]) == ("visible" not in body)


def test_a_clipped_circle_keeps_its_arc_in_one_piece(tmp_path):
    body = f'<svg x="30" width="70" height="100"><circle {STROKE} cx="0" cy="50" r="40"/></svg>'
    drawing, _ = traced(tmp_path, body)
    assert len(drawing.segments) == 1
    assert drawing.length_mm == pytest.approx(math.pi * 40, abs=1.1)


def test_all_clipped_away_is_refused_with_the_reason(tmp_path):
    with pytest.raises(Exception, match="outside of the page"):
        traced(tmp_path, f'<path {STROKE} d="M200 50 H300"/>')
