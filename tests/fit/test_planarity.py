"""Whether lines cross but at their nodes: against discs about the nodes, cut out of what lines share."""

from __future__ import annotations

import numpy as np
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from wrapit.fit.merging.planarity import is_planar
from wrapit.fit.sketch import Line, Sketch
from wrapit.geometry import straight

# Places on a grid, so that lines touch, end on one another and lie on one another often.
PLACES = st.tuples(st.integers(0, 3), st.integers(0, 3))


@settings(max_examples=300, deadline=None, derandomize=True)
@given(st.lists(PLACES, min_size=3, max_size=6, unique=True), st.data())
def test_lines_are_planar_where_they_meet_at_their_nodes_alone(places, data) -> None:
    ends = st.tuples(st.integers(0, len(places) - 1), st.integers(0, len(places) - 1))
    pairs = data.draw(st.lists(ends.filter(lambda pair: pair[0] != pair[1]), min_size=2, max_size=5))
    nodes = {k: np.array(place, dtype=np.float64) for k, place in enumerate(places)}
    lines = {n: Line(a, b, straight(nodes[a], nodes[b]), frozenset({n})) for n, (a, b) in enumerate(pairs)}
    whole = Sketch(nodes, lines)
    before = whole.changed([len(pairs) - 1])
    last = lines[len(pairs) - 1]
    free = all(
        shapely.intersection(last.shape, line.shape)
        .difference(
            shapely.union_all(
                [
                    shapely.Point(nodes[k]).buffer(0.05)
                    for k in {last.start, last.end} & {line.start, line.end}
                ]
            )
        )
        .is_empty
        for line in before.lines.values()
    )
    assert is_planar(whole, {len(pairs) - 1: last}, before) == free
    # What crossed before may cross still.
    assert is_planar(whole, {len(pairs) - 1: last}, whole)
