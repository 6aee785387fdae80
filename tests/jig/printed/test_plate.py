"""The plate: it holds all with its margin, follows the piece, fits the bed, shows the wires' course."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.jig.metal import arcs, circle, config, line, only, scribble, wires_of
from wrapit.config import JigConfig
from wrapit.errors import JigError
from wrapit.geometry import FloatArray
from wrapit.geometry.outlines.polygons import polygon_of, region_area_mm2
from wrapit.jig.channel import Channels
from wrapit.jig.model import JigPlan
from wrapit.jig.printed.course_groove import BESIDE_MM
from wrapit.jig.printed.fitted_plate import BAY_MM, fitted_outline
from wrapit.jig.printed.plan import plan_jig
from wrapit.jig.printed.plate import RIM_MM, plate_outline
from wrapit.jig.printed.stage import build_jig
from wrapit.wires.model import Wire

CORNER = [arcs((0, 0), 0, (50, 0), (5, 90), (50, 0))]


def planned(
    wires: tuple[Wire, ...], settings: JigConfig
) -> tuple[JigPlan, shapely.Geometry, shapely.Polygon]:
    """The plan of one jig, what lies on its plate, and the plate."""
    plan, _ = plan_jig(wires, settings)
    lies = [Channels.of(wires, settings).area, *(wall.outline for wall in plan.walls)]
    lies += [shapely.Polygon(hole.outline.sampled(0.01)) for hole in plan.holes]
    lies += [shapely.Polygon(seat.pocket.sampled(0.01)) for seat in plan.seats]
    return plan, shapely.union_all(lies), polygon_of(plan.plate.outline, 1e-3)


def radii(plate: shapely.Polygon) -> FloatArray:
    """Signed radii (n,) of the plate's rim where it runs round 1 mm: positive where it is convex."""
    ring = shapely.geometry.polygon.orient(plate).exterior
    count = math.ceil(ring.length)
    points = shapely.get_coordinates(
        shapely.line_interpolate_point(ring, np.arange(count) * ring.length / count)
    )
    along = np.roll(points, -1, axis=0) - points
    heading = np.arctan2(along[:, 1], along[:, 0])
    turn = (np.roll(heading, -1) - heading + np.pi) % (2 * np.pi) - np.pi
    return ring.length / count / np.where(np.abs(turn) < 1e-6, 1e-6, turn)


@settings(max_examples=15, deadline=None)
@given(
    st.integers(0, 100_000),
    st.sampled_from([0.1, 1.0, 4.0, 9.0]),
    st.sampled_from([0.0, 3.0, 8.0]),
    st.sampled_from([0.0, 3.0]),
)
def test_any_fitted_plate_holds_all_with_its_margin(
    seed: int, margin: float, corner: float, screw: float
) -> None:
    rng = np.random.default_rng(seed)
    asked = config(
        margin=f"{margin} mm",
        corner_radius=f"{corner} mm",
        screw_hole=f"{screw} mm",
        course=False,
        numbers=False,
    )
    wires = wires_of([scribble(rng, 45, 9), scribble(rng, 30, 6)], asked)
    plan, lies, plate = planned(wires, asked)
    assert plate.is_valid
    assert not plan.plate.outline.holes
    assert plate.contains(lies)
    assert plate.exterior.distance(lies) > margin - 0.01
    assert radii(plate)[radii(plate) > 0].min() > 0.95 * max(corner, margin, 1.0)
    assert -radii(plate)[radii(plate) < 0].max() > 0.9 * BAY_MM - 1.5
    screws = [shapely.Polygon(hole.sampled(0.01)) for hole in plan.screw_holes]
    assert len(screws) == (4 if screw else 0)
    for index, hole in enumerate(screws):
        assert plate.exterior.distance(hole) > RIM_MM - 0.02
        assert lies.distance(hole) > RIM_MM - 0.02
        assert all(hole.distance(other) > RIM_MM - 0.1 for other in screws[:index])


def test_a_fitted_plate_is_smaller_than_its_box() -> None:
    wires = wires_of(CORNER)
    (_, _, fitted), (_, _, boxed) = (planned(wires, config(plate=kind)) for kind in ("fitted", "rectangle"))
    assert fitted.area < 0.6 * boxed.area
    assert fitted.bounds == pytest.approx(boxed.bounds, abs=0.3)


def test_parts_that_lie_apart_share_one_plate() -> None:
    discs = shapely.union_all([shapely.Point(x, y).buffer(3) for x, y in ((0, 0), (70, 0), (0, 200))])
    plate = shapely.Polygon(fitted_outline(discs, 4.0, 3.0).sampled(0.01))
    assert plate.is_valid
    assert plate.contains(discs.buffer(3.99))
    assert plate.buffer(-1.9).geom_type == "Polygon"


def test_a_frame_of_wire_has_no_hole_in_its_plate() -> None:
    wires = wires_of([circle(30)])
    _, _, plate = planned(wires, JigConfig())
    assert plate.contains(shapely.Point(0, 0))


@pytest.mark.parametrize("screw_mm", [3.0, 20.0])
def test_screws_find_room_round_the_smallest_piece(screw_mm: float) -> None:
    outline, screws = plate_outline(shapely.Point(0, 0).buffer(1), config(screw_hole=f"{screw_mm} mm"), "jig")
    plate = shapely.Polygon(outline.sampled(0.01))
    holes = [shapely.Polygon(screw.sampled(0.01)) for screw in screws]
    assert len(holes) == 4
    assert plate.buffer(0.02 - RIM_MM).contains(shapely.union_all(holes))
    assert shapely.union_all(holes).area == pytest.approx(4 * math.pi * screw_mm**2 / 4, rel=0.01)


@pytest.mark.parametrize("kind", ["fitted", "rectangle"])
def test_a_plate_larger_than_the_bed_is_refused(kind: str) -> None:
    covered = shapely.box(0, 0, 100, 30)
    plate_outline(covered, config(plate=kind, bed_width="39 mm", bed_depth="109 mm"), "jig")
    with pytest.raises(JigError, match="larger than the bed"):
        plate_outline(covered, config(plate=kind, bed_width="35 mm", bed_depth="109 mm"), "jig")


def test_a_plate_has_few_long_sides() -> None:
    from wrapit.jig.printed.solid import RIM_SLACK_MM
    from wrapit.kernel.edges import followed

    plan, _, _ = planned(wires_of(CORNER), JigConfig())
    assert len(followed(plan.plate.outline.outer, RIM_SLACK_MM).parts) < 16


@settings(max_examples=6, deadline=None)
@given(st.integers(0, 100_000), st.booleans())
def test_any_course_is_under_its_wires_and_clear_of_all_else(seed: int, closed: bool) -> None:
    rng = np.random.default_rng(seed)
    wires = wires_of([scribble(rng, 45, 9, closed=closed), scribble(rng, 45, 6)])
    plan, _, plate = planned(wires, JigConfig())
    assert plan.groove is not None
    strokes = [polygon_of(stroke, 1e-3) for stroke in plan.groove.strokes]
    grooves = shapely.union_all(strokes)
    assert sum(stroke.area for stroke in strokes) == pytest.approx(grooves.area)
    channels = Channels.of(wires, JigConfig())
    lines = shapely.union_all(channels.lines)
    assert lines.buffer(1.3).contains(grooves)
    walls = shapely.union_all([wall.outline for wall in plan.walls])
    taken = [walls]
    taken += [shapely.Polygon(hole.outline.sampled(0.01)) for hole in plan.holes]
    taken += [polygon_of(stroke, 0.01) for label in plan.labels for stroke in label.strokes]
    free = lines.difference(shapely.union_all(taken).buffer(0.4))
    free = free.difference(walls.buffer(channels.reach_mm + BESIDE_MM))  # where no wall shows the way
    free = shapely.union_all([part for part in shapely.get_parts(free) if part.length > 1.5])
    assert grooves.buffer(0.05).intersection(free).length > 0.9 * free.length
    assert grooves.distance(shapely.union_all(taken)) > 0.1
    assert plate.contains(grooves)


@settings(max_examples=4, deadline=None)
@given(st.integers(0, 100_000), st.sampled_from(["fitted", "rectangle"]))
def test_any_jig_with_its_course_is_sound(seed: int, kind: str) -> None:
    rng = np.random.default_rng(seed)
    chains = [scribble(rng, 45, 9, closed=True), scribble(rng, 45, 6)]
    asked = config(plate=kind, least_support=0)
    jigs, findings = build_jig(wires_of(chains, asked), asked)
    assert all(jig.valid and jig.solids == 1 for jig in jigs.jigs)
    assert "no-course" not in {finding.code for finding in findings}


def test_the_course_is_engraved_as_deep_as_it_says() -> None:
    marked, bare = only(CORNER), only(CORNER, course=False)
    assert bare.plan.groove is None
    assert marked.plan.groove is not None
    engraved = sum(map(region_area_mm2, marked.plan.groove.strokes)) * marked.plan.groove.depth_mm
    assert engraved > 0.9 * 0.6 * 95 * 0.4
    assert bare.volume_mm3 - marked.volume_mm3 == pytest.approx(engraved, rel=0.02)


def test_an_arrow_head_shows_where_a_wire_starts() -> None:
    plan, _, _ = planned(wires_of([line((0, 0), (60, 0))]), JigConfig())
    assert plan.groove is not None
    groove = shapely.union_all([polygon_of(stroke, 1e-3) for stroke in plan.groove.strokes])
    _, low, _, high = groove.bounds
    wide = [
        groove.intersection(shapely.LineString([(x, low), (x, high)])).length
        for x in np.arange(1.0, 59.0, 0.1)
    ]
    head = 1.0 + 0.1 * int(np.argmax(wide))
    assert max(wide) > 1.0
    assert head < 12
    # Its back is the widest, and it narrows forwards.
    assert wide[int(np.argmax(wide)) + 5] < 0.8 * max(wide)


def test_thin_wire_has_no_groove_to_sink_into() -> None:
    for diameter, has in ((0.6, False), (0.7, True)):
        wires = wires_of(CORNER, diameter_mm=diameter)
        plan, _, _ = planned(wires, JigConfig())
        assert (plan.groove is not None) == has
