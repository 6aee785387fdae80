"""Path data: held against svgelements where it is in order, and drawn up to the first error where not."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from svgelements import Path as PeerPath

from wrapit.drawing.svg.reading.path_data import path_subpaths, polygon_subpaths
from wrapit.drawing.svg.reading.pen import Pen

VALUE = st.integers(-400, 400).map(lambda value: value / 8)
COUNTS = {"m": 2, "l": 2, "h": 1, "v": 1, "c": 6, "s": 4, "q": 4, "t": 2, "z": 0}


@st.composite
def commands(draw):
    name = draw(st.sampled_from([*COUNTS, "a"]))
    name = draw(st.sampled_from((name, name.upper())))
    if name in "aA":
        rx, ry = (draw(st.integers(1, 40)) for _ in range(2))
        flags = draw(st.sampled_from(("00", "01", "1 0", "1,1")))
        return f"{name}{rx} {ry} {draw(VALUE)} {flags}{draw(VALUE)} {draw(VALUE)}"
    return name + " ".join(str(draw(VALUE)) for _ in range(COUNTS[name.lower()]))


@settings(deadline=None)
@given(st.lists(commands(), min_size=1, max_size=12))
def test_data_in_order_are_read_as_svgelements_reads_them(parts):
    text = "M1 2" + "".join(parts)
    found, error, _ = path_subpaths(text, 1000)
    assert error is None
    ends = [cubic[3] for subpath in found for cubic in subpath.cubics]
    peer = [
        p.end for p in PeerPath(text) if type(p).__name__ != "Move" and p.end is not None and p.start != p.end
    ]
    # svgelements leaves out where an arc is divided; each of its ends is one of ours.
    for point in peer:
        assert min(math.hypot(x - point.x, y - point.y) for x, y in ends) < 1e-6


@pytest.mark.parametrize(
    ("text", "ends", "begins"),
    [
        ("M0 0L10 0L5", [(10, 0)], "L5"),
        ("M0 0L10 0 20", [(10, 0)], "20"),
        ("M0 0L10 0#L3 3", [(10, 0)], "#L3"),
        ("M0 0H10a1 1 0 2 0 3 3", [(10, 0)], "a1"),
        ("L10 0", [], "L10"),
        ("M0 0L1 1,", [(1, 1)], ","),
        ("M0 0 e5", [], "e5"),
    ],
)
def test_an_error_ends_the_path_and_is_known(text, ends, begins):
    found, error, _ = path_subpaths(text, 1000)
    assert [tuple(cubic[3]) for subpath in found for cubic in subpath.cubics] == ends
    assert error is not None
    assert text[error:].strip().startswith(begins)


@pytest.mark.parametrize(
    ("smooth", "plain"),
    [
        ("M0 0S5 5 9 0", "M0 0C0 0 5 5 9 0"),
        ("M0 0C1 1 2 3 4 4s1 1 2 0", "M0 0C1 1 2 3 4 4C6 5 5 5 6 4"),
        ("M0 0Q1 3 4 4T9 9", "M0 0Q1 3 4 4Q7 5 9 9"),
        ("M0 0T4 4s1 1 2 0", "M0 0Q0 0 4 4C4 4 5 5 6 4"),
        ("M0 0h5v5zl1 1", "M0 0L5 0L5 5ZM0 0L1 1"),
        ("m1 1 2 2 3 3", "M1 1L3 3L6 6"),
        ("M0 0 5 5.5.5-3", "M0 0L5 5.5L.5 -3"),
        ("M1 1a0 5 0 0 1 4 4", "M1 1L5 5"),
    ],
)
def test_short_forms_are_their_long_forms(smooth, plain):
    one, other = (path_subpaths(text, 1000)[0] for text in (smooth, plain))
    assert len(one) == len(other)
    for left, right in zip(one, other, strict=True):
        assert np.allclose(left.cubics[..., 3, :], right.cubics[..., 3, :], atol=1e-12)
        assert left.closed == right.closed
        if "L" not in plain:
            assert np.allclose(left.cubics, right.cubics, atol=1e-12)


def test_arcs_err_less_than_a_millionth_of_their_radius():
    pen = Pen()
    pen.move((1.0, 0.0))
    pen.arc(1.0, 1.0, 0.0, True, True, (0.0, -1.0))
    (subpath,) = pen.subpaths()
    t = np.linspace(0, 1, 200)[:, None, None]
    a, b, c, d = np.moveaxis(subpath.cubics, 1, 0)
    on = (1 - t) ** 3 * a + 3 * (1 - t) ** 2 * t * b + 3 * (1 - t) * t * t * c + t**3 * d
    assert np.abs(np.linalg.norm(on, axis=-1) - 1).max() < 1e-6


def test_points_end_where_no_number_is():
    found, error, _ = polygon_subpaths("0,0 10 0 10 10 5", True, 1000)
    assert [tuple(cubic[3]) for cubic in found[0].cubics] == [(10, 0), (10, 10), (0, 0)]
    assert error is None
    found, error, _ = polygon_subpaths("0 0 10 0 x 5 5", False, 1000)
    assert len(found[0].cubics) == 1
    assert error == 9
