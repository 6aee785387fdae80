"""What counts as support, and what takes it away: crossings, start holes, pins."""

from __future__ import annotations

import itertools
import math

import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from tests.jig.metal import AWG18_MM, arcs, circle, config, line, only, wires_of
from wrapit.config import JigConfig
from wrapit.errors import UnheldError
from wrapit.geometry.outlines.polygons import polygon_of
from wrapit.jig.channel import Channels
from wrapit.jig.findings import support_findings, unheld_findings
from wrapit.jig.model import Pin, TurnSupport
from wrapit.jig.printed.plan import plan_jig
from wrapit.jig.printed.planning import plan_jigs
from wrapit.jig.support import (
    held_share,
    min_wall_to_wire_mm,
    refuse_unheld,
    stretch_support,
    support_by_wire,
    total_support,
    turn_support,
    with_pins,
)
from wrapit.jig.wall_ground import inside
from wrapit.jig.wrapping.courses import courses
from wrapit.wires.model import Side, Turn

REACH_MM = AWG18_MM / 2 + 0.2


PAPERS_RULE = JigConfig(support="turns")


def test_crossing_wire_opens_a_wall() -> None:
    crossed = only([line((0, 0), (60, 0)), line((30, -25), (30, 25))], support="turns")
    (long,) = [one.share for one in crossed.support if one.turn.wire == "wire-01"]
    assert long == pytest.approx((54 - 2 * REACH_MM) / 54, abs=0.01)
    assert 0.8 < stretch_support(crossed.support) < 1.0
    bent = only([arcs((0, 0), 0, (9, 180)), line((-10, 9), (30, 9))])
    assert support_by_wire(bent.support)["wire-01"] == pytest.approx(
        1 - 2 * REACH_MM / (9 * math.pi), abs=0.02
    )


def test_a_stretch_is_held_on_its_inside_and_is_no_turn() -> None:
    # The stretch bends the other way than the turn: its wall stands above it, outside the bend.
    chains = [arcs((0, 0), 0, (9, 180), (100, -35))]
    wires, jig = wires_of(chains, PAPERS_RULE), only(chains, support="turns")
    channels = Channels.of(wires, PAPERS_RULE)
    (stretch,) = (turn for turn in wires[0].turns if turn.stretch)
    its = [wall for wall in jig.walls if polygon_of(wall, 0.01).bounds[3] > 20]
    others = [wall for wall in jig.walls if wall not in its]
    assert its
    assert others
    alone, without, bare = (turn_support(channels, walls) for walls in (its, others, ()))
    assert stretch_support(alone) > 0.95
    assert stretch_support(without) == 0.0
    assert total_support(without) == total_support(jig.support) > 0.95
    assert stretch_support(bare) == total_support(bare) == 0.0
    plan, _ = plan_jig(wires, PAPERS_RULE)
    weak = {
        finding.code: finding.where
        for finding in support_findings(channels, plan.pins, bare, courses(channels, []), PAPERS_RULE)
    }
    assert set(weak) == {"weak-turn", "weak-stretch"}
    assert weak["weak-stretch"] == channels.place(stretch)


def test_holes_make_way_for_the_walls_of_turns() -> None:
    # Both ends are within turns: a hole right at the end would take 0.84 mm of the wall's face there.
    chain = arcs((0, 0), 0, (8, 120), (14, -20), (8, 120))
    held = only([chain])
    assert total_support(held.support) > 0.99
    for hole in held.plan.holes:
        end = min((chain.start, chain.end), key=lambda point: math.dist(point, hole.centre))
        assert math.dist(end, hole.centre) == pytest.approx(0.85, abs=1e-6)
        assert shapely.Polygon(hole.outline.sampled(0.001)).contains(shapely.Point(end))
    # The two ends of a closed wire share one, which may lie as far out.
    (shared,) = only([circle(11)]).plan.holes
    assert math.dist(shared.centre, (11, 0)) < 0.85 + 1e-6
    assert shapely.Polygon(shared.outline.sampled(0.001)).contains(shapely.Point(11, 0))


def test_tight_turn_that_a_wall_can_hold_gets_no_pin() -> None:
    # 0.65 mm wide at its tip, but the legs part: the wall is a wedge.
    jig = only([arcs((0, 0), 0, (15, 0), (1.04, 100), (15, 0))])
    assert jig.plan.pins == ()
    assert total_support(jig.support) > 0.9


def test_measured_gap_sees_a_wall_that_is_too_near() -> None:
    near, wide = config(clearance="0.2 mm"), config(clearance="0.3 mm")
    wires = wires_of([arcs((0, 0), 0, (9, 180))], near)
    plan, _ = plan_jig(wires, near)
    walls = [Channels.of(wires, near).outliner.region(wall.outline) for wall in plan.walls]
    gap, _ = min_wall_to_wire_mm(Channels.of(wires, wide), walls)
    assert gap == pytest.approx(0.1, abs=1e-4), "the face that holds the wire stands the inside gap away"


places = st.lists(st.tuples(*[st.integers(-12, 12).map(lambda k: k / 2)] * 2), min_size=1, max_size=30)


@given(st.lists(st.tuples(st.integers(-4, 4), st.integers(1, 5)), max_size=5), places)
def test_probes_are_inside_as_the_plain_query_says(
    rings: list[tuple[int, int]], at: list[tuple[float, float]]
) -> None:
    walls = [shapely.Point(x, 0).buffer(size).difference(shapely.box(x, 0, x + 1, 1)) for x, size in rings]
    tree, probes = shapely.STRtree(walls), shapely.points(at)
    plain = tree.query(probes, predicate="within")
    assert sorted(zip(*inside(tree, probes), strict=True)) == sorted(zip(*plain, strict=True))


def turn(
    start_mm: float, length_mm: float, wire: str = "wire-01", inside: Side = "left", *, stretch: bool = False
) -> Turn:
    return Turn(wire, start_mm, start_mm + length_mm, inside, 0.2, stretch=stretch)


SUPPORT = st.lists(
    st.builds(
        lambda start, length, wire, inside, stretch, share: TurnSupport(
            turn(start, length, wire, inside, stretch=stretch), share
        ),
        st.floats(0, 100),
        st.floats(0.5, 50),
        st.sampled_from(["wire-01", "wire-02"]),
        st.sampled_from(["left", "right"]),
        st.booleans(),
        st.floats(0, 1),
    ),
    max_size=6,
)


def test_a_pin_holds_its_turn_whole_and_no_other() -> None:
    tight, wide = turn(3, 4), turn(20, 12)
    support = (TurnSupport(tight, 0.1), TurnSupport(wide, 0.4))
    pinned = with_pins(support, (Pin(tight, (0.0, 0.0), 0.6),))
    assert pinned == (TurnSupport(tight, 1.0), TurnSupport(wide, 0.4))
    assert with_pins(support, ()) == support


@given(SUPPORT)
def test_pins_never_hold_less(support: list[TurnSupport]) -> None:
    pins = [Pin(one.turn, (0.0, 0.0), 0.6) for one in support[::2]]
    held = with_pins(support, pins)
    assert [one.turn for one in held] == [one.turn for one in support]
    assert held_share(held) >= held_share(support) - 1e-12


@given(SUPPORT, st.floats(0, 1))
def test_what_holds_less_than_asked_is_refused(support: list[TurnSupport], least: float) -> None:
    """Turns and long stretches count together, by their lengths."""
    settings = JigConfig(least_support=least)
    total = sum(one.turn.end_mm - one.turn.start_mm for one in support)
    held = sum((one.turn.end_mm - one.turn.start_mm) * one.share for one in support) if support else 0.0
    if support and held / total < least - 1e-9:
        with pytest.raises(UnheldError, match=r"less than jig\.least_support"):
            refuse_unheld(support, settings)
    elif not support or held / total > least + 1e-9:
        refuse_unheld(support, settings)


def test_the_refusal_says_how_much_is_held_and_how_much_is_asked() -> None:
    support = (TurnSupport(turn(0, 10), 0.5), TurnSupport(turn(20, 30, stretch=True), 0.1))
    with pytest.raises(UnheldError) as refusal:
        refuse_unheld(support, JigConfig())
    assert refusal.value.problem == ("walls would hold 20% of the wires, less than jig.least_support (30%)")


def test_a_wire_that_nothing_holds_is_an_error_that_names_it() -> None:
    """By its length: one bad corner of a long wire that is held is none."""
    held = (
        TurnSupport(turn(0, 10, "wire-01"), 0.2),
        TurnSupport(turn(20, 25, "wire-01", stretch=True), 0.2),
        TurnSupport(turn(0, 10, "wire-02"), 0.9),
        TurnSupport(turn(0, 10, "wire-03"), 0.0),
        TurnSupport(turn(10, 90, "wire-03", stretch=True), 1.0),
    )
    (found,) = unheld_findings(held, JigConfig())
    assert (found.level, found.code, found.where) == ("error", "unheld-wire", "wire-01")
    assert "20%" in found.message
    assert found.severity == pytest.approx(0.8)
    assert unheld_findings(held, JigConfig(least_support=0)) == ()
    assert unheld_findings(with_pins(held, [Pin(held[0].turn, (0, 0), 0.6)]), JigConfig()) == ()


def test_two_rings_of_one_wire_are_held_though_no_wall_fits_into_their_corner() -> None:
    """Walls stand round both; the one sharp turn, of a millimetre, is no reason to refuse the piece."""
    rings = arcs((0, 0), 50, (20, 360), (0.5, 80), (20, -360))
    (planned, _) = plan_jigs(wires_of([rings]), JigConfig())
    (jig,) = planned.jigs
    sharp = [one for one in jig.held if not one.turn.stretch]
    assert max(one.turn.end_mm - one.turn.start_mm for one in sharp) < 3
    assert min(one.share for one in sharp) < 0.3
    assert held_share(jig.held) > 0.9
    refuse_unheld(jig.held, JigConfig())
    assert unheld_findings(jig.held, JigConfig()) == ()
    # Each place of the wire counts once.
    spans = sorted((one.turn.start_mm, one.turn.end_mm) for one in jig.held)
    assert spans[0][0] == 0
    assert all(end == pytest.approx(start) for (_, end), (start, _) in itertools.pairwise(spans))
    assert spans[-1][1] == pytest.approx(jig.plan.laid[0].at_mm[-1])
