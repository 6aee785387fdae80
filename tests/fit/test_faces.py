"""Faces of random drawings, against the bench's judge; two lines on one another are a face without room."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.bench.fit_judge import fitness
from tests.decomposition.drawings import theta
from tests.fit.drawn import KINDS, drawn
from wrapit.drawing.model import Drawing, Junction, Segment
from wrapit.fit.faces import faces_of
from wrapit.fit.sketch import Sketch
from wrapit.geometry import BezierChain, straight

kinds = st.sampled_from([kind for kind in KINDS if kind != "blobs"])
SOME = settings(max_examples=15, deadline=None, derandomize=True)


@SOME
@given(kinds, st.integers(0, 60))
def test_faces_have_the_room_that_the_judge_sees(kind: str, seed: int) -> None:
    drawing = drawn(kind, seed, 50.0)
    mine = [face.inside_mm for face in faces_of(Sketch.of(drawing)).faces if face.inside_mm > 0.1]
    assert np.diff(mine).min(initial=0.0) > -1e-5, "the least first"
    assert mine == pytest.approx([d for d in fitness(drawing, 1.0, 1.0).faces_d if d > 0.1], abs=0.04)


@SOME
@given(st.floats(0.002, 0.1), st.floats(4, 30))
def test_two_lines_on_one_another_have_no_room(apart: float, length: float) -> None:
    a, b = np.array([0.0, 0.0]), np.array([length, 0.0])
    bow = BezierChain(np.array([[a, [length / 3, apart], [2 * length / 3, apart], b]]))
    drawing = Drawing(
        (Junction(0, a), Junction(1, b)), (Segment(0, 0, 1, straight(a, b)), Segment(1, 0, 1, bow))
    )
    (face,) = faces_of(Sketch.of(drawing)).faces
    assert face.lines == {0, 1}
    assert face.inside_mm <= apart + 0.01


def test_the_outline_is_what_borders_on_the_outside() -> None:
    assert faces_of(Sketch.of(theta())).outline == {0, 1, 2, 3}
