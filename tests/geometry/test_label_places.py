"""Labels never overlap, keep off the ink where there is room, and stay near what they name."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.geometry.shapes import points
from wrapit.geometry import label_places
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


@settings(max_examples=40, deadline=None)
@given(
    st.lists(st.lists(points, min_size=1, max_size=4), min_size=1, max_size=12), anchors, st.floats(0.5, 3)
)
def test_the_place_is_that_of_all_anchors_looked_at_together(wanted: list, ink: list, size: float) -> None:
    names = [(str(index), np.array(places, float)) for index, places in enumerate(wanted)]
    dots = np.array(ink, float)
    labels = place_labels(names, dots, size)
    for index, (_, places) in enumerate(names):
        half = np.array(labels[index].half_size)
        assert labels[index].centre == pytest.approx(plain_place(places, half, labels[:index], dots, size))


def plain_place(
    places: np.ndarray, half: np.ndarray, taken: tuple[Label, ...], ink: np.ndarray, size: float
) -> tuple[float, float]:
    """The centre that all candidates of a ring together give, compared with all ink and all labels."""
    directions = label_places._DIRECTIONS
    best: tuple[int, np.ndarray] | None = None
    for ring in itertools.count():
        reach = np.abs(directions) @ half + size * (0.15 + 0.45 * ring)
        centres = (places[:, None] + (directions * reach[:, None])[None]).reshape(-1, 2)
        boxes = [(np.array(label.centre), np.array(label.half_size)) for label in taken]
        free = [c for c in centres if all((np.abs(c - at) >= half + h).any() for at, h in boxes)]
        if not free:
            continue
        hits = [int((np.abs(ink - c) < half).all(axis=1).sum()) for c in free]
        first = int(np.argmin(hits))
        if best is None or hits[first] < best[0]:
            best = hits[first], free[first]
        if best[0] == 0 or ring >= 8:
            return float(best[1][0]), float(best[1][1])
    raise AssertionError("rings have no end")


def test_ink_looked_at_grows_with_the_labels(monkeypatch: pytest.MonkeyPatch) -> None:
    """Long lines whose anchors lie far apart: four times as many on four times the page look at as much."""
    looked: list[int] = []
    plain = label_places._hits

    def counting(centres: np.ndarray, half: np.ndarray, ink: np.ndarray) -> np.ndarray:
        looked[-1] += len(centres) * len(ink)
        return plain(centres, half, ink)

    monkeypatch.setattr(label_places, "_hits", counting)
    for lines in (30, 120):
        looked.append(0)
        along = np.linspace(0, 60, 300)
        rows = [np.column_stack([along, np.full(300, 3.0 * line)]) for line in range(lines)]
        names = [(str(line), row[30::60]) for line, row in enumerate(rows)]
        place_labels(names, np.concatenate(rows), 1.0)
    assert 0 < looked[1] < 5 * looked[0]
    assert looked[0] < 30 * 60 * 300  # one line's whole ink for each candidate would be ten times as much
