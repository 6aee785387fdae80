"""What is drawn on a page comes back from its path data, at true size with y turned round."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from svgelements import Path

from tests.geometry.shapes import points, tame_chains
from wrapit.geometry import Arc, BezierChain, Line, Region
from wrapit.geometry.outlines.loops import circle, rounded_rectangle
from wrapit.geometry.svgframe import SvgFrame, number

FRAME = SvgFrame.around(np.array([-30.0, -40.0]), np.array([50.0, 60.0]), 2.0)


def back(path: Path, shares: np.ndarray) -> np.ndarray:
    """Points at shares of each of a path's drawn parts, in the drawing's own coordinates."""
    parts = [part for part in path if type(part).__name__ not in ("Move", "Close")]
    found = [part.point(float(share)) for part in parts for share in shares]
    return np.array([(p.x + FRAME.left, FRAME.top - p.y) for p in found])


@settings(max_examples=30)
@given(tame_chains())
def test_curves_come_back(chain: BezierChain) -> None:
    from wrapit.geometry.bezier import evaluate

    t = np.linspace(0, 1, 5)
    assert np.allclose(
        back(Path(FRAME.path(chain)), t), evaluate(chain.points, t).reshape(-1, 2), atol=1.1e-4
    )


@settings(max_examples=30)
@given(points, st.floats(0.5, 20), st.floats(-6, 6), st.floats(0.05, math.tau))
def test_arcs_come_back(centre: tuple, radius: float, start: float, sweep: float) -> None:
    for turn in (sweep, -sweep):
        arc = Arc(centre, radius, start, turn)
        found = back(Path(FRAME.edges((arc,))), np.linspace(0, 1, 5))
        assert np.allclose(np.hypot(*(found - centre).T), radius, atol=1e-3)
        assert np.allclose(found[0], arc.start, atol=1e-4)
        assert np.allclose(found[-1], arc.end, atol=1e-4)


def test_a_region_is_filled_with_its_holes_left_out() -> None:
    region = Region(rounded_rectangle(0, 0, 20, 10, 2), (circle((5, 5), 2),))
    path = Path(FRAME.region(region))
    assert FRAME.region(region).count("Z") == 2
    low_x, low_y, high_x, high_y = path.bbox()
    assert (high_x - low_x, high_y - low_y) == pytest.approx((20, 10), abs=1e-3)


def test_the_page_holds_the_margin_and_what_is_below() -> None:
    frame = SvgFrame.around(np.array([0.0, 0.0]), np.array([10.0, 20.0]), 1.5, 4.0)
    assert frame.view_box == "0 0 13 27"
    assert frame.size == 'width="13mm" height="27mm"'
    assert frame.at((0.0, 20.0)) == (1.5, 1.5)
    assert frame.edges((Line((0, 0), (10, 0)),)) == "M1.5,21.5L11.5,21.5"


@given(st.floats(-1e6, 1e6))
def test_numbers_are_short_and_near(value: float) -> None:
    text = number(value)
    assert abs(float(text) - value) <= 5.1e-5
    assert not text.endswith(".")
    assert text != "-0"
