"""A drawing as a sketch and back: nothing moves, nothing gets lost."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.fit.drawn import KINDS, apart_mm, drawn
from wrapit.config import Config
from wrapit.decomposition.bridges import with_bridges
from wrapit.fit.measuring import fewest_wires
from wrapit.fit.sketch import Sketch
from wrapit.fit.stage import make_fit

cases = given(st.sampled_from([kind for kind in KINDS if kind != "blobs"]), st.integers(0, 60))
SOME = settings(max_examples=25, deadline=None, derandomize=True)


@SOME
@cases
def test_there_and_back(kind: str, seed: int) -> None:
    drawing = drawn(kind, seed, 40.0)
    again, origins = Sketch.of(drawing).drawing(drawing)
    assert sorted(origins) == [(segment.id,) for segment in drawing.segments]
    for segment, (origin,) in zip(again.segments, origins, strict=True):
        assert segment.curve.length == pytest.approx(drawing.segments[origin].curve.length)


@SOME
@cases
def test_lines_that_go_on_in_one_other_are_one(kind: str, seed: int) -> None:
    drawing = drawn(kind, seed, 40.0)
    before = Sketch.of(drawing)
    after = before.simplified()
    for arms in after.arms.values():
        assert len(arms) != 2 or arms[0][0] == arms[1][0]
    assert frozenset().union(*(line.origin for line in after.lines.values())) == set(before.lines)
    assert sum(line.curve.length for line in after.lines.values()) == pytest.approx(drawing.length_mm)
    assert fewest_wires(after) == fewest_wires(before)
    assert apart_mm(after.drawing(drawing)[0], drawing) < 0.02
    assert after.simplified() is after


def test_bridges_that_are_offered_are_no_lines() -> None:
    drawing = drawn("leaf", 0, 40.0)
    offered = with_bridges(drawing)
    assert len(offered.segments) > len(drawing.segments)
    strokes = {segment.id for segment in offered.segments if segment.kind == "stroke"}
    assert set(Sketch.of(offered).lines) == strokes
    config = Config.model_validate({"drawing": "leaf.json", "fit": "bold"})
    fitted, _ = make_fit(offered, config)
    assert all(segment.kind == "stroke" for segment in fitted.drawing.segments)
    assert set(fitted.left_out) <= strokes
    assert [s.curve.length for s in fitted.drawing.segments] == pytest.approx(
        [s.curve.length for s in make_fit(drawing, config)[0].drawing.segments]
    )
