"""Jigs of two runs side by side: walls on the right side, none in a run's way, nothing thin between."""

from __future__ import annotations

import itertools
from dataclasses import replace

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.jig.paired.pairs import SHAPES, STRAIGHT, D, Parts, hairpin, meeting, two_wires
from wrapit.config import Config, JigConfig, PlateConfig
from wrapit.geometry.arclength import ArcLength
from wrapit.geometry.outlines.polygons import polygon_of
from wrapit.jig.channel import SIDES, Channels
from wrapit.jig.paired.between import metal_between
from wrapit.jig.parting.grouping import support_losses
from wrapit.jig.pegs.placing import place_pegs
from wrapit.jig.printed.course_groove import LEAST_WIDTH_MM
from wrapit.jig.printed.planning import PlannedJig, plan_jigs
from wrapit.jig.sheet.stage import plan_stacks
from wrapit.jig.wrapping.needs import planned_walls
from wrapit.wires.model import Wire

RULES = {"taut": JigConfig(), "turns": JigConfig(support="turns")}


def made(shape: str, how: str, config: JigConfig | None = None) -> tuple[Wire, ...]:
    parts = SHAPES[shape]
    if how == "fold":
        return (hairpin(parts, config=config),)
    return two_wires(parts, opposed=how == "opposed", config=config)


def points_of(wire: Wire, start_mm: float, end_mm: float) -> np.ndarray:
    lengths = ArcLength(wire.centreline)
    return wire.centreline.at(lengths.parameter(np.linspace(start_mm, end_mm, 200)))


def check_walls(wires: tuple[Wire, ...], walls: list[shapely.Polygon], gap_mm: float) -> None:
    """No wall meets a disc of the wire's thickness anywhere on its way, and none stands between two runs."""
    for wire in wires:
        places = shapely.points(points_of(wire, 0.0, wire.length_mm))
        for wall in walls:
            assert shapely.distance(wall, places).min() >= wire.diameter_mm / 2 + gap_mm - 2e-3
        for run in wire.doubles:
            spline, lengths = wire.centreline, ArcLength(wire.centreline)
            u = lengths.parameter(np.linspace(run.start_mm, run.end_mm, 100))
            ahead = spline.derivative(u)
            left = np.column_stack([-ahead[:, 1], ahead[:, 0]]) / np.linalg.norm(ahead, axis=1)[:, None]
            across = np.stack([spline.at(u), spline.at(u) + SIDES[run.side] * D * left], axis=1)
            assert not shapely.intersects(shapely.union_all(walls), shapely.linestrings(across)).any()


def jigs_of(wires: tuple[Wire, ...], config: JigConfig) -> tuple[PlannedJig, ...]:
    return plan_jigs(wires, config)[0].jigs


@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize("how", ["along", "opposed", "fold"])
@pytest.mark.parametrize("shape", SHAPES)
def test_only_the_inner_run_of_a_turn_has_a_wall_and_no_run_a_wall_in_its_way(
    shape: str, how: str, rule: str
) -> None:
    config = RULES[rule]
    wires = made(shape, how, config)
    jigs, said = plan_jigs(wires, config)
    (jig,) = jigs.jigs
    assert {wire.name for wire in wires} == set(jig.plan.wires)
    check_walls(wires, [polygon_of(wall, 1e-3) for wall in jig.walls], config.inside_gap)
    check_walls(wires, [wall.outline for wall in jig.plan.walls], config.inside_gap)
    for wire in wires:
        for turn in wire.turns:
            middle = (turn.start_mm + turn.end_mm) / 2
            outer = any(
                run.start_mm <= middle <= run.end_mm and run.side == turn.inside for run in wire.doubles
            )
            held = [one for one in jig.support if one.turn == turn]
            assert len(held) == (0 if outer else 1)
            assert all(one.share > 0.95 for one in held)
            walls = [wall for wall in jig.plan.walls for each in wall.turns if each.wire == wire.name
                     and each.inside == turn.inside and each.start_mm <= middle <= each.end_mm]  # fmt: skip
            assert bool(walls) is not outer
    # The outer run leans on the inner one: neither strays.
    assert max(course.off_mm.max() for course in jig.plan.laid) < config.taut_tolerance
    assert not [each for each in said if each.level != "note" or each.code == "plain-wall"]


@pytest.mark.parametrize("how", ["along", "fold"])
@pytest.mark.parametrize("shape", ["arc", "S"])
def test_laser_plates_too(shape: str, how: str) -> None:
    wires = made(shape, how)
    plans, _, said = plan_stacks(wires, JigConfig(), PlateConfig())
    (plan,) = plans.values()
    check_walls(wires, [polygon_of(wall, 1e-3) for wall in plan.walls], JigConfig().inside_gap)
    assert not [each for each in said if each.code in ("strays", "turn-without-wall")]
    bends = sum(1 for _, degrees in SHAPES[shape] if degrees)
    asked = {one.turn for one in plan.held if not one.turn.stretch}
    assert len(asked) == sum(len(wire.turns) for wire in wires) - bends


@settings(max_examples=12, deadline=None)
@given(st.floats(3, 25), st.floats(30, 170), st.floats(4, 15), st.sampled_from([1, -1]), st.booleans())
def test_round_any_turn_the_channel_of_a_pair_is_one(
    radius: float, degrees: float, leg: float, sign: int, opposed: bool
) -> None:
    parts: Parts = ((leg, 0), (radius, sign * degrees), (leg, 0))
    wires = two_wires(parts, opposed=opposed)
    (jig,) = jigs_of(wires, JigConfig(split="single"))
    check_walls(wires, [wall.outline for wall in jig.plan.walls], JigConfig().inside_gap)
    assert jig.channels.area.geom_type == "Polygon"
    assert not jig.channels.area.interiors
    # Beside the middle of the pair no ground is left between both channels.
    middle = shapely.LineString(points_of(wires[0], 0.0, wires[0].length_mm)).buffer(D / 2)
    assert middle.difference(jig.channels.area).area < 1e-6


@settings(max_examples=10, deadline=None)
@given(st.floats(2.5, 12), st.floats(30, 90))
def test_where_runs_meet_and_part_no_wall_is_in_the_way(radius: float, degrees: float) -> None:
    wires = meeting(radius, degrees)
    config = JigConfig(split="single")
    (jig,) = jigs_of(wires, config)
    walls = [wall.outline for wall in jig.plan.walls]
    check_walls(wires, walls, config.inside_gap)
    # Nothing that ends between both channels is narrower than the narrowest wall, but for its tip.
    for wall in walls:
        half = config.min_wall_width / 2 - 0.01
        assert wall.difference(wall.buffer(-half).buffer(half * 1.5)).area < 0.02
    assert max(course.off_mm.max() for course in jig.plan.laid) < config.taut_tolerance


@pytest.mark.parametrize("how", ["along", "opposed", "fold"])
def test_the_plate_has_one_groove_for_both(how: str) -> None:
    config = JigConfig(numbers=False)
    wires = made("straight", how)
    (jig,) = jigs_of(wires, config)
    assert jig.plan.groove is not None
    strokes = [polygon_of(stroke, 1e-3) for stroke in jig.plan.groove.strokes]
    assert strokes
    for one, other in itertools.combinations(strokes, 2):
        assert one.distance(other) >= LEAST_WIDTH_MM
    across = shapely.LineString([(20, -3), (20, 3)])
    grooves = shapely.get_parts(across.intersection(shapely.union_all(strokes)))
    assert len([each for each in grooves if each.length > 0]) == 1


def test_a_run_is_as_far_off_as_the_one_that_it_leans_on() -> None:
    """Without any wall the inner run cuts the corner, and the outer one with it; with its wall, neither."""
    wires = made("arc", "along")
    (jig,) = jigs_of(wires, JigConfig())
    # No wall may stand anywhere.
    none = planned_walls(jig.channels, JigConfig(), shapely.box(-100, -100, 100, 100))
    outer, inner = none.laid
    assert not none.polygons
    assert inner.off_mm.max() > 2.0
    bend = (outer.at_mm > 13) & (outer.at_mm < 22)
    assert abs(outer.off_mm[bend].max() - inner.off_mm.max()) < 0.2


def test_what_lies_between_hinders_both_but_not_who_passes_over() -> None:
    wires = made("straight", "along")
    (jig,) = jigs_of(wires, JigConfig())
    metal = metal_between(jig.channels, 0)
    assert metal.area == pytest.approx(40 * (D - 0.1), rel=1e-3)
    assert not metal.intersects(jig.channels.lines[0])
    assert not metal.intersects(jig.channels.lines[1])
    (alone,) = jigs_of(wires[:1], JigConfig())
    assert metal_between(alone.channels, 0) is None


def test_a_run_alone_in_its_jig_has_its_own_walls() -> None:
    wires = made("arc", "along")
    jigs = jigs_of(wires, JigConfig(split="per-wire"))
    assert len(jigs) == 2
    for jig, wire in zip(jigs, wires, strict=True):
        assert [turn for wall in jig.plan.walls for turn in wall.turns] == list(wire.turns)


@pytest.mark.parametrize(
    ("radius", "held"), [(0.92, "pin"), (1.1, "pin"), (1.3, "pin"), (1.6, "wall"), (2.0, "wall")]
)
def test_a_hairpin_is_bent_round_a_post_or_a_pin(radius: float, held: str) -> None:
    wire = hairpin(STRAIGHT, radius)
    jigs, said = plan_jigs((wire,), JigConfig())
    (jig,) = jigs.jigs
    (bulb,) = [turn for turn in wire.turns if turn.inside == "left"]
    assert [pin.turn for pin in jig.plan.pins] == ([bulb] if held == "pin" else [])
    assert any(bulb in wall.turns for wall in jig.plan.walls) == (held == "wall")
    check_walls((wire,), [wall.outline for wall in jig.plan.walls], JigConfig().inside_gap)
    for pin in jig.plan.pins:
        apart = shapely.Point(pin.centre).distance(jig.channels.lines[0]) - pin.diameter_mm / 2
        assert apart >= jig.channels.face_mm - 0.03
    assert not [each for each in said if each.level != "note"]


def test_a_hairpin_that_nothing_fits_into_is_told() -> None:
    wire = hairpin(STRAIGHT, 0.7)
    _, said = plan_jigs((wire,), JigConfig())
    assert "weak-turn" in {each.code for each in said}


@pytest.mark.parametrize("opposed", [False, True])
def test_who_leans_loses_nothing_to_the_other(opposed: bool) -> None:
    wires = two_wires(SHAPES["arc"], opposed=opposed)
    outer, inner = support_losses(wires, JigConfig())
    assert outer.max() < 0.05  # a tail's hole may take a bit
    assert inner.max() < 0.05
    strangers = tuple(replace(wire, doubles=()) for wire in wires)
    assert support_losses(strangers, JigConfig()).max() > 0.9


def test_pegs_stand_inside_the_inner_run_alone() -> None:
    wires = two_wires(SHAPES["arc"])
    config = Config(drawing="drawing.svg", jigs=("pegs",))
    plan = place_pegs(Channels.of(wires, config.jig), config.pegs)
    asked = [*plan.unserved, *(turn for peg in plan.pegs for turn, _ in peg.turns)]
    assert asked == list(wires[1].turns)


def test_the_wall_of_a_pair_is_as_thick_as_that_of_its_inner_run_alone() -> None:
    """Room for fingers is not kept on the side where the other run lies: there the wall of both stands."""
    wires, config = two_wires(SHAPES["arc"]), JigConfig.model_validate({"room": "4 mm"})
    (pair,), (alone,) = jigs_of(wires, config), jigs_of(wires[1:], config)
    (wall,), (same,) = pair.plan.walls, alone.plan.walls
    assert wall.outline.symmetric_difference(same.outline).area < 0.05 * same.outline.area
