"""The test pieces measure what they say."""

from __future__ import annotations

import itertools
from pathlib import Path

import ezdxf
import numpy as np
import pytest
from shapely import Point, Polygon

from tests.jig.metal import line, wires_of
from wrapit.config import JigConfig, PlateConfig
from wrapit.errors import JigError
from wrapit.exports.plate_dxf import write_dxf
from wrapit.geometry import Loop
from wrapit.jig.contours import Contour
from wrapit.jig.coupons import clearance_coupon, kerf_coupon
from wrapit.jig.printed.plan import plan_jig
from wrapit.jig.sheet.inlays import polygon_of
from wrapit.pipeline.coupon_files import write_printed

D = 1.02


def polygon(contour: Contour) -> Polygon:
    return Polygon(Loop(contour.edges).sampled(1e-4))


def test_the_slot_labelled_with_the_true_kerf_takes_the_wire() -> None:
    coupon = kerf_coupon(D, PlateConfig())
    slots = [polygon(c) for c in coupon.contours if c.layer == "CUT_INNER"][:9]
    assert len(coupon.kerfs_mm) == 9
    assert coupon.kerfs_mm[4] == pytest.approx(0.15)
    for kerf, slot in zip(coupon.kerfs_mm, slots, strict=True):
        left, _, right, _ = slot.buffer(kerf / 2).bounds
        assert right - left == pytest.approx(D, abs=1e-6)


def test_the_key_fits_each_pocket_with_its_gap() -> None:
    config = PlateConfig(kerf="0.3 mm")
    coupon = kerf_coupon(D, config)
    pockets = [polygon(c).buffer(0.15, quad_segs=64) for c in coupon.contours if c.layer == "CUT_INNER"][9:]
    outer = [polygon(c) for c in coupon.contours if c.layer == "CUT_OUTER"]
    key = min(outer, key=lambda each: each.area).buffer(-0.15, quad_segs=64)
    width, height = np.ptp(np.array(key.exterior.coords), axis=0)
    for fit, pocket in zip((0.0, 0.025, 0.05, 0.075, 0.1), pockets, strict=True):
        pocket_width, pocket_height = np.ptp(np.array(pocket.exterior.coords), axis=0)
        assert (pocket_width - width) / 2 == pytest.approx(fit, abs=1e-6)
        assert (pocket_height - height) / 2 == pytest.approx(fit, abs=1e-6)


def test_nothing_touches_and_the_file_is_sound(tmp_path: Path) -> None:
    coupon = kerf_coupon(D, PlateConfig())
    write_dxf(tmp_path / "coupon.dxf", coupon.contours)
    document = ezdxf.readfile(tmp_path / "coupon.dxf")
    assert not document.audit().errors
    rings = [polygon(c).exterior for c in coupon.contours if c.is_cut]
    pairs = [(a, b) for i, a in enumerate(rings) for b in rings[i + 1 :]]
    assert min(a.distance(b) for a, b in pairs) > 1.5
    plate = max((polygon(c) for c in coupon.contours if c.layer == "CUT_OUTER"), key=lambda p: p.area)
    engraved = [point for c in coupon.contours if not c.is_cut for e in c.edges for point in (e.start, e.end)]
    assert engraved
    assert all(plate.contains_properly(Point(point)) for point in engraved)
    openings = [polygon(c) for c in coupon.contours if c.layer == "CUT_INNER"]
    assert not any(opening.intersects(Point(point)) for point in engraved for opening in openings)


def test_a_wire_too_thin_to_measure_with_is_refused() -> None:
    with pytest.raises(JigError, match="too thin"):
        kerf_coupon(0.3, PlateConfig())


@pytest.mark.parametrize("clearance", ["0.2 mm", "0.05 mm"])
def test_channels_have_the_clearances_they_are_labelled_with(clearance: str) -> None:
    coupon = clearance_coupon(D, JigConfig(clearance=clearance))
    tops = sorted({top for _, top in coupon.terraces})
    walls = [polygon_of(region) for region, top in coupon.terraces if top == tops[-1]]
    walls.sort(key=lambda wall: wall.bounds)
    gaps = [b.bounds[0] - a.bounds[2] for a, b in itertools.pairwise(walls)]
    assert gaps == pytest.approx([D + 2 * clearance for clearance in coupon.clearances_mm])
    assert min(coupon.clearances_mm) >= 0
    assert any(c == pytest.approx(float(clearance.removesuffix(" mm"))) for c in coupon.clearances_mm)
    base = polygon_of(coupon.base)
    shapes = [polygon_of(region) for region, _ in coupon.terraces]
    assert all(base.contains_properly(shape) for shape in shapes)
    assert all(not a.intersects(b) for i, a in enumerate(shapes) for b in shapes[i + 1 :])


def test_the_printed_coupon_is_one_sound_solid(tmp_path: Path) -> None:
    coupon = clearance_coupon(D, JigConfig())
    write_printed(coupon, tmp_path / "coupon.stl", 0.01)
    data = (tmp_path / "coupon.stl").read_bytes()
    count = int.from_bytes(data[80:84], "little")
    fields = np.dtype([("normal", "<3f4"), ("points", "<9f4"), ("attribute", "<u2")])
    triangles = np.frombuffer(data, fields, count, 84)["points"].reshape(-1, 3, 3).astype(float)
    volume = np.einsum("ij,ij->i", triangles[:, 0], np.cross(triangles[:, 1], triangles[:, 2])).sum() / 6
    expected = polygon_of(coupon.base).area * coupon.base_mm
    expected += sum(polygon_of(region).area * (top - coupon.base_mm) for region, top in coupon.terraces)
    assert volume == pytest.approx(expected, rel=1e-3)


@pytest.mark.parametrize(
    ("diameter_mm", "asked", "height_mm"),
    [(0.5, "4 mm", 4.0), (0.5, "7 mm", 7.0), (0.5, "1 mm", 2.5), (2.0, "4 mm", 5.5), (2.0, "5.6 mm", 5.6)],
)
def test_the_coupons_walls_are_as_high_as_the_jigs(diameter_mm: float, asked: str, height_mm: float) -> None:
    settings = JigConfig(min_wall_height=asked, support="turns")
    coupon = clearance_coupon(diameter_mm, settings)
    assert max(top for _, top in coupon.terraces) - coupon.base_mm == pytest.approx(height_mm)
    wires = wires_of([line((0, 0), (60, 0))], settings, diameter_mm)
    plan, _ = plan_jig(wires, settings)
    assert [wall.height_mm for wall in plan.walls] == pytest.approx([height_mm])
