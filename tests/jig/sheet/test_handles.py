"""Wall pieces too small for fingers grow at their backs, and those without room are named."""

from __future__ import annotations

import re

import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.jig.metal import arcs, wires_of
from tests.jig.sheet.laser import JIG, laser_of
from wrapit.config import PlateConfig
from wrapit.jig.channel import Channels
from wrapit.jig.sheet.checks import THIN_WEB_MM
from wrapit.jig.sheet.handles import FRONT_MM, STRIP_MM, joined, length_mm, with_handles
from wrapit.jig.sheet.inlays import polygon_of

LONG_MM, WIDTH_MM, WEB_MM = 8.0, 2.0, 1.6
# Rounded ground is polygons of 16 sides a quarter, up to 5 mm large.
ROUND_MM = 0.02
NOTHING = shapely.Polygon()
numbers = st.floats(2.2, 7.0)


@given(numbers, numbers, st.floats(0, 180), st.floats(1.0, 12.0), st.floats(0.5, 6.0), st.floats(0.0, 20.0))
@settings(deadline=None, max_examples=60)
def test_what_grows_keeps_off_all_that_is_kept_free(
    wide: float, deep: float, turned: float, hole_at: float, room: float, other_at: float
) -> None:
    def placed(shape: shapely.Geometry) -> shapely.Geometry:
        return shapely.affinity.rotate(shape, turned, origin=(0, 0))

    wall = placed(shapely.box(-wide / 2, 0, wide / 2, deep))
    wire = placed(shapely.LineString([(-40, -0.7), (40, -0.7)]).buffer(0.7))
    hole = placed(shapely.Point(3, deep + hole_at).buffer(1))
    front = wire.buffer(room).union(placed(shapely.box(wide / 2, 0, 40, 2)))
    other = placed(shapely.box(-12 - other_at, 0, -wide / 2 - WEB_MM - other_at, 5))
    kept = wire.union(hole.buffer(WEB_MM))
    if kept.intersects(shapely.buffer(wall, -0.01)):
        return
    grown, left = with_handles([wall, other], kept, front, WIDTH_MM, LONG_MM, WEB_MM)
    assert isinstance(grown, shapely.Polygon)
    assert grown.is_valid
    assert not grown.interiors
    assert wall.difference(grown).area < 1e-9
    assert length_mm(grown) >= length_mm(wall) - 1e-9
    assert grown.intersection(kept).area < 1e-6
    assert min(grown.distance(left), wall.distance(left)) >= min(WEB_MM, wall.distance(other)) - ROUND_MM
    # Nowhere is it narrower than sheet allows, but for what the planned wall is.
    opened = grown.buffer(-WIDTH_MM / 2 + ROUND_MM).buffer(WIDTH_MM / 2 * 2**0.5)
    assert grown.difference(opened.union(wall)).area < 0.02
    # Room for fingers is taken by no more than a hollow's rounding.
    assert grown.difference(wall).intersection(front).area < 2 * (1 - 3.141 / 4) * 1.0 + 0.05


@given(numbers, numbers, st.floats(0, 180))
@settings(deadline=None, max_examples=30)
def test_where_there_is_ground_every_piece_gets_its_handle_and_not_much_more(
    wide: float, deep: float, turned: float
) -> None:
    wall = shapely.affinity.rotate(shapely.box(-wide / 2, 0, wide / 2, deep), turned, origin=(0, 0))
    (grown,) = with_handles([wall], NOTHING, NOTHING, WIDTH_MM, LONG_MM, WEB_MM)
    assert max(LONG_MM, length_mm(wall)) <= length_mm(grown) <= max(LONG_MM + 1.1, length_mm(wall))


def test_long_pieces_and_those_without_room_stay_as_they_are() -> None:
    long, small = shapely.box(0, 0, 9, 2), shapely.box(20, 0, 23, 3)
    cage = shapely.box(15, -5, 28, 8).difference(small)
    assert with_handles([long, small], cage, NOTHING, WIDTH_MM, LONG_MM, WEB_MM) == [long, small]


def test_no_wall_grows_around_a_hole() -> None:
    # Round the hole and back would be the shortest way to be large.
    wall, hole = shapely.box(-1.5, 0, 1.5, 3), shapely.Point(0, 5.2).buffer(1)
    (grown,) = with_handles([wall], hole, NOTHING, WIDTH_MM, 14.0, WEB_MM)
    assert not grown.interiors
    assert grown.area > wall.area


def test_small_walls_of_a_jig_get_handles_and_hold_as_well() -> None:
    # So gentle a bow that a wire pulled tight needs no more than three short pieces of wall.
    wires = wires_of([arcs((0, 0), 0, (5, 0), (160, 20), (5, 0))])
    bare, _ = laser_of(wires, PlateConfig(handle="0 mm"))
    handy, findings = laser_of(wires, PlateConfig())
    pieces = [[polygon_of(p.shape) for p in laser.parts if p.role == "wall"] for laser in (bare, handy)]
    assert len(pieces[0]) == len(pieces[1])
    assert min(map(length_mm, pieces[0])) < 5
    assert min(map(length_mm, pieces[1])) >= LONG_MM
    channels = Channels.of(wires, JIG)
    for small, large in zip(*pieces, strict=True):
        assert small.difference(large).area < 0.02
        near = channels.area.buffer(FRONT_MM - 1.05)
        assert large.difference(small.buffer(0.02)).intersection(near).area < 0.05
    assert not [f for f in findings if f.level in ("error", "warning")]
    assert "small-piece" not in {f.code for f in findings}
    assert handy.checks.min_web_mm is not None
    assert handy.checks.min_web_mm >= THIN_WEB_MM


def test_a_piece_without_room_is_named_with_its_number_and_size() -> None:
    # Inside a narrow turn there is no ground for a handle as long as this.
    narrow = wires_of([arcs((0, 0), 0, (25, 0), (3.2, 180), (25, 0))])
    laser, findings = laser_of(narrow, PlateConfig(handle="40 mm"))
    (said,) = [finding for finding in findings if finding.code == "small-piece"]
    labels = re.findall(r"part (\S+) at", said.where)
    walls = {part.label: polygon_of(part.shape) for part in laser.parts if part.role == "wall"}
    small = {label for label, piece in walls.items() if length_mm(piece) < 40}
    assert set(labels) | {label for label in small if label in said.message} == small
    assert min(walls, key=lambda label: length_mm(walls[label])) == labels[0]
    assert f"{length_mm(walls[labels[0]]):.1f} mm" in said.message
    assert "tweezers" in said.remedy


places = st.tuples(
    st.floats(-20, 20), st.floats(-20, 20), st.floats(1.5, 5), st.floats(1.5, 5), st.floats(0, 180)
)


@given(st.lists(places, min_size=2, max_size=6), st.lists(st.tuples(*[st.floats(-20, 20)] * 4), max_size=4))
@settings(deadline=None, max_examples=80)
def test_joined_walls_are_the_same_walls_with_strips_where_nothing_is_kept_free(
    boxes: list[tuple[float, ...]], wires: list[tuple[float, ...]]
) -> None:
    lines = [shapely.LineString([wire[:2], wire[2:]]).buffer(0.7) for wire in wires]
    barred = shapely.union_all([shapely.box(90, 90, 91, 91), *lines])
    walls: list[shapely.Polygon] = []
    for x, y, half_wide, half_deep, turned in boxes:
        box = shapely.affinity.rotate(
            shapely.box(x - half_wide, y - half_deep, x + half_wide, y + half_deep), turned
        )
        if not box.intersects(barred) and all(box.distance(wall) > 0.1 for wall in walls):
            walls.append(box)
    if not walls:
        return
    pieces = joined([(wall, (index,)) for index, wall in enumerate(walls)], barred, WIDTH_MM, WEB_MM)
    # Each wall is in one piece, whole, and each piece knows whose spans it holds.
    assert sorted(index for _, mine in pieces for index in mine) == list(range(len(walls)))
    for piece, mine in pieces:
        assert isinstance(piece, shapely.Polygon)
        assert piece.is_valid
        assert not piece.interiors
        bare = shapely.union_all([walls[index] for index in mine])
        added = piece.difference(bare.buffer(1e-6))
        assert bare.difference(piece).area < 1e-6
        assert added.intersection(barred).area < 1e-6
        assert added.area <= (len(mine) - 1) * (STRIP_MM + 2) * WIDTH_MM
        # As wide as sheet must be, wherever it was joined.
        cores = shapely.get_parts(piece.buffer(0.03 - WIDTH_MM / 2))
        assert len(cores) == 1
    before = shapely.union_all(walls)
    for first, (piece, _) in enumerate(pieces):
        for other, _ in pieces[:first]:
            assert piece.distance(other) >= min(WEB_MM, least_distance(before)) - ROUND_MM


def least_distance(walls: shapely.Geometry) -> float:
    parts = shapely.get_parts(walls)
    return min((a.distance(b) for i, a in enumerate(parts) for b in parts[:i]), default=float("inf"))


def test_neighbours_are_joined_over_the_shortest_way_that_is_free() -> None:
    left, right, far = shapely.box(0, 0, 4, 4), shapely.box(8, 0, 12, 4), shapely.box(8, 30, 12, 34)
    (both, spans), (alone, _) = joined([(left, ("a",)), (right, ("b",)), (far, ("c",))], NOTHING, 2.0, 1.6)
    assert spans == ("a", "b")
    assert both.area == pytest.approx(16 + 16 + 4 * 2, abs=0.01)
    assert alone is far
    # A wire between them parts them; so does one that runs by too near for a strip of that width.
    for barred in (shapely.box(5, -50, 6, 50), shapely.box(4.5, 1, 7.5, 3)):
        assert len(joined([(left, ()), (right, ())], barred, 2.0, 1.6)) == 2


def test_no_ring_is_closed() -> None:
    # Four walls round a middle: three strips join them, the fourth would leave plate inside.
    walls = [(shapely.box(x - 2, y - 2, x + 2, y + 2), ()) for x, y in ((-5, -5), (5, -5), (5, 5), (-5, 5))]
    ((piece, _),) = joined(walls, NOTHING, 2.0, 1.6)
    assert not piece.interiors


def test_a_wire_that_strays_is_said_of_the_laser_cut_jig_too() -> None:
    # Two wires side by side leave no ground for a wall between them.
    hairpins = ((0, 0), 0, (15, 0), (3.2, 180), (15, 0)), ((0, 1.6), 0, (15, 0), (1.6, 180), (15, 0))
    wires = wires_of([arcs(*hairpin) for hairpin in hairpins])
    _, findings = laser_of(wires, PlateConfig())
    strays = [finding for finding in findings if finding.code == "strays"]
    assert strays
    assert all(finding.where.startswith("laser-cut jig, wire-") for finding in strays)
