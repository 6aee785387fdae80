"""Sketches are worked on in a pose: one for a figure and all its images, and undone to the last bit."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.fit.drawn import IMAGES, KINDS, drawn, looks_the_same, mapped
from wrapit.drawing.model import Removal
from wrapit.fit.mirroring.posing import posed, unposed
from wrapit.fit.sketch import Line, Sketch
from wrapit.geometry import FloatArray, straight

SQUARE = ((0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0))


def parts(sketch: Sketch) -> dict[int, tuple[int, int, bytes]]:
    return {n: (line.start, line.end, line.curve.points.tobytes()) for n, line in sketch.lines.items()}


def curves(sketch: Sketch) -> list[list[float]]:
    """All curves, however they are numbered and whichever way they run."""
    every = [line.curve.points for line in sketch.lines.values()]
    return sorted(min(each.ravel().tolist(), each[::-1, ::-1].ravel().tolist()) for each in every)


def polygon(*corners: tuple[float, float]) -> Sketch:
    lines = {
        n: Line(n, (n + 1) % len(corners), straight(a, b), frozenset((n,)))
        for n, (a, b) in enumerate(zip(corners, (*corners[1:], corners[0]), strict=True))
    }
    return Sketch({n: np.array(corner) for n, corner in enumerate(corners)}, lines)


@settings(max_examples=30, deadline=None, derandomize=True)
@given(st.sampled_from(KINDS), st.integers(0, 200), st.booleans(), st.sampled_from(IMAGES))
def test_a_figure_and_its_images_are_one_in_their_pose(
    kind: str, seed: int, twin: bool, matrix: FloatArray
) -> None:
    drawing = drawn(kind, seed, 50.0, twin=twin)
    one, other = posed(Sketch.of(drawing))[0], posed(Sketch.of(mapped(drawing, matrix)))[0]
    if parts(one) == parts(other):
        assert all((one.nodes[n] == other.nodes[n]).all() for n in one.nodes | other.nodes)
        return
    # It looks the same in several poses: the one taken may be another, in which all lies where it did.
    assert looks_the_same(drawing)
    assert one.lines.keys() == other.lines.keys()
    for n, line in one.lines.items():
        np.testing.assert_allclose(line.curve.points, other.lines[n].curve.points, rtol=0, atol=3e-6)


@settings(max_examples=30, deadline=None, derandomize=True)
@given(st.sampled_from(KINDS), st.integers(0, 200), st.sampled_from(IMAGES))
def test_a_pose_is_undone_to_the_last_bit(kind: str, seed: int, matrix: FloatArray) -> None:
    sketch = Sketch.of(mapped(drawn(kind, seed, 50.0), matrix))
    there, pose = posed(sketch.changed(told=(Removal("dropped", (3.0, -0.7), 1.0),)))
    back = unposed(there, pose)
    assert curves(back) == curves(sketch)
    assert back.removed == (Removal("dropped", (3.0, -0.7), 1.0),)
    for line in back.lines.values():
        assert (back.nodes[line.start] == line.curve.start).all()
        assert (back.nodes[line.end] == line.curve.end).all()


@pytest.mark.parametrize("matrix", IMAGES)
def test_level_lines_have_no_negative_zeros(matrix: FloatArray) -> None:
    """Directions are compared as angles: -0.0 would make half a turn of none."""
    sketch = polygon(*(tuple(np.array(corner) @ matrix) for corner in SQUARE))
    there, pose = posed(sketch)
    for each in (there, unposed(there, pose)):
        for line in each.lines.values():
            assert not (np.signbit(line.curve.points) & (line.curve.points == 0)).any()


def test_the_last_bit_decides_nothing() -> None:
    """A square looks the same from eight sides, also one whose corner is off by less than is certain."""
    off = ((0.0, 0.0), (4.0, 0.0), (4.0, 4.0 + 1e-12), (0.0, 4.0))
    for matrix in IMAGES:
        poses = [
            posed(polygon(*(tuple(np.array(c) @ matrix) for c in corners)))[1] for corners in (SQUARE, off)
        ]
        assert (poses[0] == poses[1]).all()
