"""Lines under later ink are not seen: they are left out as far as they are hidden, and named."""

from __future__ import annotations

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tests.drawing.svg.test_stage import STROKE, traced
from wrapit.drawing.svg.seen import covers
from wrapit.drawing.svg.seen.parting import parted
from wrapit.errors import DrawingError

LINE = f'<path {STROKE} d="M10 50 H90"/>'
FRAME = f'<path {STROKE} d="M10 10 H90 V90 H10 Z"/>'
JOIN = "join"


def codes(findings):
    return [finding.code for finding in findings]


def hidden_mm(tmp_path, body, **tracing):
    """The length that the finding `hidden` tells, and the drawing."""
    drawing, findings = traced(tmp_path, body, components=JOIN, **tracing)
    told = [finding for finding in findings if finding.code == "hidden"]
    assert all(finding.remedy and "px" in finding.where for finding in told)
    return sum(finding.severity for finding in told), drawing


@pytest.mark.parametrize(
    ("over", "length_mm"),
    [
        ('<rect x="40" y="40" width="20" height="20" fill="white"/>', 19),
        ('<rect x="40" y="40" width="20" height="20" fill="#fdfdf8"/>', 19),
        ('<circle cx="50" cy="50" r="15" fill="black"/>', 29),
        ('<circle cx="50" cy="50" r="15" fill="red"/>', 29),
        ('<path stroke="white" stroke-width="10" d="M50 40 V60"/>', 9),
        ('<g transform="scale(2)"><path stroke="#fff" stroke-width="10" d="M25 20 V30"/></g>', 19),
        ('<rect x="40" y="40" width="20" height="20" fill="white" opacity=".5"/>', 0),
        ('<rect x="40" y="40" width="20" height="20" fill="none"/>', 0),
        ('<circle cx="50" cy="50" r="3" fill="black"/>', 0),
        ('<path stroke="white" stroke-width="10" stroke-dasharray="1" d="M50 40 V60"/>', 0),
        ('<rect x="10" y="51" width="80" height="30" fill="white"/>', 0),
        ('<path stroke="red" stroke-width="6" d="M50 10 V90"/>', 0),
        (
            '<clipPath id="c"><rect x="40" y="0" width="10" height="99"/></clipPath>'
            '<rect clip-path="url(#c)" x="40" y="40" width="20" height="20" fill="white"/>',
            9,
        ),
    ],
)
def test_what_later_ink_hides_is_left_out_with_its_length(tmp_path, over, length_mm):
    told, _ = hidden_mm(tmp_path, FRAME + LINE + over)
    # A line counts as seen while a quarter of it shows: half a mm at each side.
    assert told == pytest.approx(length_mm, abs=0.2)
    # Below the line it hides nothing.
    assert hidden_mm(tmp_path, over + FRAME + LINE)[0] == 0


@settings(max_examples=25, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    x=st.floats(22, 60),
    wide=st.floats(11, 25),  # over four widths, also where an ellipse hides less than it is wide
    colour=st.sampled_from(["white", "black", "#c33", "ivory"]),
    turn=st.floats(-20, 20),
    shape=st.sampled_from(["rect", "ellipse", "stroke"]),
)
def test_what_is_seen_and_what_is_hidden_are_the_whole(tmp_path, x, wide, colour, turn, shape):
    body = {
        "rect": f'<rect x="{x}" y="40" width="{wide}" height="20" fill="{colour}"/>',
        "ellipse": f'<ellipse cx="{x + wide / 2}" cy="50" rx="{wide / 2}" ry="9" fill="{colour}"/>',
        "stroke": f'<path stroke="white" stroke-width="{wide}" d="M{x + wide / 2} 40V60"/>',
    }[shape]
    centre = f"{x + wide / 2} 50"
    told, drawing = hidden_mm(tmp_path, f'{FRAME}{LINE}<g transform="rotate({turn} {centre})">{body}</g>')
    drawn = drawing.length_mm - sum(change.length_mm for change in drawing.removed if change.what == "link")
    assert told > wide - 3
    assert told + drawn == pytest.approx(400, abs=0.05)


def test_a_line_that_is_hidden_altogether_is_refused_or_left_out(tmp_path):
    white = '<rect x="1" y="1" width="98" height="98" fill="white"/>'
    with pytest.raises(DrawingError, match="hidden under other ink"):
        traced(tmp_path, LINE + white)
    small = f'<path {STROKE} d="M48 50 H52"/><path stroke="red" stroke-width="9" d="M50 10V90"/>'
    drawing, findings = traced(tmp_path, small)
    assert codes(findings) == ["hidden"]
    assert len(drawing.segments) == 1


def test_a_circle_with_a_white_inside_ends_the_lines_that_come_to_it(tmp_path):
    body = LINE + '<circle cx="50" cy="50" r="15" fill="white" stroke="black" stroke-width="2"/>'
    drawing, findings = traced(tmp_path, body)
    assert codes(findings) == ["hidden"]
    assert sorted(map(len, drawing.half_edges())) == [1, 1, 3, 3]


def test_lines_are_compared_with_what_lies_over_them_only(tmp_path, monkeypatch):
    compared = []
    monkeypatch.setattr(covers, "parted", lambda *said: compared.append(said) or parted(*said))
    count = 300
    body = "".join(
        f'<path {STROKE.replace("2", ".1")} d="M{k % 100} {k // 100} h1"/>'
        f'<path d="M{k % 100} {k // 100 - 0.4}h.8v.8" fill="white"/>'
        for k in range(count)
    )
    _, findings = traced(tmp_path, body)
    assert "hidden" in codes(findings)
    # Each line lies under its own cover and touches the box of its neighbour's; all pairs are 90,000.
    assert len(compared) <= 3 * count
