"""Remedies are in the words of the program that made the file, where the file says which."""

from __future__ import annotations

import pytest

from tests.drawing.svg.test_stage import STROKE
from wrapit.config import TracingConfig
from wrapit.drawing.stage import trace
from wrapit.drawing.svg.programs import program_of
from wrapit.errors import DrawingError

INKSCAPE = 'xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"'
MADE_BY = {
    "Illustrator": ("<!-- Generator: Adobe Illustrator 27.5.0, SVG Export Plug-In -->", "", ""),
    "Inkscape": ("", INKSCAPE, ""),
    "Figma": ("", "", "<title>Created with Figma</title>"),
    "Canva": ("", 'zoomAndPan="magnify"', ""),
    "Excalidraw": ("", "", "<!-- svg-source:excalidraw -->"),
    "CorelDRAW": ("<!-- Creator: CorelDRAW 2020 -->", "", ""),
    "Affinity": ("", 'xmlns:serif="http://www.serif.com/"', ""),
    "Sketch": ("<!-- Generator: Sketch 52.5 (67469) - http://www.bohemiancoding.com/sketch -->", "", ""),
}


def traced(folder, program, body):
    before, attributes, inside = MADE_BY[program]
    path = folder / "drawing.svg"
    size = 'width="100" height="100"'
    path.write_text(
        f'{before}<svg xmlns="http://www.w3.org/2000/svg" {size} {attributes}>{inside}{body}</svg>'
    )
    return trace(path, TracingConfig(), 40.0)


@pytest.mark.parametrize("program", MADE_BY)
def test_filled_shapes_are_refused_in_the_words_of_each_program(tmp_path, program):
    with pytest.raises(DrawingError) as caught:
        traced(tmp_path, program, '<path d="M10 10H90V90Z"/>')
    assert caught.value.remedy.startswith(f"in {program} ")
    assert "tracing.filled" in caught.value.remedy
    assert caught.value.where.endswith("drawing.svg:1")


@pytest.mark.parametrize("program", ["Illustrator", "Inkscape", "Figma"])
@pytest.mark.parametrize(
    ("body", "code"),
    [
        (f'<path {STROKE} d="M10 10H300"/>', "clipped"),
        (f'<path {STROKE} d="M10 10H90"/><rect x="60" width="40" height="40" fill="white"/>', "hidden"),
        (f'<mask id="m"/><path mask="url(#m)" {STROKE} d="M10 10H90"/>', "masked"),
        (f'<path {STROKE} d="M10 10H90"/><path d="M10 30H90V90Z"/>', "filled-shapes"),
    ],
)
def test_findings_are_in_the_words_of_each_program(tmp_path, program, body, code):
    (finding,) = traced(tmp_path, program, body)[1]
    assert finding.code == code
    assert finding.remedy.startswith(f"in {program} ")
    assert "line 1" in finding.where


def test_a_canvas_is_not_canva():
    assert program_of(["drawn on a canvas"]) == ""
    assert program_of(["made with Canva"]) == "Canva"
