"""The laser-cut jig, read back from its DXF, is the jig that was planned."""

from __future__ import annotations

import itertools
from pathlib import Path

import ezdxf
import ezdxf.path
import numpy as np
import pytest
import shapely
from shapely import LinearRing, LineString, Polygon

from tests.jig.sheet.laser import JIG, PIECES, finished, laser_of, write_plate
from wrapit.config import JigConfig, PlateConfig
from wrapit.errors import Finding
from wrapit.geometry import Loop
from wrapit.geometry.bspline import chain_of
from wrapit.geometry.outlines.closing import SHORT_MM
from wrapit.jig.sheet.drawings import sheet_name
from wrapit.jig.sheet.inlays import polygon_of
from wrapit.jig.sheet.model import LaserJig, LaserPart, LaserSheet, Placed
from wrapit.wires.model import Wire


def read(path: Path) -> dict[str, list[LinearRing]]:
    """Closed cuts of a DXF by layer, straight from the entities."""
    document = ezdxf.readfile(path)
    assert not document.audit().errors
    rings: dict[str, list[LinearRing]] = {"CUT_INNER": [], "CUT_OUTER": []}
    for entity in document.modelspace():
        if entity.dxf.layer in rings:
            outline = ezdxf.path.make_path(entity)
            assert outline.start.isclose(outline.end, abs_tol=1e-12)
            # The end is the start but for rounding; both together would be a crossing.
            points = [(p.x, p.y) for p in outline.flattening(2e-4)][:-1]
            rings[entity.dxf.layer].append(LinearRing(points))
    return rings


def cut_polygon(placed: Placed, rings: dict[str, list[LinearRing]]) -> Polygon:
    """The outer cut of a placed part, less its inner cuts, among the rings of its sheet."""
    planned = next(c for c in placed.contours if c.layer == "CUT_OUTER")
    centre = Polygon(Loop(planned.edges).sampled(0.01)).centroid
    outer = min(rings["CUT_OUTER"], key=lambda ring: Polygon(ring).centroid.distance(centre))
    whole = Polygon(outer)
    inner = [ring for ring in rings["CUT_INNER"] if whole.contains(ring)]
    return Polygon(outer.coords, [ring.coords for ring in inner])


def moved_polygon(part: LaserPart, placed: Placed, config: PlateConfig) -> Polygon:
    """The part on its sheet; a wall's corners are as round as the beam leaves those of its pocket."""
    shape, rounded = polygon_of(part.shape), config.kerf / 2 - config.fit
    if part.role == "wall" and rounded > 0:
        shape = shape.buffer(-rounded, quad_segs=64).buffer(rounded, quad_segs=64)
    turned = shapely.affinity.rotate(shape, 90 * placed.quarters, origin=(0, 0))
    return shapely.affinity.translate(turned, *placed.shift)


# Walls that hold a wire stand nearer to it than the clearance, or, as the paper's are, at it all round.
PAPERS_RULE = JIG.model_copy(update={"support": "turns", "inside_gap": JIG.clearance})
CASES = [
    ("eye", {}, JIG),
    ("eye", {"kerf": 0.4, "fit": 0.1, "sheet": 6.0, "wall_sheet": 10.0}, JIG),
    ("eye", {"kerf": 0.3}, PAPERS_RULE),
    ("hairpin", {"kerf": 0.1, "sheet": 2.0, "fit": 0.0}, JIG),
    ("spiral", {}, JIG),
    ("woven", {"sheet_width": 600.0, "sheet_height": 300.0}, JIG),
    ("spiral", {"kerf": 0.1}, PAPERS_RULE),
]


@pytest.fixture(scope="module", params=CASES, ids=lambda case: f"{case[0]}-{len(case[1])}-{case[2].support}")
def cut(
    request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory
) -> tuple[tuple[Wire, ...], PlateConfig, LaserJig, tuple[Finding, ...], Path, JigConfig]:
    name, changes, jig = request.param
    wires, config = PIECES[name](), PlateConfig.model_construct(**{**PlateConfig().__dict__, **changes})
    laser, findings = laser_of(wires, config, jig)
    folder = tmp_path_factory.mktemp(name)
    write_plate(folder, laser, config)
    return wires, config, laser, findings, folder, jig


Cut = tuple[tuple[Wire, ...], PlateConfig, LaserJig, tuple[Finding, ...], Path, JigConfig]


def test_sheets_read_back_have_the_parts_grown_by_half_a_kerf(cut: Cut) -> None:
    _, config, laser, _, folder, _ = cut
    for sheet in laser.sheets:
        rings = read(folder / f"{sheet_name(sheet)}.dxf")
        assert len(rings["CUT_OUTER"]) == len(sheet.placed)
        for placed in sheet.placed:
            found = cut_polygon(placed, rings)
            expected = moved_polygon(placed.part, placed, config).buffer(config.kerf / 2, quad_segs=64)
            assert found.area == pytest.approx(expected.area, rel=1e-3)
            assert found.symmetric_difference(expected).area < 2e-3 * expected.length
            # What remains when the laser has taken its kerf is the finished part.
            left = found.buffer(-config.kerf / 2, quad_segs=64)
            finished_part = moved_polygon(placed.part, placed, config)
            assert left.symmetric_difference(finished_part).area < 3e-3 * finished_part.length


def test_nothing_crosses_or_is_drawn_twice(cut: Cut) -> None:
    _, _, laser, findings, folder, _ = cut
    count, gaps = 0, []
    for sheet in laser.sheets:
        rings = [ring for layer in read_sheet(folder, sheet).values() for ring in layer]
        count += len(rings)
        assert all(ring.is_simple for ring in rings)
        tree = shapely.STRtree(rings)
        pairs = [(a, b) for a, b in tree.query(rings, predicate="intersects").T if a < b]
        assert pairs == []
        near = tree.query(rings, predicate="dwithin", distance=5.0).T
        gaps += [rings[a].distance(rings[b]) for a, b in near if a < b]
    assert count == laser.checks.closed_contours
    assert not {finding.code for finding in findings} & {"open-cut", "crossing-cut"}
    assert min(gaps) == pytest.approx(laser.checks.min_cut_distance_mm, abs=2e-3)


def test_length_is_the_sum_of_what_is_read(cut: Cut) -> None:
    *_, laser, _, folder, _ = cut
    rings = [r for sheet in laser.sheets for layer in read_sheet(folder, sheet).values() for r in layer]
    # Flattened curves are a little shorter than the true ones.
    assert sum(ring.length for ring in rings) == pytest.approx(laser.checks.cut_length_mm, rel=5e-5)


def test_parts_lie_on_their_sheets_and_apart(cut: Cut) -> None:
    _, config, laser, _, folder, _ = cut
    # Corners between spans too short for a laser move by half of SHORT_MM at most.
    near = SHORT_MM / 2
    for sheet in laser.sheets:
        outer = [Polygon(ring) for ring in read_sheet(folder, sheet)["CUT_OUTER"]]
        left, bottom, right, top = shapely.union_all(outer).bounds
        assert left >= config.spacing - near
        assert bottom >= config.spacing - near
        assert right <= sheet.width_mm - config.spacing + near
        assert top <= sheet.height_mm - config.spacing + near
        for a, b in itertools.combinations(outer, 2):
            assert a.distance(b) >= config.spacing - 0.02
        assert len({placed.part.thickness_mm for placed in sheet.placed}) == 1


def read_sheet(folder: Path, sheet: LaserSheet) -> dict[str, list[LinearRing]]:
    return read(folder / f"{sheet_name(sheet)}.dxf")


def test_pocket_minus_piece_is_the_fit_all_around(cut: Cut) -> None:
    _, config, laser, *_ = cut
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


def test_assembled_walls_hold_the_wires_at_radius_and_gap(cut: Cut) -> None:
    wires, config, laser, *_, jig = cut
    walls = shapely.union_all([finished(part, config.kerf) for part in laser.parts if part.role == "wall"])
    face = wires[0].diameter_mm / 2 + jig.inside_gap
    lines = [LineString(chain_of(wire.centreline).sampled(0.02)) for wire in wires]
    gap = min(line.distance(walls) for line in lines)
    assert gap == pytest.approx(face, abs=0.01)


def test_engraving_stays_on_the_plates(cut: Cut) -> None:
    _, _, laser, *_ = cut
    for part in laser.parts:
        if part.role == "wall":
            continue
        shape = polygon_of(part.shape)
        for contour in part.contours:
            if not contour.is_cut and part.role != "bottom":
                line = LineString(np.vstack([edge.sampled(0.05) for edge in contour.edges]))
                assert shape.contains(line), (part.label, line)


def test_each_sheet_has_its_files_and_there_are_no_others(cut: Cut) -> None:
    *_, laser, _, folder, _ = cut
    names = {f"plate-{sheet.number}-{sheet.thickness_mm:g}mm" for sheet in laser.sheets}
    assert len(names) == len(laser.sheets)
    assert {path.name for path in folder.iterdir()} == {f"{n}.{ext}" for n in names for ext in ("dxf", "svg")}
    for sheet in laser.sheets:
        drawn = sum(map(len, read(folder / f"{sheet_name(sheet)}.dxf").values()))
        assert drawn == sum(contour.is_cut for contour in sheet.contours)
