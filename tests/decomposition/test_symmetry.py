"""The mirror axis of a drawing, and wires that keep to it."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.decomposition.asking import solved
from tests.decomposition.drawings import drawing_of, lotus
from wrapit.decomposition.json_file import decomposition_json
from wrapit.drawing.reflection import NO_IMAGE, Axis, images_of, mirror_images


@pytest.mark.parametrize("turn", [0.0, 0.4])
def test_the_mirror_axis_is_found(turn: float) -> None:
    rotation = np.array([[math.cos(turn), -math.sin(turn)], [math.sin(turn), math.cos(turn)]])
    plain = lotus()
    turned = drawing_of(
        [tuple(rotation @ junction.point) for junction in plain.junctions],
        [(segment.start, segment.end) for segment in plain.segments],
    )
    mirror = mirror_images(turned, "auto")
    assert [mirror[2 * e] // 2 for e in range(12)] == [0, 2, 1, 4, 3, 6, 5, 8, 7, 10, 9, 11]
    assert mirror[2 * 5] == 2 * 6
    assert all(mirror[mirror[h]] == h for h in range(24))
    if not turn:
        assert mirror_images(turned, "vertical") == mirror
        assert mirror_images(turned, "horizontal") != mirror


def test_symmetry_is_kept_when_it_weighs() -> None:
    loose = solved(lotus())
    kept = solved(lotus(), weights={"symmetry": 3.0})
    assert kept.optimal
    assert kept.energy.asymmetry < max(1, solved(lotus(), weights={"symmetry": 1e-9}).energy.asymmetry)
    assert kept.energy.total >= loose.energy.total - 1e-9


def test_the_file_speaks_of_symmetry_where_it_was_asked_for() -> None:
    plain = json.loads(decomposition_json(solved(lotus())))
    assert "symmetry" not in plain["weights"]
    assert "asymmetry" not in plain["energy"]
    kept = json.loads(decomposition_json(solved(lotus(), weights={"symmetry": 0.5})))
    terms = kept["energy"]
    assert kept["weights"]["symmetry"] == 0.5
    total = terms["complexity"] + 0.1 * terms["smoothness_rad"] + 0.9 * terms["robustness"]
    assert terms["total"] == pytest.approx(total + 0.5 * terms["asymmetry"])


@settings(max_examples=60)
@given(st.integers(0, 10**6), st.integers(1, 30), st.floats(0, math.pi), st.booleans())
def test_images_are_those_that_all_pairs_give(seed: int, count: int, angle: float, mirrored: bool) -> None:
    """Each line beside each: the nearest in the mirror, if each is the other's and near enough."""
    rng = np.random.default_rng(seed)
    lines = rng.uniform(-20, 20, (count, 1, 2)) + rng.uniform(-4, 4, (count, 9, 2)).cumsum(axis=1)
    if mirrored:
        flipped = Axis(np.zeros(2), angle).mirrored(lines) + rng.normal(0, 0.3, lines.shape)
        lines = rng.permutation(np.concatenate([lines, flipped]))
    lengths = np.ones(len(lines))
    images, share, axis = images_of(lines, lengths, [angle, 0.0], 60.0)
    seen = axis.mirrored(lines)
    far = np.array([[min(np.abs(a - b).max(), np.abs(a - b[::-1]).max()) for b in lines] for a in seen])
    nearest = far.argmin(axis=1)
    expected = [
        f if nearest[f] == e and far[e, f] <= 0.04 * 60.0 else NO_IMAGE
        for e, f in enumerate(nearest.tolist())
    ]
    assert [h // 2 if h != NO_IMAGE else NO_IMAGE for h in images[::2]] == expected
    assert share == pytest.approx(np.mean([f != NO_IMAGE for f in expected]))
