"""Which spans walls are to hold beside another run: by brute force, place after place."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from tests.jig.metal import line, wires_of
from wrapit.jig.paired.leaning import LEAST_MM, beside_mm, doubles_in, leaning, walled
from wrapit.wires.model import DoubleRun, Side, Turn, Wire

SIDES = st.sampled_from(["left", "right"])
SPANS = st.tuples(st.floats(0, 100), st.floats(0, 100), SIDES).map(
    lambda span: (min(span[:2]), max(span[:2]), span[2])
)
OTHERS = st.sampled_from(["wire-01", "wire-02"])


def wire(doubles: list[tuple[tuple[float, float, Side], str]]) -> Wire:
    (made,) = wires_of([line((0, 0), (100, 0))])
    runs = tuple(DoubleRun(a, b, other, side, False, True) for (a, b, side), other in doubles)
    return replace(made, doubles=tuple(sorted(runs, key=lambda run: run.start_mm)))


@given(st.lists(SPANS, max_size=4), st.lists(st.tuples(SPANS, OTHERS), max_size=4))
def test_no_wall_where_another_run_of_the_jig_lies_on_the_inside(
    spans: list[tuple[float, float, Side]], doubles: list[tuple[tuple[float, float, Side], str]]
) -> None:
    mine = wire(doubles)
    for start, end, side in spans:
        kept = walled([Turn(mine.name, start, end, side, 0.1)], [mine])
        assert all(part.inside == side and start <= part.start_mm <= part.end_mm <= end for part in kept)
        for at_mm in np.linspace(start, end, 50)[1:-1]:
            leans = any(a < at_mm < b and s == side and name == mine.name for (a, b, s), name in doubles)
            held = any(part.start_mm <= at_mm <= part.end_mm for part in kept)
            assert not (leans and held)
            if not leans and not held:  # only crumbs between doubled stretches are left out
                ends = [x for (a, b, s), n in doubles if s == side and n == mine.name for x in (a, b)]
                before = max([x for x in ends if x <= at_mm], default=start)
                after = min([x for x in ends if x >= at_mm], default=end)
                assert min(after, end) - max(before, start) < LEAST_MM


@given(st.lists(SPANS, max_size=4))
def test_without_another_run_nothing_changes(spans: list[tuple[float, float, Side]]) -> None:
    elsewhere = wire([((0.0, 100.0, "left"), "wire-07")])
    turns = [Turn(elsewhere.name, *span, 0.1) for span in spans]
    assert walled(turns, [elsewhere]) == tuple(turns)
    assert doubles_in(elsewhere, [elsewhere]) == leaning(elsewhere, [elsewhere]) == ()
    assert beside_mm(elsewhere, [elsewhere], "left") == ()


def test_what_leans_is_what_walls_don_t_hold() -> None:
    mine = replace(
        wire([((20.0, 50.0, "left"), "wire-01")]), turns=(Turn("wire-01", 10.0, 40.0, "left", 0.1),)
    )
    assert [(turn.start_mm, turn.end_mm) for turn in walled(mine.turns, [mine])] == [(10.0, 20.0)]
    ((turn, run),) = leaning(mine, [mine])
    assert (turn.start_mm, turn.end_mm, run) == (20.0, 40.0, mine.doubles[0])
    assert beside_mm(mine, [mine], "left") == ((20.0, 50.0),)
    assert beside_mm(mine, [mine], "right") == ()
