"""Wires that are let go after they were wrapped under tension, and jigs that make up for what they lose."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely

from tests.jig.metal import arcs, line, wires_of
from wrapit.config import Config, JigConfig
from wrapit.geometry.polyline import total_length
from wrapit.jig.channel import Channels
from wrapit.jig.overbending import bends_round, loose_ends, overbend_wires
from wrapit.jig.walls_and_pins import standing_walls
from wrapit.jig.wrapping.courses import courses
from wrapit.jig.wrapping.let_go import Bends

LOSS = 3.395 * 200 / (117e3 * 1.0)  # half-hard copper of 1 mm
U_BEND = arcs((0, 0), 0, (10, 0), (30, 0), (8, 180), (30, 0))


def settings(temper: str = "half hard", **jig: object) -> Config:
    metal = {"gauge": "1.0 mm", "temper": temper}
    return Config.model_validate({"drawing": "a.svg", "wire": metal, "name": "a", "jig": jig})


def round_a_post(radius_mm: float, straight_mm: float = 20.0, degrees: float = 90.0) -> Bends:
    """A wire of 1 mm laid round a post that touches it all along its one bend."""
    drawn = arcs((0, 0), 0, (straight_mm, 0), (radius_mm, degrees), (straight_mm, 0))
    (wire,) = wires_of([drawn], diameter_mm=1.0)
    post = shapely.Point(straight_mm, radius_mm).buffer(radius_mm - 0.5, quad_segs=256)
    (course,) = courses(Channels.of((wire,), JigConfig()), [post])
    return Bends.of(course, [post], 1.0)


def heading(points: np.ndarray, step: int) -> float:
    x, y = points[step + 1] - points[step] if step >= 0 else points[-1] - points[-2]
    return math.atan2(y, x)


@pytest.fixture(name="post")
def _post() -> Bends:
    return round_a_post(10.0)


def arcs_mm(bends: Bends) -> float:
    return float(bends.held_mm.sum())


def test_a_wire_loses_what_lay_on_the_post(post: Bends) -> None:
    assert arcs_mm(post) == pytest.approx(5 * math.pi, rel=0.05)
    free = post.let_go(LOSS)
    lost = heading(post.points, -1) - heading(free, -1)
    assert lost == pytest.approx(LOSS * 5 * math.pi, rel=0.05)
    assert heading(free, 0) == pytest.approx(heading(post.points, 0)), "its start stays where it is"
    assert total_length(free) == pytest.approx(total_length(post.points))


def test_a_bend_that_the_metal_does_not_take_is_lost_whole(post: Bends) -> None:
    free = post.let_go(1.0)
    held = post.held_mm > 0
    assert abs(heading(free, -1) - heading(free, 0)) < abs(float(post.turned_rad[~held].sum())) + 1e-9


def test_the_end_springs_round_the_last_wall(post: Bends) -> None:
    # Each mm of the bend turns all that comes after it: the sum of its distances from the end (30, 30).
    along = np.linspace(0, math.pi / 2, 1001)
    levers = np.column_stack([10 - 10 * np.sin(along), 20 + 10 * np.cos(along)]).mean(axis=0)
    assert post.end_moves_mm(LOSS) == pytest.approx(LOSS * 5 * math.pi * np.hypot(*levers), rel=0.03)


def test_of_two_walls_the_last_one_counts() -> None:
    drawn = arcs((0, 0), 0, (30, 0), (10, 90), (30, 0), (10, 90), (5, 0))
    (wire,) = wires_of([drawn], diameter_mm=1.0)
    posts = [shapely.Point(*at).buffer(9.5, quad_segs=256) for at in ((30, 10), (30, 40))]
    (course,) = courses(Channels.of((wire,), JigConfig()), posts)
    bends = Bends.of(course, posts, 1.0)
    assert arcs_mm(bends) == pytest.approx(10 * math.pi, rel=0.05)
    assert bends.held_mm[bends.last_hold].sum() == pytest.approx(5 * math.pi, rel=0.05)
    # The end (25, 50) from the middle of the bend's mass, seen from its centre (30, 40).
    lever = math.hypot(-5 - 20 / math.pi, 10 - 20 / math.pi)
    assert bends.end_moves_mm(LOSS) == pytest.approx(LOSS * 5 * math.pi * lever, rel=0.03)


def test_nothing_holds_a_wire_without_walls() -> None:
    (wire,) = wires_of([line((0, 0), (40, 0))], diameter_mm=1.0)
    (course,) = courses(Channels.of((wire,), JigConfig()), [])
    assert Bends.of(course, [], 1.0).end_moves_mm(LOSS) == 0.0


def test_a_taut_wire_of_the_jig_that_bends_it_further_comes_back_to_the_drawing() -> None:
    config = settings(springback="compensate")
    # An S of gentle bends with walls along a part of them only, and one that is sharp.
    drawn = arcs((0, 0), 0, (25, 80), (30, -120), (8, 100), (20, 0))
    wires = wires_of([drawn], config.jig, diameter_mm=1.0)
    ((over,), (told,)) = overbend_wires(wires, config)
    (as_drawn,) = bends_round(standing_walls(wires, config.jig))
    taut, free = as_drawn.points, as_drawn.let_go(LOSS)
    assert np.linalg.norm(taut[-1] - free[-1]) > 3.0, "wrapped round what is drawn it misses it by that"
    assert over.residual_mm < 0.6
    assert f"within {over.residual_mm:.2f} mm" in told.message
    (bends,) = bends_round(standing_walls(wires, config.jig))
    lying_mm = float(bends.lies_mm.sum())
    assert over.overbend_rad == pytest.approx(lying_mm * LOSS, rel=0.25), "less where it is all but straight"


def test_each_wire_is_told_of() -> None:
    wires = wires_of([U_BEND, arcs((0, 60), 0, (10, 90))], diameter_mm=1.0)
    over, findings = overbend_wires(wires, settings(springback="compensate"))
    assert [each.where for each in findings] == [each.wire.name for each in over] == ["wire-01", "wire-02"]


def test_an_end_is_loose_if_it_springs_past_its_hole() -> None:
    loose = {}
    for temper in ("dead soft", "half hard", "hard"):
        config = settings(temper)
        wires = wires_of([U_BEND], config.jig, diameter_mm=1.0)
        loose[temper] = loose_ends(standing_walls(wires, config.jig), config)
    # 25 mm of bend times 30 mm of free wire: 1.5 mm when dead soft.
    assert [len(found) for found in loose.values()] == [1, 1, 1]
    severities = [found[0].severity for found in loose.values()]
    assert severities == sorted(severities)
    config = settings("dead soft")
    short = wires_of([arcs((0, 0), 0, (30, 0), (8, 180), (3, 0))], config.jig, diameter_mm=1.0)
    assert loose_ends(standing_walls(short, config.jig), config) == ()
