"""Printed jigs for wires with known answers, and for wires drawn at random."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.jig.metal import AWG18_MM, arcs, circle, config, line, only, scribble, spiral, wires_of
from wrapit.config import JigConfig
from wrapit.errors import JigError
from wrapit.geometry import Loop
from wrapit.geometry.outlines.polygons import polygon_of, region_area_mm2
from wrapit.jig.channel import Channels
from wrapit.jig.printed.plan import plan_jig
from wrapit.jig.printed.stage import build_jig
from wrapit.jig.support import stretch_support, total_support
from wrapit.jig.wall_face import plain_finding, wall_face

REACH_MM = AWG18_MM / 2 + 0.2
FACE_MM = AWG18_MM / 2 + 0.1


def test_a_straight_wire_needs_no_wall_but_by_the_papers_rule() -> None:
    assert only([line((0, 0), (60, 0))]).walls == ()
    jig = only([line((0, 0), (60, 0))], support="turns")
    (wall,) = jig.walls
    assert stretch_support(jig.support) == pytest.approx(1.0, abs=2e-3)
    assert jig.min_wall_to_wire_mm == pytest.approx(0.1, abs=1e-6)
    # The stretch runs from 3 to 57 mm; 0.2 mm from the wire would be 3.5 mm thick.
    assert region_area_mm2(wall) == pytest.approx(54 * 3.6, abs=1e-3)


def test_circle_gets_a_ring_inside() -> None:
    jig = only([circle(11)])
    (wall,) = jig.walls
    outer, inner = 11 - FACE_MM, 11 - REACH_MM - 3.5
    ring = math.pi * (outer**2 - inner**2)
    assert ring - 12 < region_area_mm2(wall) < ring  # less the start hole
    assert total_support(jig.support) > 0.92


def test_turn_tighter_than_the_wall_gets_a_solid_post() -> None:
    jig = only([arcs((0, 0), 0, (12, 0), (2.5, 180), (12, 0))])
    (wall,) = jig.walls
    assert not wall.holes
    post = polygon_of(wall, 1e-3)
    assert post.contains(shapely.Point(12, 2.5))
    for angle in np.linspace(-1.4, 1.4, 15):
        face = (12 + (2.5 - FACE_MM) * math.cos(angle), 2.5 + (2.5 - FACE_MM) * math.sin(angle))
        assert post.exterior.distance(shapely.Point(face)) < 1.5e-3
    assert total_support(jig.support) == pytest.approx(1.0)


def test_walls_of_an_s_stand_inside_each_bend() -> None:
    jig = only([arcs((0, 0), 0, (9, 180), (9, -180))])
    walls = [polygon_of(wall, 1e-2) for wall in jig.walls]
    centres = (shapely.Point(0, 9), shapely.Point(0, 27))
    assert [min(wall.distance(centre) for wall in walls) for centre in centres] == pytest.approx(
        [9 - REACH_MM - 3.5] * 2, abs=0.02
    )
    assert total_support(jig.support) > 0.95


def test_figure_eight_and_spiral_are_held() -> None:
    eight = only([arcs((0, 0), 0.5, (8, 270), (16, 0), (8, -270))])
    assert total_support(eight.support) > 0.95
    coil = only([spiral(2.6, 3)])
    assert total_support(coil.support) > 0.95


@pytest.mark.parametrize("clearance", [0.1, 0.2, 0.35])
def test_functional_faces_are_exact(clearance: float) -> None:
    settings = config(clearance=f"{clearance} mm")
    wires = wires_of([arcs((0, 0), 0, (9, 180), (5, -200), (14, 90))], settings)
    jigs, _ = build_jig(wires, settings)
    (jig,) = jigs.jigs
    channels = Channels.of(wires, settings)
    for support in jig.support:
        _, points, normals, _ = channels.stations(support.turn, 0.05)
        side = 1 if support.turn.inside == "left" else -1
        faces = shapely.union_all([polygon_of(wall, 1e-4).boundary for wall in jig.walls])
        apart = shapely.distance(shapely.points(points + side * channels.face_mm * normals), faces)
        assert np.median(apart) < 1e-3
        assert (apart < 1e-3).mean() == pytest.approx(support.share, abs=0.03)


def test_holes_are_open_and_on_the_ends() -> None:
    wires = wires_of([arcs((0, 0), 0, (20, 0), (8, 120), (20, 0))])
    jig = build_jig(wires, JigConfig())[0].jigs[0]
    assert len(jig.plan.holes) == 2
    for hole, end in zip(sorted(jig.plan.holes, key=lambda h: h.centre), wires[0].ends, strict=False):
        rim = shapely.Polygon(hole.outline.sampled(0.001))
        assert rim.area == pytest.approx(math.pi + 2 * 0.8, abs=0.01)
        assert not any(polygon_of(wall, 0.01).intersects(rim) for wall in jig.walls)
        assert any(rim.contains(shapely.Point(e)) for e in wires[0].ends), end


def test_ends_that_meet_share_a_hole() -> None:
    jig = only([line((0, 0), (30, 0)), line((0, 0), (0, 30)), line((0.9, 0.9), (22, 22))])
    shared = [hole for hole in jig.plan.holes if len(hole.wires) == 3]
    assert len(shared) == 1
    assert len(jig.plan.holes) == 4


def test_tight_turn_gets_a_pin() -> None:
    chain = arcs((0, 0), 0, (15, 0), (0.95, 180), (15, 0))
    jigs, findings = build_jig(wires_of([chain]), JigConfig())
    (pin,) = jigs.jigs[0].plan.pins
    assert pin.diameter_mm == pytest.approx(0.6)
    assert math.dist(pin.centre, (15, 0.95)) < 0.1
    assert "pin" in {finding.code for finding in findings}
    assert not build_jig(wires_of([chain]), config(pins=False, least_support=0))[0].jigs[0].plan.pins


def test_walls_rise_where_wires_cross() -> None:
    lines = [arcs((0, 0), 0, (10, 180)), line((-10, 10), (40, 10)), line((90, 0), (120, 0))]
    jig = only(lines, support="turns")
    heights = {wall.turns[0].wire: wall.height_mm for wall in jig.plan.walls}
    assert heights["wire-03"] == pytest.approx(4.0)
    assert max(wall.height_mm for wall in jig.plan.walls) == pytest.approx(3 * AWG18_MM + 1.5)
    assert jig.size_mm[2] == pytest.approx(2.4 + 3 * AWG18_MM + 1.5, abs=1e-3)


def test_numbers_are_engraved_or_missed() -> None:
    with_numbers = only([circle(11)])
    without = only([circle(11)], numbers=False)
    (label,) = with_numbers.plan.labels
    engraved = sum(region_area_mm2(stroke) for stroke in label.strokes) * label.depth_mm
    assert engraved > 0.5
    assert without.volume_mm3 - with_numbers.volume_mm3 == pytest.approx(engraved, rel=0.02)


def test_plate_must_fit_the_bed() -> None:
    with pytest.raises(JigError, match="larger than the bed"):
        only([line((0, 0), (300, 0))])
    turned = only([line((0, 0), (180, 0))], bed_width="100 mm", bed_depth="200 mm")
    assert turned.size_mm[0] > 180


def test_screw_holes_go_through_the_corners() -> None:
    plain = only([circle(10)], plate="rectangle")
    screwed = only([circle(10)], plate="rectangle", screw_hole="3 mm")
    assert len(screwed.plate.holes) == len(plain.plate.holes) + 4
    width, depth, _ = screwed.size_mm
    for hole in screwed.plan.screw_holes:
        x, y = shapely.Polygon(hole.sampled(0.01)).centroid.coords[0]
        assert abs(abs(x) - (width / 2 - 2.7)) < 0.6
        assert abs(abs(y) - (depth / 2 - 2.7)) < 0.6


def test_no_wires_no_jig() -> None:
    with pytest.raises(JigError):
        build_jig((), JigConfig())


def test_same_wires_same_plan() -> None:
    def outlines() -> list[bytes]:
        wires = wires_of([scribble(np.random.default_rng(3), 40, 9)])
        return [_bytes(wall.outer) for wall in build_jig(wires, JigConfig())[0].jigs[0].walls]

    assert outlines() == outlines()


def _bytes(loop: Loop) -> bytes:
    return loop.sampled(0.01).tobytes()


@settings(max_examples=8, deadline=None)
@given(st.integers(0, 100_000), st.booleans())
def test_any_scribbles_get_a_valid_jig(seed: int, closed: bool) -> None:
    rng = np.random.default_rng(seed)
    chains = [scribble(rng, 45, 9, closed=closed), scribble(rng, 45, 6)]
    jigs, _ = build_jig(wires_of(chains), JigConfig())
    for jig in jigs.jigs:
        assert jig.solids == 1
        assert jig.valid
        if jig.min_wall_to_wire_mm is not None:
            assert jig.min_wall_to_wire_mm > 0.1 - 1e-3
        assert all(0 <= support.share <= 1 for support in jig.support)


def test_wall_tops_are_set_back() -> None:
    settings = config(lead_in="0.4 mm", numbers=False)
    stepped, plain = (
        only([circle(11)], lead_in="0.4 mm", numbers=False),
        only([circle(11)], lead_in="0 mm", numbers=False),
    )
    (wall,) = stepped.walls
    rim = polygon_of(wall, 1e-3)
    ring_mm2 = rim.area - rim.buffer(-0.4).area
    assert plain.volume_mm3 - stepped.volume_mm3 == pytest.approx(ring_mm2 * settings.lead_in, rel=0.02)
    assert stepped.size_mm == pytest.approx(plain.size_mm, abs=1e-3)


def test_folded_outline_is_replaced_by_its_polygon(monkeypatch: pytest.MonkeyPatch) -> None:
    from wrapit.geometry.outlines.exact import Outliner

    wires = wires_of([circle(11)])
    plan, _ = plan_jig(wires, JigConfig())
    channels = Channels.of(wires, JigConfig())
    good = wall_face(channels, plan.walls[0])
    assert good.exact
    nearer = Outliner.of(channels.chains, (channels.face_mm - 0.05,), 0.06).region(plan.walls[0].outline)
    monkeypatch.setattr(Outliner, "region", lambda self, polygon: nearer)
    bad = wall_face(channels, plan.walls[0])
    assert not bad.exact
    assert bad.gap_mm > 0.1 - 1e-3
    assert region_area_mm2(bad.region) == pytest.approx(region_area_mm2(good.region), rel=1e-3)
    (finding,) = plain_finding((good, bad), "jig")
    assert finding.code == "plain-wall"
