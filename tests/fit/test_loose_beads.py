"""Dots and rings that touch nothing become beads beside a wire, where one is near enough."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from wrapit.config import Config
from wrapit.drawing.model import Dot
from wrapit.fit.beading.bead_places import beads_of
from wrapit.fit.beading.beads import LARGEST_MM, SMALLEST_MM
from wrapit.fit.beading.loose_beads import REACH_MM, loose_beads
from wrapit.fit.limits import limits_of
from wrapit.fit.model import Bead
from wrapit.fit.sketch import Line, Sketch
from wrapit.geometry import straight

LIMITS = limits_of(Config(drawing="x"), "gentle")
RADIUS_MM = LIMITS.diameter_mm / 2
ENDS = np.array([[-40.0, 0.0], [40.0, 0.0]])
LINE = Sketch({0: ENDS[0], 1: ENDS[1]}, {0: Line(0, 1, straight(*ENDS), frozenset((0,)))})


@settings(max_examples=100, deadline=None)
@given(st.floats(0.5, 14), st.floats(-2, 4), st.floats(-30, 30))
def test_a_bead_is_clear_of_the_wire_and_within_reach_of_it(size: float, gap: float, x: float) -> None:
    """`gap` is between the drawn dot and the wire's metal."""
    dot = Dot((x, RADIUS_MM + gap + size / 2), size)
    beads, told, said = loose_beads([dot], LINE, (), LIMITS)
    for bead in beads:
        between_mm = dot.at[1] - RADIUS_MM - bead.diameter_mm / 2
        assert 0.25 - 1e-6 <= between_mm <= REACH_MM + 1e-6
        assert SMALLEST_MM <= bead.diameter_mm <= LARGEST_MM
        assert -1.25 - 1e-6 <= bead.diameter_mm - size <= 0.25 + 1e-6
        assert bead.diameter_mm % 0.5 == 0
        assert bead.segment is None
    if SMALLEST_MM <= size <= LARGEST_MM:
        assert len(beads) + len(said) == 1, "it is a bead, or it is said why not"
        assert len(told) == len(beads)
        if 0.5 <= gap <= 0.75:
            assert beads
    elif not SMALLEST_MM - 0.3 < size < LARGEST_MM + 0.3:
        assert not beads
        assert not said


@settings(max_examples=60, deadline=None)
@given(st.floats(1.8, 10.2), st.floats(0, 1.2), st.floats(-0.05, 0.05), st.floats(8, 30))
def test_twins_get_twin_beads(size: float, gap: float, more: float, x: float) -> None:
    left = Dot((-x, RADIUS_MM + gap + size / 2), size)
    right = Dot((x, left.at[1] + more), size + more)
    beads, _, said = loose_beads([left, right], LINE, (), LIMITS)
    assert (len(beads), len(said)) in ((2, 0), (0, 2), (0, 0))
    assert len({bead.diameter_mm for bead in beads}) <= 1


def test_a_pupil_in_its_iris_is_one_bead_and_neighbours_are_told() -> None:
    iris = Dot((0, RADIUS_MM + 0.5 + 2.5), 5)
    beads, _, said = loose_beads([Dot(iris.at, 2), iris], LINE, (), LIMITS)
    assert [bead.diameter_mm for bead in beads] == [5]
    assert said == ()
    beads, _, said = loose_beads([iris, replace(iris, at=(4.0, iris.at[1]))], LINE, (), LIMITS)
    assert len(beads) == len(said) == 1
    there = Bead(np.array([1.0, iris.at[1]]), 4.0)
    assert loose_beads([replace(iris, at=(4.0, iris.at[1]))], LINE, (there,), LIMITS)[0] == ()


def test_what_is_told_names_size_and_place() -> None:
    _, (told,), _ = loose_beads([Dot((3.0, RADIUS_MM + 2.6), 4.1)], LINE, (), LIMITS)
    assert told.what == "bead"
    assert told.at == pytest.approx((3.0, RADIUS_MM + 2.6))
    assert told.reason == "becomes a bead of 4 mm; drawn 4.10 mm"


def test_a_bead_whose_line_is_gone_is_told_and_one_whose_line_moved_moves_along() -> None:
    moved, gone = Bead(np.array([5.0, 0.4]), 4.0), Bead(np.array([5.0, 30.0]), 4.0)
    _, (bead,), (said,) = beads_of(LINE, [moved, gone], [], LIMITS)
    assert bead.at == pytest.approx((5.0, 0.0))
    assert bead.segment == 0
    assert said.code == "no-bead"
    assert "30.0" in said.where
