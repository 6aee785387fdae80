"""What the SVG writers share: sizes of text, places on curves, escaped text."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.exports.pieces_for_tests import arc_chain
from tests.exports.svg_for_tests import root_of
from wrapit.exports.svgpage import ANCHOR_SHARES, MANY_LABELS, anchors, attributes, label_size_mm, page
from wrapit.geometry import joined, straight
from wrapit.geometry.svgframe import SvgFrame

FRAME = SvgFrame.around(np.zeros(2), np.array([40.0, 30.0]), 2.0)


@given(st.text(st.characters(exclude_categories=("Cs", "Cc")), max_size=30))
def test_any_text_is_read_back(said: str) -> None:
    root = root_of(page(FRAME, said, said, [f"<g {attributes(data_name=said)}/>"]))
    assert (root[0].text or "", root[1].text or "") == (said, said)
    assert root[-1].get("data-name") == said


@pytest.mark.parametrize("quickly", [False, True])
def test_anchors_lie_on_the_curve_the_middle_first(quickly: bool) -> None:
    chain = arc_chain((3.0, 4.0), 10.0, 0.0, math.pi)
    points = anchors(chain, quickly=quickly)
    assert points.shape == (len(ANCHOR_SHARES), 2)
    angles = np.arctan2(points[:, 1] - 4.0, points[:, 0] - 3.0) / math.pi
    assert angles == pytest.approx(np.array(ANCHOR_SHARES), abs=0.01)
    assert np.hypot(*(points - np.array([3.0, 4.0])).T) == pytest.approx(10.0, abs=0.02)


@given(st.floats(5, 1000), st.integers(1, 100_000))
def test_more_labels_are_never_larger_and_take_a_quarter_of_the_page(side_mm: float, labels: int) -> None:
    low, high = np.zeros(2), np.full(2, side_mm)
    curves = [straight((0.0, 0.0), (side_mm / 3, 0.0))]
    size_mm = label_size_mm(curves, low, high, labels)
    assert 0 < label_size_mm(curves, low, high, labels + 1) <= size_mm <= 3.0
    if labels > MANY_LABELS:
        assert labels * 0.6 * len(str(labels)) * size_mm**2 <= side_mm**2 / 4 * (1 + 1e-9)


def test_a_number_is_beside_the_share_of_its_curve() -> None:
    curve = joined([straight((0, 0), (30, 0)), straight((30, 0), (30, 10))])
    places = [(20, 0), (16, 0), (24, 0), (12, 0), (28, 0), (8, 0), (30, 2)]
    for quickly in (False, True):
        assert anchors(curve, quickly=quickly) == pytest.approx(np.array(places), abs=1e-6)
