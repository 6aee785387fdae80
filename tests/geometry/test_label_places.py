"""Labels find places of their own."""

from __future__ import annotations

import itertools

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from wrapit.geometry.label_places import place_labels


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 2**32), st.integers(1, 40))
def test_labels_never_overlap(seed: int, count: int) -> None:
    points = np.random.default_rng(seed).uniform(0, 10, (count, 2))
    labels = place_labels([(str(index), point[None]) for index, point in enumerate(points)], points, 1.0)
    for a, b in itertools.combinations(labels, 2):
        apart = np.abs(np.subtract(a.centre, b.centre)) >= np.add(a.half_size, b.half_size) - 1e-9
        assert apart.any()
