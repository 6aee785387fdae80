"""What counts as support, and what takes it away: crossings, start holes, pins."""

from __future__ import annotations

import math

import pytest
import shapely

from tests.jig.metal import AWG18_MM, arcs, circle, config, line, only, wires_of
from wrapit.config import JigConfig
from wrapit.geometry.outlines.polygons import polygon_of
from wrapit.jig.channel import Channels
from wrapit.jig.findings import support_findings
from wrapit.jig.printed.plan import plan_jig
from wrapit.jig.support import (
    min_wall_to_wire_mm,
    stretch_support,
    support_by_wire,
    total_support,
    turn_support,
)

REACH_MM = AWG18_MM / 2 + 0.2


def test_crossing_wire_opens_a_wall() -> None:
    crossed = only([line((0, 0), (60, 0)), line((30, -25), (30, 25))])
    assert len(crossed.walls) == 4
    (long,) = [one.share for one in crossed.support if one.turn.wire == "wire-01"]
    assert long == pytest.approx((54 - 2 * REACH_MM) / 54, abs=0.01)
    assert 0.8 < stretch_support(crossed.support) < 1.0
    bent = only([arcs((0, 0), 0, (9, 180)), line((-10, 9), (30, 9))])
    assert support_by_wire(bent.support)["wire-01"] == pytest.approx(
        1 - 2 * REACH_MM / (9 * math.pi), abs=0.02
    )


def test_a_stretch_needs_one_wall_and_is_no_turn() -> None:
    chains = [arcs((0, 0), 0, (9, 180), (60, 0))]
    wires, jig = wires_of(chains), only(chains)
    channels = Channels.of(wires, JigConfig())
    stretch = next(turn for turn in wires[0].turns if turn.inside == "both")
    below = [wall for wall in jig.walls if polygon_of(wall, 0.01).bounds[1] < 18]
    assert len(below) < len(jig.walls)  # one wall stands above the stretch, outside the bend
    one_sided, bare = turn_support(channels, below), turn_support(channels, ())
    assert stretch_support(one_sided) == pytest.approx(1.0)
    assert total_support(one_sided) == total_support(jig.support) > 0.95
    assert stretch_support(bare) == total_support(bare) == 0.0
    plan, _ = plan_jig(wires, JigConfig())
    weak = {
        finding.code: finding.where for finding in support_findings(channels, plan.pins, bare, JigConfig())
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
    # The ends of a closed wire lie between walls on both sides: there the hole stays.
    (shared,) = only([circle(11)]).plan.holes
    assert math.dist(shared.centre, (11, 0)) < 1e-6


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
    assert gap == pytest.approx(0.2, abs=1e-4)
