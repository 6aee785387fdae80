"""Seats for beads: their volumes on paper, and where there is no room for one."""

from __future__ import annotations

import math

import pytest
import shapely

from tests.jig.metal import arcs, circle, config, line, only, wires_of
from wrapit.config import Config, GuideConfig, JigConfig, WireConfig
from wrapit.errors import JigError
from wrapit.geometry.outlines.polygons import polygon_of
from wrapit.instructions.plan import Held, plan_guide
from wrapit.instructions.words.speaking import Speaker
from wrapit.jig.printed.plan import plan_jig
from wrapit.jig.printed.printed_kind import handling
from wrapit.jig.printed.seats import mirrored_seats
from wrapit.jig.printed.stage import build_jig


def seat(x: float, y: float, diameter: float, **more: str) -> dict[str, object]:
    return {"at": [f"{x} mm", f"{y} mm"], "diameter": f"{diameter} mm", **more}


def test_a_pocket_takes_its_cylinder_from_the_plate() -> None:
    bare = {"course": False, "numbers": False}
    plain, seated = only([circle(11)], **bare), only([circle(11)], **bare, seats=[seat(0, 0, 6)])
    # 6 mm and 0.2 mm of clearance all round, 1.5 mm deep.
    assert plain.volume_mm3 - seated.volume_mm3 == pytest.approx(math.pi * 3.2**2 * 1.5, abs=1e-4)
    assert seated.valid
    assert seated.solids == 1
    assert seated.size_mm == pytest.approx(plain.size_mm, abs=1e-6)
    (found,) = seated.plan.seats
    assert (found.centre, found.diameter_mm, found.bead_mm) == ((0, 0), pytest.approx(6.4), 6)


def test_a_post_rises_through_the_bead() -> None:
    bare = only([circle(11)], seats=[seat(0, 0, 6)])
    post = only([circle(11)], seats=[seat(0, 0, 6, post="1.2 mm")])
    # From the pocket's floor, 1.5 mm down, to the walls' height of 4 mm over the plate.
    assert post.volume_mm3 - bare.volume_mm3 == pytest.approx(math.pi * 0.6**2 * 5.5, abs=1e-4)
    small = only([circle(11)], seats=[seat(0, 0, 4, post="1.2 mm")])
    assert small.plan.seats[0].post_height_mm == pytest.approx(2.5), (
        "a bead of 4 mm ends 2.5 mm over the plate"
    )


def test_a_post_is_as_high_as_the_walls_of_thick_wire() -> None:
    settings = config(seats=[seat(0, 16, 20, post="1.2 mm")])
    plan, _ = plan_jig(wires_of([arcs((0, 0), 0, (16, 270))], settings, 2.0), settings)
    assert {wall.height_mm for wall in plan.walls} == {5.5}
    assert plan.seats[0].post_height_mm == 5.5


def test_walls_and_numbers_keep_off_the_pocket() -> None:
    jig = only([circle(11)], seats=[seat(5, 0, 6), seat(-14.5, 0, 4)])
    for found in jig.plan.seats:
        pocket = shapely.Point(found.centre).buffer(found.diameter_mm / 2)
        assert not any(polygon_of(wall, 1e-2).intersects(pocket) for wall in jig.walls)
        for label in jig.plan.labels:
            assert not any(polygon_of(stroke, 1e-2).intersects(pocket) for stroke in label.strokes)
        assert shapely.Polygon(jig.plate.outer.sampled(0.01)).buffer(-2.9).contains(pocket)
    assert len(jig.plate.holes) == len(jig.plan.holes) + 2


@pytest.mark.parametrize(
    ("seats", "problem", "remedy"),
    [
        # 11 − 8 = 3 mm from the wire's middle, but 3.2 + 0.512 are needed.
        ([seat(8, 0, 6)], "3.0 mm from its middle", "move it 0.7 mm away from the wire, or make it 1.4 mm"),
        ([seat(0, 0, 6), seat(6, 0, 6)], "nearer than 0.5 mm", "0.9 mm"),
        ([seat(0, 0, 6, depth="2.5 mm")], "of the plate under it", "1.6 mm"),
        ([seat(0, 0, 6, post="0.5 mm")], "post of 0.5 mm", "from 0.8 mm"),
        ([seat(0, 0, 6, post="4 mm")], "post of 4 mm", "half the bead"),
    ],
)
def test_a_seat_without_room_is_refused(seats: list[dict[str, object]], problem: str, remedy: str) -> None:
    with pytest.raises(JigError) as caught:
        only([circle(11)], seats=seats)
    assert problem in caught.value.problem
    assert remedy in caught.value.remedy
    assert caught.value.where.startswith("seat at (")


def test_a_seat_on_a_start_hole_is_refused() -> None:
    wires = wires_of([line((0, 0), (40, 0))])
    with pytest.raises(JigError, match="start hole"):
        build_jig(wires, config(seats=[seat(-3.9, 0, 6)]))
    assert build_jig(wires, config(seats=[seat(-6.5, 0, 6)]))[0].jigs[0].valid


def test_each_seat_is_in_the_jig_of_the_nearest_wire() -> None:
    wires = wires_of([circle(11), circle(11, (40, 0))])
    settings = config(split="per-wire", seats=[seat(38, 0, 6), seat(0, 0, 5)])
    jigs, _ = build_jig(wires, settings)
    assert [[found.bead_mm for found in jig.plan.seats] for jig in jigs.jigs] == [[5], [6]]
    single, _ = build_jig(wires, config(split="single", seats=[seat(38, 0, 6), seat(0, 0, 5)]))
    assert len(single.jigs[0].plan.seats) == 2


def test_seats_and_overbent_wires_exclude_one_another() -> None:
    with pytest.raises(JigError, match="overbent"):
        build_jig(wires_of([circle(11)]), config(springback="compensate", seats=[seat(0, 0, 6)]))


def test_the_mirrored_jig_has_its_seats_on_the_other_side() -> None:
    settings = config(seats=[seat(3, 4, 6)])
    assert mirrored_seats(settings).seats[0].at == (-3, 4)
    assert mirrored_seats(JigConfig()) == JigConfig()


def test_the_guide_tells_of_the_seats() -> None:
    wires = wires_of([circle(11)])
    settings = Config(drawing="x", jig=config(seats=[seat(0, 0, 6)]))
    jigs, _ = build_jig(wires, settings.jig)
    held = Held(handling(jigs, wires, settings))
    guide = plan_guide(wires, GuideConfig(), WireConfig(), name="ring", held=held)
    said = [Speaker("en", "mm").say(each).replace("\u00a0", " ") for each in guide.steps[0].texts]
    assert "Set the bead or stone (6 mm thick) into its seat." in said
    (lift,) = [step for step in guide.steps if step.kind == "lift"]
    assert "lift-beads" in {each.key for each in lift.texts}


def test_a_bead_in_the_crook_of_a_wire_leaves_the_turns_their_walls() -> None:
    chain = arcs((0, 0), 0, (20, 0), (14, 180), (20, 0))
    plain, seated = only([chain]), only([chain], seats=[seat(10, 14, 8)])
    assert [s.share for s in seated.support] == pytest.approx([s.share for s in plain.support], abs=0.01)
