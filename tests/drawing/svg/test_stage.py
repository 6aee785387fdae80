"""SVG strokes become exact curves; what isn't safe or has no lines is refused."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from tests.drawing.generated import degrees
from wrapit.config import TracingConfig
from wrapit.drawing.model import Drawing
from wrapit.drawing.stage import trace
from wrapit.errors import DrawingError, Finding

STROKE = 'fill="none" stroke="black" stroke-width="2"'


def traced(
    folder: Path, body: str, size_mm: float | None = None, head: str = "", **tracing: object
) -> tuple[Drawing, tuple[Finding, ...]]:
    path = folder / "drawing.svg"
    attributes = 'xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'
    size = 'width="100mm" height="100mm" viewBox="0 0 100 100"'
    path.write_text(f"{head}<svg {attributes} {size}>{body}</svg>")
    return trace(path, TracingConfig(**tracing), size_mm)


def test_two_lines_cross_exactly(tmp_path):
    drawing, _ = traced(tmp_path, f'<path {STROKE} d="M10 10 L90 90 M10 50 L90 30"/>')
    assert degrees(drawing) == [1, 1, 1, 1, 4]
    (crossing,) = (j for j, ends in enumerate(drawing.half_edges()) if len(ends) == 4)
    # The lines meet at x = y = 42; the box starts at x = 10 and ends below at y = 90.
    assert drawing.junctions[crossing].point == pytest.approx([32, 48], abs=1e-9)
    assert all(len(segment.curve) == 1 for segment in drawing.segments)


def test_size_comes_from_the_file_or_the_config(tmp_path):
    body = f'<path {STROKE} d="M10 10 H 60 V 30"/>'
    own, _ = traced(tmp_path, body)
    assert own.bounds_mm[1] == pytest.approx([50, 20], abs=1e-9)
    assert own.stroke_width_mm == pytest.approx(2)
    assert own.pixel_frame is None
    asked, _ = traced(tmp_path, body, 30.0)
    assert asked.bounds_mm[1] == pytest.approx([30, 12], abs=1e-9)


def test_transforms_and_groups_apply(tmp_path):
    path = f'<path {STROKE} d="M5 -5 H 25"/>'
    body = f'<g transform="translate(10 0) scale(2)"><g transform="rotate(90)">{path}</g></g>'
    drawing, _ = traced(tmp_path, body)
    assert drawing.bounds_mm[1] == pytest.approx([0, 40], abs=1e-9)
    assert drawing.stroke_width_mm == pytest.approx(4)


def test_a_circle_is_one_closed_segment_of_true_length(tmp_path):
    drawing, _ = traced(tmp_path, f'<circle {STROKE} cx="50" cy="50" r="30"/>')
    assert degrees(drawing) == [2]
    assert drawing.length_mm == pytest.approx(2 * math.pi * 30, rel=2e-4)


def test_arcs_quadratics_and_smooth_commands(tmp_path):
    body = f'<path {STROKE} d="M10 50 A 20 20 0 0 1 50 50 Q 60 70 70 50 T 90 50"/>'
    drawing, _ = traced(tmp_path, body)
    assert degrees(drawing) == [1, 1, 2] or degrees(drawing) == [1, 1]
    arc = math.pi * 20
    assert drawing.length_mm == pytest.approx(arc + 2 * 29.58, rel=0.01)


def test_a_circle_and_a_chord_make_two_junctions_and_three_arcs(tmp_path):
    body = f'<circle {STROKE} cx="50" cy="50" r="30"/><line {STROKE} x1="10" y1="50" x2="90" y2="50"/>'
    drawing, _ = traced(tmp_path, body)
    assert degrees(drawing) == [1, 1, 4, 4]
    assert len(drawing.segments) == 5


def test_an_end_on_a_stroke_is_a_t_even_when_it_falls_short(tmp_path):
    for end in (50, 49.2, 50.9):
        body = f'<path {STROKE} d="M10 50 H 90"/><path {STROKE} d="M40 10 V {end}"/>'
        drawing, _ = traced(tmp_path, body)
        assert degrees(drawing) == [1, 1, 1, 3], end


def test_corners_are_vertices_when_sharp(tmp_path):
    for turn, expected in ((75, [1, 1, 2]), (45, [1, 1])):
        x, y = 50 + 30 * math.cos(math.radians(turn)), 50 + 30 * math.sin(math.radians(turn))
        drawing, _ = traced(tmp_path, f'<polyline {STROKE} points="10,50 50,50 {x},{y}"/>')
        assert degrees(drawing) == expected


def test_a_stroke_drawn_twice_counts_once(tmp_path):
    body = f'<path {STROKE} d="M10 10 C 30 60 60 60 90 10"/><path {STROKE} d="M90 10 C 60 60 30 60 10 10"/>'
    drawing, _ = traced(tmp_path, body)
    assert degrees(drawing) == [1, 1]


def test_a_curve_crosses_itself(tmp_path):
    drawing, _ = traced(tmp_path, f'<path {STROKE} d="M10 80 C 120 10 -20 10 90 80"/>')
    assert degrees(drawing) == [1, 1, 4]


def test_hidden_and_white_things_are_no_lines(tmp_path):
    body = (
        '<rect width="100" height="100" fill="white"/>'
        f'<g display="none"><path {STROKE} d="M0 0 L 99 99"/></g>'
        f'<path {STROKE} visibility="hidden" d="M0 0 L 99 99"/>'
        f'<path {STROKE} d="M10 20 H 90"/>'
    )
    assert degrees(traced(tmp_path, body)[0]) == [1, 1]


def test_pieces_apart_are_named_or_joined(tmp_path):
    body = f'<path {STROKE} d="M10 20 H 90 M 30 30 H 50"/>'
    drawing, findings = traced(tmp_path, body)
    assert degrees(drawing) == [1, 1]
    (finding,) = findings
    assert finding.code == "left-out"
    assert "mm" in finding.where
    joined, _ = traced(tmp_path, body, components="join")
    assert len(joined.segments) == 4 or len(joined.segments) == 5


def test_filled_shapes_are_refused_with_a_remedy_or_outlined(tmp_path):
    body = '<path d="M10 10 H 90 V 60 H 10 Z"/>'
    with pytest.raises(DrawingError, match=r"filled.*tracing\.filled"):
        traced(tmp_path, body)
    outlined, _ = traced(tmp_path, body, filled="outline")
    assert degrees(outlined) == [2, 2, 2, 2]
    assert outlined.length_mm == pytest.approx(260)


@pytest.mark.parametrize(
    ("body", "head", "reason"),
    [
        ("", "", "no stroked lines"),
        ('<path d="M10 10 L nan 20" stroke="black"/>', "", "nan"),
        ('<path stroke="black" d="M10 10 L 1e999 20"/>', "", "finite|nan|inf"),
        ("<text>&x;</text>", '<!DOCTYPE svg [<!ENTITY x "boo">]>', "text and no lines"),
        ("", '<!DOCTYPE svg [<!ENTITY x SYSTEM "file:///etc/passwd">]>', "entities"),
        ('<image href="http://example.com/a.png"/>', "", "another file"),
        ('<use xlink:href="other.svg#a"/>', "", "another file"),
        ('<style>@import url("http://example.com/a.css");</style>', "", "no stroked lines"),
        ('<path stroke="black" d="M0 0 L9 9"/', "", "XML"),
    ],
)
def test_unsafe_or_broken_files_are_refused(body, head, reason, tmp_path):
    with pytest.raises(DrawingError, match=reason):
        traced(tmp_path, body, head=head)


def test_a_link_in_the_file_is_harmless(tmp_path):
    body = f'<a href="http://example.com"><path {STROKE} d="M10 20 H 90"/></a>'
    assert degrees(traced(tmp_path, body)[0]) == [1, 1]


def test_random_chords_of_a_circle_cross_where_geometry_says(tmp_path):
    rng = np.random.default_rng(8)
    angles = rng.permutation(np.linspace(0, 2 * np.pi, 12, endpoint=False) + rng.uniform(-0.1, 0.1, 12))
    ends = 50 + 40 * np.column_stack([np.cos(angles), np.sin(angles)])
    chords = ends.reshape(6, 2, 2)
    body = "".join(f'<path {STROKE} d="M{a[0]} {a[1]} L{b[0]} {b[1]}"/>' for a, b in chords)
    body = body.replace('stroke-width="2"', 'stroke-width="0.2"')
    drawing, _ = traced(tmp_path, body)
    pairs = angles.reshape(6, 2)
    crossing = 0
    for i in range(6):
        low, high = sorted(pairs[i] % (2 * np.pi))
        for j in range(i + 1, 6):
            inside = [(low < other % (2 * np.pi) < high) for other in pairs[j]]
            crossing += inside[0] != inside[1]
    assert degrees(drawing).count(4) == crossing


RECTANGLE = f'<rect {STROKE} x="10" y="10" width="30" height="60"/>'


@pytest.mark.parametrize(
    ("body", "expected", "length_mm"),
    [
        (RECTANGLE + f'<rect {STROKE} x="40" y="10" width="30" height="60"/>', [2, 2, 2, 2, 3, 3], 300),
        (RECTANGLE + f'<rect {STROKE} x="40" y="20" width="30" height="30"/>', [2] * 6 + [3, 3], 270),
        (f'<rect {STROKE} x="40" y="20" width="30" height="30"/>' + RECTANGLE, [2] * 6 + [3, 3], 270),
        (f'<path {STROKE} d="M10 10 H60"/><path {STROKE} d="M90 10 H40"/>', [1, 1], 80),
        (2 * f'<circle {STROKE} cx="50" cy="50" r="30"/>', [2], 2 * math.pi * 30),
    ],
    ids=["whole edge", "part of an edge", "part first", "overlapping lines", "the same twice"],
)
def test_what_is_drawn_twice_counts_once_and_is_named(tmp_path, body, expected, length_mm):
    drawing, findings = traced(tmp_path, body)
    assert degrees(drawing) == expected
    assert drawing.length_mm == pytest.approx(length_mm, rel=1e-3)
    assert [finding.code for finding in findings] == ["drawn-twice"]
    assert {removal.what for removal in drawing.removed} == {"double"}


@pytest.mark.parametrize("rise", [4.2, 7.0, 20.0])
def test_strokes_that_cross_at_an_acute_angle_are_not_drawn_twice(tmp_path, rise):
    body = f'<path {STROKE} d="M10 50 H90"/><path {STROKE} d="M10 {50 - rise / 2} L90 {50 + rise / 2}"/>'
    drawing, findings = traced(tmp_path, body)
    assert degrees(drawing) == [1, 1, 1, 1, 4]
    assert findings == ()


def test_a_stroke_drawn_in_parts_is_one_segment(tmp_path):
    drawing, _ = traced(tmp_path, f'<path {STROKE} d="M10 50 H50"/><path {STROKE} d="M90 50 H50"/>')
    assert degrees(drawing) == [1, 1]
    bent, _ = traced(tmp_path, f'<path {STROKE} d="M10 50 H50"/><path {STROKE} d="M50 90 V50"/>')
    assert degrees(bent) == [1, 1, 2]
