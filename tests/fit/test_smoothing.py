"""Bends that are too tight are widened, wherever on a line they are."""

from __future__ import annotations

import math

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.bench.fit_judge import fitness
from tests.decomposition.drawings import drawing_of
from tests.fit.drawn import apart_mm, config, drawn, mapped
from wrapit.fit.clearing import cleared
from wrapit.fit.limits import limits_of
from wrapit.fit.sketch import Sketch
from wrapit.fit.smoothing import smoothed

LIMITS = limits_of(config("bold", 20), "bold")


@settings(max_examples=25, deadline=None, derandomize=True)
@given(st.integers(3, 9), st.floats(10, 40), st.integers(0, 8), st.floats(0, 6))
def test_a_polygon_is_rounded_at_each_corner_also_where_it_starts(sides, radius, first, turned) -> None:  # type: ignore[no-untyped-def]
    at = turned + 2 * math.pi * np.arange(sides) / sides
    corners = [(radius * math.cos(a), radius * math.sin(a)) for a in at]
    # Which corner the ring starts at hangs on which sides are joined last.
    lines = [((k + first) % sides, (k + first + 1) % sides) for k in range(sides)]
    drawing = drawing_of(corners, lines)
    sketch = Sketch.of(drawing).simplified()
    after = smoothed(sketch, LIMITS)
    made, _ = after.drawing(drawing)
    assert fitness(drawing, LIMITS.diameter_mm, LIMITS.radius_mm).tight == sides
    assert fitness(made, LIMITS.diameter_mm, LIMITS.radius_mm).tight == 0
    told = np.array([removal.at for removal in after.removed])
    for corner in corners:
        assert np.hypot(*(told - corner).T).min() < 0.5, "each is told where it was"


@settings(max_examples=12, deadline=None, derandomize=True)
@given(st.sampled_from(["net", "comb", "finger", "star", "flower", "ladder"]), st.integers(0, 40))
def test_random_lines_are_widened_alike_in_the_mirror(kind: str, seed: int) -> None:
    drawing = drawn(kind, seed, 50.0)
    before = cleared(Sketch.of(drawing), LIMITS, "bold", frozenset())
    sharp, _ = before.drawing(drawing)
    made, _ = smoothed(before, LIMITS).drawing(drawing)
    was, seen = (fitness(each, LIMITS.diameter_mm, LIMITS.radius_mm) for each in (sharp, made))
    assert seen.tight <= was.tight
    assert seen.crossings <= was.crossings
    assert len(made.segments) == len(sharp.segments)
    image = mapped(sharp, np.diag([-1.0, 1.0]))
    there, _ = smoothed(Sketch.of(image), LIMITS).drawing(image)
    assert apart_mm(there, mapped(made, np.diag([-1.0, 1.0]))) < 0.05
