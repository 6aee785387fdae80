"""Bails against loops worked out on paper, and the places where there is none."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely

from tests.wires.pieces import circle, drawing_of, solution_of
from wrapit.config import Config, GuideConfig
from wrapit.decomposition.model import Solution
from wrapit.errors import Finding, WireError
from wrapit.geometry import straight
from wrapit.geometry.arclength import piece
from wrapit.geometry.bspline import chain_of
from wrapit.instructions.plan import Held, plan_guide, size_mm
from wrapit.instructions.stage import write_page
from wrapit.instructions.words.speaking import Speaker
from wrapit.jig.printed.stage import build_jig
from wrapit.wires.bail_loop import EyeSize, best_eye
from wrapit.wires.jump_ring import jump_ring
from wrapit.wires.mirror import mirrored, mirrored_ring
from wrapit.wires.model import JumpRing, Wire
from wrapit.wires.stage import draw_wires

GAP_MM = 1.05  # the wire is 1 mm thick; its loop stops 0.05 mm from touching


def config(temper: str = "dead soft", **bail: object) -> Config:
    return Config.model_validate(
        {
            "drawing": "none.svg",
            "wire": {"gauge": "1 mm", "temper": temper},
            "bail": {"diameter": "5 mm", **bail},
        }
    )


def made(solution: Solution, settings: Config) -> tuple[tuple[Wire, ...], dict[str, Finding]]:
    wires, findings = draw_wires(solution, settings)
    _, placed = jump_ring(wires, solution.decomposition.drawing, settings)
    return wires, {finding.code: finding for finding in (*findings, *placed)}


def ring_of(solution: Solution, wires: tuple[Wire, ...], settings: Config) -> JumpRing | None:
    return jump_ring(wires, solution.decomposition.drawing, settings)[0]


def stroke(*points: tuple[float, float]) -> Solution:
    edges = [(i, i + 1, None) for i in range(len(points) - 1)]
    return solution_of(drawing_of(points, edges), [[(i, False) for i in range(len(edges))]])


def ring() -> Solution:
    return solution_of(drawing_of([(10, 0)], [(0, 0, circle(10))]), [[(0, False)]], closed=True)


def test_a_level_end_rolls_up_into_the_loop() -> None:
    # The end heads right, so a circle straight above it needs no neck. It stops where it is 1.05 mm over the
    # wire that it came from: cos a = 1 − 1.05 / 3, and the loop has 2π − a.
    nowhere = shapely.LineString([(500, 0), (510, 0)])
    eye = best_eye(straight((-20, 0), (0, 0)), nowhere, np.array([0.0, 1.0]), EyeSize(3.0, 1.2, 1.0))
    assert eye is not None
    assert eye.centre == pytest.approx(np.array([0, 3]))
    rest = math.acos(1 - GAP_MM / 3)
    assert eye.chain.length == pytest.approx(3 * (math.tau - rest), abs=1e-5)
    assert eye.chain.end == pytest.approx(np.array([-3 * math.sin(rest), GAP_MM]), abs=1e-5)
    downwards = best_eye(straight((0, 20), (0, 0)), nowhere, np.array([0.0, 1.0]), EyeSize(3.0, 1.2, 1.0))
    assert downwards is None, "an end that comes from outside has no room for an eye outside"


def test_an_upright_end_gets_a_neck_and_a_round_loop_above_it() -> None:
    (wire,), _ = made(stroke((0, 0), (0, 30)), config())
    assert wire.bail is not None
    assert wire.bail.centre == pytest.approx((0, 34), abs=0.3)
    eye = piece(chain_of(wire.centreline), wire.bail.start_mm, wire.length_mm)
    # Neck: 1.12 mm leave room for the narrowest wall (0.5 + 0.2 + 0.4 + 0.02).
    apart = np.linalg.norm(eye.sampled(0.01) - wire.bail.centre, axis=1)
    assert apart.min() == pytest.approx(3, abs=1e-3)  # 2.5 mm inside, and half the wire
    loop = apart < 3.001
    assert loop.mean() > 0.85
    assert wire.min_bend_radius_mm == pytest.approx(1.12, rel=1e-3)
    # The loop closes against the neck without touching it.
    line = chain_of(wire.centreline)
    tip = shapely.Point(line.end)
    before = shapely.LineString(piece(line, 0, wire.bail.start_mm + 1.5).sampled(0.01))
    assert tip.distance(before) == pytest.approx(GAP_MM, abs=1e-3)
    assert wire.layers == 1


def test_lengths_and_places_count_the_loop() -> None:
    up, down = stroke((0, 0), (0, 30)), stroke((0, 30), (0, 0))
    (first,), _ = made(up, config())
    (second,), _ = made(down, config())
    assert first.bail is not None
    assert second.bail is not None
    eye_mm = first.bail.end_mm - first.bail.start_mm
    assert first.segment_spans_mm == ((0, pytest.approx(30)),)
    assert second.segment_spans_mm == ((pytest.approx(eye_mm), pytest.approx(30 + eye_mm)),)
    assert second.bail.start_mm == 0
    for wire in (first, second):
        assert wire.length_mm == pytest.approx(30 + eye_mm, abs=1e-3)
        assert wire.cut_length_mm == pytest.approx(wire.length_mm + 50)


def test_the_jig_has_a_post_in_the_loop() -> None:
    settings = config()
    wires, _ = made(stroke((0, 0), (0, 30)), settings)
    jigs, _ = build_jig(wires, settings.jig)
    (jig,) = jigs.jigs
    assert wires[0].bail is not None
    post = shapely.Point(wires[0].bail.centre).buffer(1.0)
    assert any(wall.outline.contains(post) for wall in jig.plan.walls)
    turns = {support.turn.inside: support.share for support in jig.support}
    assert max(turns["left"], turns["right"]) > 0.85


def test_the_loop_turns_away_from_other_wires() -> None:
    drawing = drawing_of([(0, 0), (0, 30), (-9, 34.5), (9, 34.5)], [(0, 1, None), (2, 3, None)])
    wires, said = made(solution_of(drawing, [[(0, False)], [(1, False)]]), config(at=1))
    assert wires[0].bail is None
    assert "jump-ring" in said
    aside = drawing_of([(0, 0), (0, 30), (1.8, 31), (1.8, 45)], [(0, 1, None), (2, 3, None)])
    wires, _ = made(solution_of(aside, [[(0, False)], [(1, False)]]), config(at=1))
    assert wires[0].bail is not None
    assert wires[0].bail.centre[0] < -2.2, "3 mm and the thickness of the wire from the other"


def test_where_no_wire_ends_a_jump_ring_is_listed() -> None:
    wires, said = made(ring(), config())
    assert wires[0].bail is None
    found = ring_of(ring(), wires, config())
    assert found is not None
    assert found.point == pytest.approx((0, 10), abs=0.1)
    assert found.outward == pytest.approx((0, 1), abs=0.01)
    assert found.length_mm == pytest.approx(math.pi * 6)
    # Its inside is 5 mm wide; the wire in it leaves 0.05 mm: the middle is 2.5 − 0.5 − 0.05 further out.
    assert found.centre == pytest.approx((0, 11.95, 0), abs=0.1)
    assert found.free
    assert said["jump-ring"].where.endswith("10.0) mm")
    other = mirrored_ring(ring_of(ring(), wires, config(at=["-10 mm", "0 mm"])))
    assert other is not None
    assert (other.point, other.outward) == (
        pytest.approx((10, 0), abs=0.1),
        pytest.approx((1, 0), abs=0.01),
    )


def test_a_jump_ring_keeps_clear_of_a_crossing() -> None:
    # Two wires that cross at a right angle straight above the centre of gravity: one is hooked beside it.
    ends = [(-20, -20), (20, 20), (20, -20), (-20, 20)]
    crossing = solution_of(drawing_of(ends, [(0, 1, None), (2, 3, None)]), [[(0, False)], [(1, False)]])
    wires, _ = made(crossing, config(at=["0 mm", "0 mm"]))
    found = ring_of(crossing, wires, config(at=["0 mm", "0 mm"]))
    assert found is not None
    assert found.free
    assert 0.5 < math.hypot(*found.point) < 5
    tube = np.linspace(0, math.tau, 200)
    middle, out = np.array(found.centre), np.array([*found.outward, 0])
    round_it = middle + 3 * (np.outer(np.cos(tube), out) + np.outer(np.sin(tube), [0, 0, 1]))
    along = np.linspace(-20, 20, 4001)
    for wire, sign in zip(wires, (1, -1), strict=True):
        z = np.interp(np.linspace(0, wire.length_mm, 4001), *np.array(wire.lifts or [(0, 0), (60, 0)]).T)
        line = np.column_stack([along * sign, along, z])
        apart = np.linalg.norm(round_it[:, None] - line[None], axis=2)
        assert apart.min() > 1.0, "no nearer than the wires are thick"


def test_no_bail_unless_asked_for() -> None:
    solution = stroke((0, 0), (0, 30))
    plain = Config(drawing="none.svg")
    (wire,), findings = draw_wires(solution, plain)
    assert wire.bail is None
    assert ring_of(solution, (wire,), plain) is None
    assert not findings


@pytest.mark.parametrize(
    ("settings", "where", "remedy"),
    [
        (config(at=7), "bail.at", "drawing.svg"),
        (config(at=["90 mm", "0 mm"]), "bail.at", "drawing.json"),
        (config("hard", diameter="3 mm"), "bail.diameter", "4.0 mm"),
    ],
)
def test_what_cannot_be_is_refused(settings: Config, where: str, remedy: str) -> None:
    with pytest.raises(WireError) as caught:
        made(ring(), settings)
    assert caught.value.where == where
    assert remedy in caught.value.remedy


def test_the_mirrored_wire_has_its_loop_too() -> None:
    (wire,), _ = made(stroke((0, 0), (7, 30)), config(at=1))
    (other,) = mirrored((wire,))
    assert wire.bail is not None
    assert other.bail is not None
    assert other.bail.centre == (-wire.bail.centre[0], wire.bail.centre[1])


def test_the_guide_bends_the_loop_last_or_first() -> None:
    settings = config()
    for solution, last in ((stroke((0, 0), (0, 30)), True), (stroke((0, 30), (0, 0)), False)):
        wires, _ = made(solution, settings)
        guide = plan_guide(wires, GuideConfig(), settings.wire, name="pin", held=Held())
        shapes = [step for step in guide.steps if step.kind == "shape"]
        (loop,) = [step for step in shapes if any(move.kind == "bail" for move in step.moves)]
        said = [Speaker("en", "mm").say(each) for each in loop.texts]
        assert any("wrap the tail twice round the neck" in each for each in said)
        assert (loop.end_mm if last else loop.start_mm) == pytest.approx(wires[0].length_mm if last else 0)
        assert size_mm(wires)[1] == pytest.approx(30 + 1 + 7, abs=1)


def test_the_guide_shows_the_jump_ring() -> None:
    settings = config()
    wires, _ = made(ring(), settings)
    found = ring_of(ring(), wires, settings)

    def page(with_ring: JumpRing | None) -> str:
        guide = plan_guide(wires, GuideConfig(), settings.wire, name="ring", held=Held(), ring=with_ring)
        return write_page(guide, GuideConfig())

    assert 'class="ring"' in page(found)
    assert "Open the jump ring sideways" in page(found)
    assert "copper jump ring" in page(found)
    assert 'class="ring"' not in page(None)
