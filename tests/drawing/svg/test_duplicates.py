"""Strokes drawn on each other: the same as by comparing all pairs, with far less work."""

from __future__ import annotations

from unittest import mock

import numpy as np
import pytest
from hypothesis import given

from tests.drawing.svg.curves import FEW, SEEDS, drawing, long_lines, short_strokes
from wrapit.drawing.svg import duplicates
from wrapit.drawing.svg.duplicates import without_coincident
from wrapit.drawing.svg.neighbours import Parallels
from wrapit.drawing.svg.planar import Curve


@FEW
@given(SEEDS)
def test_coincident_strokes_are_those_of_comparing_all_pairs(seed):
    rng = np.random.default_rng(seed)
    width = float(rng.choice([0.1, 1.0, 5.0]))
    curves = drawing(rng)
    for curve in [curves[k] for k in rng.integers(len(curves), size=3)]:
        # Copies beside the original, within reach or not, run the other way, or only a part.
        shifted = curve.cubics + rng.choice([0, 0.1, 0.28, 0.4]) * width
        curves.append(
            Curve(shifted, curve.closed) if rng.integers(2) else Curve(shifted[:2, ::-1][::-1], False)
        )
    found = without_coincident(curves, width)
    with mock.patch.object(Parallels, "beside", lambda self, _: self._polylines):
        plain = without_coincident(curves, width)
    assert [kept.closed for kept in found[0]] == [kept.closed for kept in plain[0]]
    assert all(np.array_equal(a.cubics, b.cubics) for a, b in zip(found[0], plain[0], strict=True))
    assert [length for _, length in found[1]] == [length for _, length in plain[1]]


@pytest.mark.parametrize(("drawn", "most"), [(short_strokes, 0), (long_lines, 400)])
def test_curves_that_do_not_lie_on_each_other_are_hardly_ever_compared(drawn, most, monkeypatch):
    compared = []
    spans = duplicates._spans
    monkeypatch.setattr(duplicates, "_spans", lambda *args: compared.append(1) or spans(*args))
    without_coincident(drawn(200), 0.5)
    # Of 19,900 pairs of the long lines, 5,000 cross; those at the most acute angles run on each other.
    assert len(compared) <= most


@pytest.mark.parametrize("width", [0.1, 1.5, 5.0])
@pytest.mark.parametrize("radius", [2.0, 4.0, 8.0])
@pytest.mark.parametrize("beyond", [2.5, 6.0])
def test_a_stroke_that_leaves_another_tangentially_does_so_where_they_part(radius, beyond, width):
    # A line to the right, and an arc of 60 degrees out of it that runs on it for some way, in widths.
    points = [np.linspace([-8, 0], [20, 0], 4)]
    arm = 4 / 3 * np.tan(np.radians(60) / 4) * radius
    turn = np.radians(60)
    end = radius * np.array([np.sin(turn), 1 - np.cos(turn)])
    arc = np.array([[0, 0], [arm, 0], end - arm * np.array([np.cos(turn), np.sin(turn)]), end])
    before = np.linspace([-beyond, 0], [0, 0], 4)
    drawn = [Curve(width * np.array(points), False), Curve(width * np.array([before, arc]), False)]
    kept, doubles = without_coincident(drawn, width)
    assert len(doubles) == 1
    # On such an arc the last of the touch is 0.003 off, after 0.08 w times the root of the radius.
    assert kept[-1].cubics[0, 0] == pytest.approx([0, 0], abs=0.1 * width * radius**0.5)
