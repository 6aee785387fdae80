"""What walls leave free to wires: the wires and their channels, and no pinholes in a wall."""

from __future__ import annotations

import shapely
from hypothesis import example, given, settings
from hypothesis import strategies as st

from tests.jig.metal import arcs, wires_of
from wrapit.config import JigConfig
from wrapit.jig.channel import Channels
from wrapit.jig.wrapping.passage import CRUMB_MM, passage
from wrapit.wires.model import Side, Turn

# Legs with bends between them, from a kink to a turn wide enough to have a wall inside.
LEGS = st.lists(
    st.tuples(st.floats(4, 12), st.sampled_from([0.001, 0.1, 0.3, 0.6, 1.0, 3.0]), st.integers(-170, 170)),
    min_size=1,
    max_size=3,
)


@settings(max_examples=100, deadline=None)
@given(LEGS, st.sampled_from([0.0, 0.25, 0.5]), st.sampled_from(["left", "right"]))
@example([(8.0, 0.3, -147)], 0.25, "left")
@example([(9.0, 0.3, 25)], 0.5, "left")
@example([(4.765625, 0.001, 15), (5.625, 3.0, 135), (5.6875, 0.6, -118)], 0.25, "right")
def test_round_any_bend_the_passage_has_no_crumbs(
    legs: list[tuple[float, float, int]], start: float, side: Side
) -> None:
    steps = [step for length, radius, degrees in legs for step in ((length, 0.0), (radius, degrees or 1))]
    wires = wires_of([arcs((0, 0), 0, *steps, (8.0, 0.0))])
    config = JigConfig()
    channels = Channels.of(wires, config)
    length_mm = wires[0].length_mm
    held = Turn(wires[0].name, start * length_mm, (start + 0.45) * length_mm, side, 0.1)
    free = passage(channels, [held], config)
    for part in shapely.get_parts(free):
        assert not part.buffer(-0.49 * CRUMB_MM).is_empty
    # Nothing of what the wire itself takes up is lost, nor of its channel where no wall holds it.
    assert free.covers(channels.lines[0].buffer(channels.face_mm))
    other = Turn(held.wire, held.start_mm, held.end_mm, "right" if side == "left" else "left", 0.1)
    # Taken away one after the other: GEOS may lose a rim when it joins two grounds with the same edges.
    neither = channels.area.difference(free).difference(passage(channels, [other], config))
    assert neither.area < CRUMB_MM * channels.area.length
