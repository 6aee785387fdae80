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
