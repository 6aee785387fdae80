"""Curvature is added as asked, lengths stay, and rigid motions are found again."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.geometry.shapes import Motion, motions, points, smooth_chains
from wrapit.geometry import Arc, BezierChain, from_chain, straight
from wrapit.geometry.arclength import ArcLength
from wrapit.geometry.outlines.loops import as_chain
from wrapit.geometry.recurving import best_fit, recurved


@settings(max_examples=30)
@given(st.floats(2, 30), st.floats(0.3, 5), st.floats(-0.05, 0.05))
def test_an_arc_becomes_the_arc_of_the_new_curvature(radius: float, sweep: float, change: float) -> None:
    spline = from_chain(as_chain(Arc((0.0, 0.0), radius, 0.0, sweep)))
    bent = recurved(spline, lambda k: np.full_like(k, change))
    wanted, length = 1 / radius + change, radius * sweep
    if abs(wanted) < 1e-3:
        return
    x = math.sin(wanted * length) / wanted
    y = (1 - math.cos(wanted * length)) / wanted
    # It starts at (radius, 0), upwards.
    assert np.allclose(bent.poles[-1], [radius - y, x], atol=2e-4)
    assert ArcLength(bent).total_mm == pytest.approx(length, rel=1e-5)


@settings(max_examples=25)
@given(smooth_chains())
def test_no_change_is_the_curve_itself(chain: BezierChain) -> None:
    spline = from_chain(chain)
    same = recurved(spline, np.zeros_like)
    share = np.linspace(0, 1, 40)
    a, b = (s.at(ArcLength(s).parameter(share * ArcLength(s).total_mm)) for s in (spline, same))
    assert np.abs(a - b).max() < 1e-6


def test_a_straight_wire_becomes_a_circle() -> None:
    bent = recurved(from_chain(straight((0, 0), (20 * math.pi, 0))), lambda k: k + 0.1)
    assert np.allclose(bent.poles[-1], [0, 0], atol=1e-3)


@given(st.lists(points, min_size=3, max_size=12, unique=True), motions)
def test_a_rigid_motion_is_found_again(cloud: list, motion: Motion) -> None:
    xy = np.array(cloud, float)
    fit = best_fit(xy, motion.of(xy))
    assert fit.apart_mm < 1e-6
    assert np.allclose(xy @ fit.matrix.T + fit.offset, motion.of(xy), atol=1e-6)
