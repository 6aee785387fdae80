"""Labels never overlap, keep off the ink where there is room, and stay near what they name."""

from __future__ import annotations

import itertools

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.geometry.shapes import points
from wrapit.geometry.label_places import Label, place_labels

anchors = st.lists(points, min_size=1, max_size=25)


def overlap(a: Label, b: Label) -> bool:
    return all(
        abs(p - q) < s + t - 1e-12
        for p, q, s, t in zip(a.centre, b.centre, a.half_size, b.half_size, strict=True)
    )


@settings(max_examples=40)
@given(anchors, anchors, st.floats(0.5, 3))
def test_no_two_labels_overlap(wanted: list, ink: list, size: float) -> None:
    names = [(str(index), np.array([point], float)) for index, point in enumerate(wanted)]
    labels = place_labels(names, np.array(ink, float), size)
    assert [label.text for label in labels] == [name for name, _ in names]
    assert not any(overlap(a, b) for a, b in itertools.combinations(labels, 2))
    more = place_labels(names[:1], np.array(ink, float), size, taken=labels)
    assert not any(overlap(more[0], label) for label in labels)


@given(points, st.floats(0.5, 3))
def test_a_lone_label_stands_beside_its_anchor_off_the_ink(anchor: tuple, size: float) -> None:
    ink = np.array([anchor], float) + np.column_stack([np.linspace(-9, 9, 90), np.zeros(90)])
    (label,) = place_labels([("12", np.array([anchor], float))], ink, size)
    apart = np.abs(ink - label.centre) < label.half_size
    assert not apart.all(axis=1).any()
    assert np.hypot(*(np.array(label.centre) - anchor)) < 4 * size
    assert not label.leader


def test_within_few_rings_a_crowd_leaves_some_out() -> None:
    names = [(str(index), np.zeros((1, 2))) for index in range(60)]
    placed = place_labels(names, np.zeros((0, 2)), 1.0, rings=1)
    assert 0 < len(placed) < 60
    assert len(place_labels(names, np.zeros((0, 2)), 1.0)) == 60
