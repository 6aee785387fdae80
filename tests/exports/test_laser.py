"""The laser-cut jig, read back from its DXF, is the jig that was planned."""

from __future__ import annotations

import itertools
from collections.abc import Callable
from pathlib import Path

import ezdxf
import ezdxf.path
import numpy as np
import pytest
import shapely
from shapely import LinearRing, LineString, Polygon

from tests.exports.pieces_for_tests import eye, hairpin, spiral, woven
from tests.jig.metal import line, wires_of
from wrapit.config import JigConfig, PlateConfig
from wrapit.errors import Finding, JigError
from wrapit.exports.flat_files import write_flat_files
from wrapit.geometry import Loop, Region
from wrapit.geometry.bspline import chain_of
from wrapit.geometry.outlines.loops import rounded_rectangle
from wrapit.jig.sheet.drawings import GAP_MM, sheet_drawings, sheet_name
from wrapit.jig.sheet.engraving import wire_numbers
from wrapit.jig.sheet.inlays import polygon_of
from wrapit.jig.sheet.model import LaserJig, LaserPart, Placed
from wrapit.jig.sheet.nesting import nest
from wrapit.jig.sheet.parts import copies_needed
from wrapit.jig.sheet.stage import build_laser_jig, kept_apart, laser_jig, plan_stack
from wrapit.wires.model import Wire

JIG = JigConfig()
PIECES: dict[str, Callable[[], tuple[Wire, ...]]] = {
    "eye": lambda: eye()[1],
    "hairpin": hairpin,
    "spiral": spiral,
    "woven": lambda: woven(4),
}


def write_plate(folder: Path, laser: LaserJig, config: PlateConfig) -> None:
    for drawing in sheet_drawings(laser):
        write_flat_files(folder, drawing, config, ("dxf", "svg"))


def laser_of(
    wires: tuple[Wire, ...], config: PlateConfig, *, split: bool = False
) -> tuple[LaserJig, tuple[Finding, ...]]:
    groups = [(wire.name,) for wire in wires] if split else [tuple(wire.name for wire in wires)]
    plans, findings = {}, []
    for names in groups:
        mine = tuple(wire for wire in wires if wire.name in names)
        plans[f"jig-{names[0]}"], more = plan_stack(mine, JIG, config)
        findings += more
    laser, more = laser_jig(plans, JIG, config)
    return laser, (*findings, *more)


def read(path: Path) -> dict[str, list[LinearRing]]:
    """Closed cuts of a DXF by layer, straight from the entities."""
    document = ezdxf.readfile(path)
    assert not document.audit().errors
    rings: dict[str, list[LinearRing]] = {"CUT_INNER": [], "CUT_OUTER": []}
    for entity in document.modelspace():
        if entity.dxf.layer in rings:
            outline = ezdxf.path.make_path(entity)
            assert outline.start.isclose(outline.end, abs_tol=1e-12)
            rings[entity.dxf.layer].append(LinearRing([(p.x, p.y) for p in outline.flattening(2e-4)]))
    return rings


def cut_polygon(placed: Placed, rings: dict[str, list[LinearRing]]) -> Polygon:
    """The outer cut of a placed part, less its inner cuts, among the rings of its sheet."""
    planned = next(c for c in placed.contours if c.layer == "CUT_OUTER")
    centre = Polygon(Loop(planned.edges).sampled(0.01)).centroid
    outer = min(rings["CUT_OUTER"], key=lambda ring: Polygon(ring).centroid.distance(centre))
    whole = Polygon(outer)
    inner = [ring for ring in rings["CUT_INNER"] if whole.contains(ring)]
    return Polygon(outer.coords, [ring.coords for ring in inner])


def moved_polygon(part: LaserPart, placed: Placed) -> Polygon:
    turned = shapely.affinity.rotate(polygon_of(part.shape), 90 * placed.quarters, origin=(0, 0))
    return shapely.affinity.translate(turned, *placed.shift)


CASES = [
    ("eye", {}),
    ("eye", {"kerf": 0.4, "fit": 0.1, "sheet": 6.0, "wall_sheet": 10.0}),
    ("hairpin", {"kerf": 0.1, "sheet": 2.0, "fit": 0.0}),
    ("spiral", {}),
    ("woven", {"sheet_width": 600.0, "sheet_height": 300.0}),
]


@pytest.fixture(scope="module", params=CASES, ids=lambda case: f"{case[0]}-{len(case[1])}")
def cut(
    request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory
) -> tuple[tuple[Wire, ...], PlateConfig, LaserJig, tuple[Finding, ...], Path]:
    name, changes = request.param
    wires, config = PIECES[name](), PlateConfig.model_construct(**{**PlateConfig().__dict__, **changes})
    laser, findings = laser_of(wires, config)
    folder = tmp_path_factory.mktemp(name)
    write_plate(folder, laser, config)
    return wires, config, laser, findings, folder


Cut = tuple[tuple[Wire, ...], PlateConfig, LaserJig, tuple[Finding, ...], Path]


def test_sheets_read_back_have_the_parts_grown_by_half_a_kerf(cut: Cut) -> None:
    _, config, laser, _, folder = cut
    for sheet in laser.sheets:
        rings = read(folder / f"{sheet_name(sheet) if len(laser.sheets) > 1 else 'plate'}.dxf")
        assert len(rings["CUT_OUTER"]) == len(sheet.placed)
        for placed in sheet.placed:
            found = cut_polygon(placed, rings)
            expected = moved_polygon(placed.part, placed).buffer(config.kerf / 2, quad_segs=64)
            assert found.area == pytest.approx(expected.area, rel=1e-3)
            assert found.symmetric_difference(expected).area < 2e-3 * expected.length
            # What remains when the laser has taken its kerf is the finished part.
            left = found.buffer(-config.kerf / 2, quad_segs=64)
            finished_part = moved_polygon(placed.part, placed)
            assert left.symmetric_difference(finished_part).area < 3e-3 * finished_part.length


def test_nothing_crosses_or_is_drawn_twice(cut: Cut) -> None:
    _, _, laser, findings, folder = cut
    rings = [ring for layer in read(folder / "plate.dxf").values() for ring in layer]
    assert len(rings) == laser.checks.closed_contours
    assert all(ring.is_simple for ring in rings)
    tree = shapely.STRtree(rings)
    pairs = [(a, b) for a, b in tree.query(rings, predicate="intersects").T if a < b]
    assert pairs == []
    assert not {finding.code for finding in findings} & {"open-cut", "crossing-cut"}
    nearest = min(
        rings[a].distance(rings[b])
        for a, b in tree.query(rings, predicate="dwithin", distance=5.0).T
        if a < b
    )
    assert nearest == pytest.approx(laser.checks.min_cut_distance_mm, abs=2e-3)


def test_length_is_the_sum_of_what_is_read(cut: Cut) -> None:
    *_, laser, _, folder = cut
    rings = [ring for layer in read(folder / "plate.dxf").values() for ring in layer]
    # Flattened curves are a little shorter than the true ones.
    assert sum(ring.length for ring in rings) == pytest.approx(laser.checks.cut_length_mm, rel=5e-5)


def test_parts_lie_on_their_sheets_and_apart(cut: Cut) -> None:
    _, config, laser, _, folder = cut
    for sheet in laser.sheets:
        outer = [Polygon(ring) for ring in read_sheet(folder, laser, sheet)["CUT_OUTER"]]
        left, bottom, right, top = shapely.union_all(outer).bounds
        assert left >= config.spacing - 1e-3
        assert bottom >= config.spacing - 1e-3
        assert right <= sheet.width_mm - config.spacing + 1e-3
        assert top <= sheet.height_mm - config.spacing + 1e-3
        for a, b in itertools.combinations(outer, 2):
            assert a.distance(b) >= config.spacing - 0.02
        assert len({placed.part.thickness_mm for placed in sheet.placed}) == 1


def read_sheet(folder: Path, laser: LaserJig, sheet: object) -> dict[str, list[LinearRing]]:
    return read(folder / f"{sheet_name(sheet) if len(laser.sheets) > 1 else 'plate'}.dxf")


def test_pocket_minus_piece_is_the_fit_all_around(cut: Cut) -> None:
    _, config, laser, _, _ = cut
    plates = [part for part in laser.parts if part.role in ("pocket plate", "island")]
    material = shapely.union_all([finished(part, config.kerf) for part in plates])
    edge = material.boundary
    shapely.prepare(edge)
    for part in laser.parts:
        if part.role == "wall":
            outline = finished(part, config.kerf).exterior.segmentize(0.3)
            points = shapely.points(outline.coords[:])
            overlap = shapely.intersects_xy(material, *outline.coords.xy)
            gaps = np.where(overlap, -1.0, 1.0) * shapely.distance(edge, points)
            assert gaps.min() > config.fit - 0.01
            assert gaps.max() < config.fit + 0.01
            assert np.median(gaps) == pytest.approx(config.fit, abs=1e-3)


def finished(part: LaserPart, kerf_mm: float) -> Polygon:
    """The part after cutting: the drawn cuts less half a kerf."""
    cuts = {layer: [c for c in part.contours if c.layer == layer] for layer in ("CUT_OUTER", "CUT_INNER")}
    (outer,) = cuts["CUT_OUTER"]
    drawn = Polygon(
        Loop(outer.edges).sampled(0.005), [Loop(c.edges).sampled(0.005) for c in cuts["CUT_INNER"]]
    )
    return drawn.buffer(-kerf_mm / 2, quad_segs=16).simplify(2e-4)


def test_assembled_walls_hold_the_wires_at_radius_and_clearance(cut: Cut) -> None:
    wires, config, laser, _, _ = cut
    walls = shapely.union_all([finished(part, config.kerf) for part in laser.parts if part.role == "wall"])
    reach = wires[0].diameter_mm / 2 + JIG.clearance
    lines = [LineString(chain_of(wire.centreline).sampled(0.02)) for wire in wires]
    gap = min(line.distance(walls) for line in lines)
    assert gap == pytest.approx(reach, abs=0.01)


def test_engraving_stays_on_the_plates(cut: Cut) -> None:
    _, _, laser, _, _ = cut
    for part in laser.parts:
        if part.role == "wall":
            continue
        shape = polygon_of(part.shape)
        for contour in part.contours:
            if not contour.is_cut and part.role != "bottom":
                line = LineString(np.vstack([edge.sampled(0.05) for edge in contour.edges]))
                assert shape.contains(line), (part.label, line)


def test_files_of_several_sheets_lie_side_by_side(cut: Cut) -> None:
    *_, laser, _, folder = cut
    whole = read(folder / "plate.dxf")
    left = 0.0
    total = 0
    for sheet in laser.sheets:
        alone = read_sheet(folder, laser, sheet)
        for layer, rings in alone.items():
            for ring in rings:
                shifted = shapely.affinity.translate(ring, left if len(laser.sheets) > 1 else 0.0)
                assert any(same(shifted, other) for other in whole[layer])
                total += 1
        left += sheet.width_mm + GAP_MM
    assert total == sum(map(len, whole.values()))


def same(one: LinearRing, other: LinearRing) -> bool:
    return one.centroid.distance(other.centroid) < 1e-3 and abs(one.length - other.length) < 1e-3


def test_numbers_are_unique_and_pins_fix_the_plates() -> None:
    laser, _ = laser_of(eye()[1], PlateConfig())
    labels = [part.label for part in laser.parts]
    assert len(set(labels)) == len(labels)
    bottom, plate = (next(p for p in laser.parts if p.role == role) for role in ("bottom", "pocket plate"))
    assert polygon_of(bottom.shape).convex_hull.equals_exact(polygon_of(plate.shape).convex_hull, 1e-9)
    holes = [Polygon(hole.sampled(1e-5)) for hole in bottom.shape.holes]
    through = [Polygon(hole.sampled(1e-5)) for hole in plate.shape.holes]
    assert all(any(hole.equals_exact(other, 1e-9) for other in through) for hole in holes)
    pins = [hole for hole in holes if hole.area == pytest.approx(np.pi, rel=1e-3)]
    assert len(pins) >= 3


def test_wires_of_their_own_get_stacks_of_their_own() -> None:
    wires = eye()[1]
    laser, _ = laser_of(wires, PlateConfig(), split=True)
    assert [part.label for part in laser.parts if part.role == "bottom"] == ["1.B", "2.B"]
    assert {part.jig for part in laser.parts} == {"jig-wire-01", "jig-wire-02"}


def test_a_wire_without_turns_gets_plates_without_walls() -> None:
    laser, findings = laser_of(wires_of([line((0, 0), (12, 0))]), PlateConfig())
    assert {part.role for part in laser.parts} == {"bottom", "pocket plate"}
    assert not [finding for finding in findings if finding.level == "error"]


def test_a_kerf_that_swallows_walls_is_a_finding_not_a_broken_contour() -> None:
    config = PlateConfig(kerf="4.5 mm", spacing="6 mm", pin="6 mm")
    laser, findings = laser_of(eye()[1], config)
    assert "kerf-too-wide" in {finding.code for finding in findings}
    for part in laser.parts:
        for contour in part.contours:
            assert not contour.is_cut or contour.closed
    holes = [finding for finding in findings if "a hole of" in finding.message]
    assert len(holes) == 3  # where the wires start and end, one of them twice; pins are thick enough
    swallowed = [finding for finding in findings if finding.code == "kerf-too-wide"]
    assert all("at (" in finding.where and finding.remedy for finding in swallowed)


def test_a_part_larger_than_the_sheet_is_an_error_with_its_size() -> None:
    laser, findings = laser_of(eye()[1], PlateConfig(sheet_width="60 mm", sheet_height="60 mm"))
    (first, *_) = [finding for finding in findings if finding.code == "larger-than-sheet"]
    assert first.level == "error"
    assert "60 × 60" in first.message
    assert {placed.part.label for sheet in laser.sheets for placed in sheet.placed} == {
        part.label for part in laser.parts
    }


def test_small_sheets_need_several() -> None:
    parts = laser_of(spiral(), PlateConfig())[0].parts
    one, _ = nest(parts, PlateConfig(sheet_width="400 mm", sheet_height="300 mm"))
    many, findings = nest(parts, PlateConfig(sheet_width="75 mm", sheet_height="75 mm"))
    assert not findings
    assert len(many) > len(one) == 2
    labels = [
        sorted(placed.part.label for sheet in sheets for placed in sheet.placed) for sheets in (one, many)
    ]
    assert labels[0] == labels[1] == sorted(part.label for part in parts)


def test_thin_wall_sheet_is_stacked_and_said_so() -> None:
    assert copies_needed(1, 1.0, PlateConfig()) == 1
    assert copies_needed(1, 1.0, PlateConfig(wall_sheet="3 mm")) == 2
    assert copies_needed(4, 1.0, PlateConfig()) == 2
    laser, findings = laser_of(hairpin(), PlateConfig(wall_sheet="3 mm"))
    walls = [part for part in laser.parts if part.role == "wall"]
    assert all(part.copies == 2 for part in walls)
    assert sum(p.part.role == "wall" for s in laser.sheets for p in s.placed) == 2 * len(walls)
    assert "stacked-walls" in {finding.code for finding in findings}
    assert laser.wall_height_mm == pytest.approx(3.0)


def test_sheets_of_different_thickness_say_which_they_are() -> None:
    laser, _ = laser_of(hairpin(), PlateConfig())
    assert [sheet.thickness_mm for sheet in laser.sheets] == [3.0, 6.0]
    three, six = (sheet.marks for sheet in laser.sheets)
    assert three
    assert len(three) != len(six) or any(a.edges != b.edges for a, b in zip(three, six, strict=True))
    same, _ = laser_of(hairpin(), PlateConfig(wall_sheet="3 mm"))
    assert all(not sheet.marks for sheet in same.sheets)


def test_of_two_walls_that_nearly_touch_the_smaller_is_cut_back() -> None:
    large, small, far = shapely.box(0, 0, 10, 4), shapely.box(10.1, 0, 15, 4), shapely.box(20, 0, 22, 4)
    first, second, third = kept_apart([large, small, far], 0.9)
    assert first.equals(large)
    assert third.equals(far)
    assert second.distance(first) == pytest.approx(0.9, abs=1e-6)
    assert second.area == pytest.approx(4 * 4.1, abs=0.01)


def test_wire_numbers_are_engraved_where_there_is_room() -> None:
    wires = woven(4)
    plate = Region(rounded_rectangle(-20, -20, 60, 60, 0))
    strokes, left = wire_numbers(wires, plate)
    assert strokes
    assert not left
    tight = Region(rounded_rectangle(20, 20, 24, 24, 0))
    assert wire_numbers(wires, tight) == ((), wires)


def test_reference_bar_is_a_hundred_millimetres_long() -> None:
    laser, _ = laser_of(hairpin(), PlateConfig(reference_bar=True))
    for sheet in laser.sheets:
        bar = sheet.marks[0].edges[0]
        assert bar.end[0] - bar.start[0] == pytest.approx(100.0)
        lowest = min(
            Loop(c.edges).sampled(0.05)[:, 1].min() for p in sheet.placed for c in p.contours if c.is_cut
        )
        assert lowest > bar.start[1] + 1.5


def test_bytes_repeat(tmp_path: Path) -> None:
    for name in ("a", "b"):
        folder = tmp_path / name
        folder.mkdir()
        config = PlateConfig()
        write_plate(folder, laser_of(hairpin(), config)[0], config)
    for path in (tmp_path / "a").iterdir():
        assert path.read_bytes() == (tmp_path / "b" / path.name).read_bytes(), path.name


def test_no_wires_is_said() -> None:
    with pytest.raises(JigError, match="no wires"):
        build_laser_jig((), JIG, PlateConfig())
