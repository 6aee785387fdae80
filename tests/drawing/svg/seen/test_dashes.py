"""Dashed lines are read whole and said so; one dash is what is seen; dots have no length; masks are named."""

from __future__ import annotations

import math

import pytest

from tests.drawing.svg.seen.test_covers import codes
from tests.drawing.svg.test_stage import STROKE, traced
from wrapit.errors import DrawingError

FRAME = f'<path {STROKE} d="M10 10 H90 V90 H10 Z"/>'


def dashed(dashes, more="", d="M10 50 H90"):
    return f'<path fill="none" stroke="black" stroke-width="2" stroke-dasharray="{dashes}" {more} d="{d}"/>'


@pytest.mark.parametrize(
    ("line", "length_mm", "code"),
    [
        (dashed("4 4"), 80, "dashed"),
        (dashed("30 20"), 80, "dashed"),
        (dashed("5%, 3%"), 80, "dashed"),
        (dashed("0 6", 'stroke-linecap="round"'), 80, "dashed"),
        (dashed("4 1.5", 'stroke-linecap="round"'), 80, None),
        (dashed("4 0"), 80, None),
        (dashed("4 -1"), 80, None),
        (dashed("none"), 80, None),
        (dashed("200 200"), 80, None),
        (dashed("80 80", 'stroke-dashoffset="80"'), 0, "undrawn"),
        (dashed("1000", 'stroke-dashoffset="1000"'), 0, "undrawn"),
        (dashed("0 6"), 0, "undrawn"),
        (dashed("30 1000"), 30, "undrawn"),
        (dashed("80", 'stroke-dashoffset="50"'), 30, "undrawn"),
        (dashed("80", 'stroke-dashoffset="-50"'), 30, "undrawn"),
        (dashed(".5 2", 'pathLength="1"'), 40, "undrawn"),
        (dashed("100", 'pathLength="100" stroke-dashoffset="100"'), 0, "undrawn"),
    ],
)
def test_dashes(tmp_path, line, length_mm, code):
    drawing, findings = traced(tmp_path, FRAME + line, components="join")
    assert drawing.length_mm == pytest.approx(320 + length_mm, abs=0.05)
    assert codes(findings) == ([code] if code else [])


def test_a_dash_over_the_beginning_of_a_circle_is_one_line(tmp_path):
    # Three quarters of the circle, from an eighth before its beginning on.
    whole = math.tau * 30
    dashes = f'stroke-dasharray="{0.75 * whole} {whole / 4}" stroke-dashoffset="{whole / 8}"'
    drawing, findings = traced(tmp_path, f'<circle {STROKE} {dashes} cx="50" cy="50" r="30"/>')
    assert len(drawing.segments) == 1
    assert drawing.length_mm == pytest.approx(0.75 * whole, rel=1e-3)
    assert codes(findings) == ["undrawn"]


def test_lines_before_their_animation_are_refused_with_the_reason(tmp_path):
    with pytest.raises(DrawingError, match=r"no dash on them.*stroke-dasharray"):
        traced(tmp_path, dashed("100 100", 'stroke-dashoffset="100"'))


@pytest.mark.parametrize("dot", ["h0", "h.01", "h.1v.05", "h.008v.008h-.008V30Z", "z", "c.1 .1 .1 0 0 0"])
@pytest.mark.parametrize("cap", ["round", "square"])
def test_strokes_of_nearly_no_length_are_dots(tmp_path, dot, cap):
    body = f'<g stroke-linecap="{cap}">{FRAME}<path {STROKE} d="M30 30{dot}"/></g>'
    drawing, findings = traced(tmp_path, body)
    assert codes(findings) == ["dots"]
    # 30 mm at 96 px to the inch.
    assert "at (113." in findings[0].where
    assert drawing.length_mm == pytest.approx(320)


def test_a_short_line_is_no_dot(tmp_path):
    assert codes(traced(tmp_path, FRAME + f'<path {STROKE} d="M30 30h1"/>')[1]) == ["left-out"]


def test_a_mask_is_named(tmp_path):
    mask = '<mask id="veil"><rect width="50" height="100" fill="white"/></mask>'
    line = f'<g mask="url(#veil)"><path {STROKE} d="M10 50 H90"/></g>'
    _, findings = traced(tmp_path, mask + FRAME + "\n" + line)
    assert codes(findings) == ["masked"]
    assert "'veil'" in findings[0].message
    assert "line 2" in findings[0].where
