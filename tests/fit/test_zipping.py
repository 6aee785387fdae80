"""Lines that run along one another become one; others stay as they are."""

from __future__ import annotations

import itertools
from dataclasses import replace

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.bench.fit_judge import fitness
from tests.decomposition.drawings import drawing_of
from tests.fit.drawn import KINDS, config, drawn
from wrapit.drawing.model import Drawing
from wrapit.fit.limits import limits_of
from wrapit.fit.sketch import Sketch
from wrapit.fit.zipping.stretches import Near, near_places
from wrapit.fit.zipping.zipped import zipped

LIMITS = limits_of(config("bold", 18), "bold")
SOME = settings(max_examples=12, deadline=None, derandomize=True)
kinds = st.sampled_from([kind for kind in KINDS if kind != "blobs"])


def one(sketch: Sketch) -> Sketch:
    return zipped(sketch, LIMITS, frozenset())


def rails(apart_mm: float) -> Drawing:
    """A bar of 60 mm, and one beside it whose ends stand off."""
    points = [(0, 0), (60, 0), (-10, 15), (70, 15), (10, apart_mm), (50, apart_mm)]
    return drawing_of(points, [(0, 1), (2, 4), (4, 5), (5, 3)])


@SOME
@given(st.floats(0.2, 4.0))
def test_bars_are_one_where_there_is_less_room_than_wire_needs(apart: float) -> None:
    sketch = Sketch.of(rails(apart)).simplified()
    after = one(sketch)
    if apart >= LIMITS.room_mm:
        assert after.lines.keys() == sketch.lines.keys()
    elif apart < 0.97 * LIMITS.room_mm:
        assert [removal.what for removal in after.removed] == ["merged"]
        assert after.removed[0].length_mm > 35


@SOME
@given(kinds, st.integers(0, 30))
def test_zipping_crosses_nothing(kind: str, seed: int) -> None:
    drawing = drawn(kind, seed, 40.0)
    after, _ = one(Sketch.of(drawing).simplified()).drawing(drawing)
    before = fitness(drawing, LIMITS.diameter_mm, LIMITS.radius_mm)
    seen = fitness(after, LIMITS.diameter_mm, LIMITS.radius_mm)
    assert seen.crossings <= before.crossings
    assert seen.pieces == before.pieces


@SOME
@given(kinds, st.integers(0, 30), st.data())
def test_what_is_known_of_nearness_holds_for_lines_that_stay(
    kind: str, seed: int, data: st.DataObject
) -> None:
    """Places too near, found anew and from those of the sketch before some lines changed."""
    before = Sketch.of(drawn(kind, seed, 40.0)).simplified()
    numbers = sorted(before.lines)
    some = st.sets(st.sampled_from(numbers), max_size=len(numbers) - 1)
    gone, moved = data.draw(some), data.draw(some)
    bent = {
        n: replace(before.lines[n], curve=before.lines[n].curve.mapped(np.eye(2), (0.3, 0.1))) for n in moved
    }
    after = before.changed(gone, bent)
    anew = near_places(after, LIMITS.room_mm)
    from_known = near_places(after, LIMITS.room_mm, (before, near_places(before, LIMITS.room_mm)))
    assert _rows(from_known) == _rows(anew)


def _rows(near: Near) -> list[tuple[float, ...]]:
    return sorted(zip(near.one, near.other, near.at, near.other_at, near.gap, strict=True))


def test_both_ends_of_a_lens_are_zipped() -> None:
    """Two runs of the same two lines: after the first the second is still looked at."""
    x = np.linspace(0, 60, 61)
    points = [(0.0, 0.0), (60.0, 0.0), (-12.0, 0.0), (72.0, 0.0)]
    high = [(float(a), 1.2 + 5.0 * float(np.exp(-(((a - 30) / 6) ** 2)))) for a in x[6:-5:2]]
    numbers = [len(points) + k for k in range(len(high))]
    lines = [
        (2, 0),
        (0, 1),
        (1, 3),
        (0, numbers[0]),
        *itertools.pairwise(numbers),
        (numbers[-1], 1),
    ]
    after = one(Sketch.of(drawing_of(points + high, lines)).simplified())
    assert len({removal.at[0] < 30 for removal in after.removed if removal.what == "merged"}) == 2
