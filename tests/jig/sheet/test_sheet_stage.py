"""Stacks, sheets and labels of the laser-cut jig, and what is said of what can't be cut."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import shapely
from shapely import Polygon

from tests.exports.pieces_for_tests import eye, spiral, woven
from tests.jig.metal import line, wires_of
from tests.jig.sheet.laser import JIG, hairpin, laser_of, write_plate
from wrapit.config import PlateConfig
from wrapit.errors import JigError
from wrapit.geometry import Loop, Region
from wrapit.geometry.outlines.loops import rounded_rectangle
from wrapit.jig.sheet.engraving import engraved_wires, wire_numbers
from wrapit.jig.sheet.inlays import polygon_of
from wrapit.jig.sheet.nesting import nest
from wrapit.jig.sheet.parts import copies_needed
from wrapit.jig.sheet.stage import build_laser_jig, kept_apart


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
    assert walls
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
    assert {mark.layer for mark in (*three, *six)} == {"NOTE"}
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


def test_an_arrow_head_is_engraved_near_each_start() -> None:
    wires = woven(4)
    plate = Region(rounded_rectangle(-20, -20, 60, 60, 0))
    heads = [contour.edges for contour in engraved_wires(wires, plate) if len(contour.edges) == 2]
    assert len(heads) == len(wires)
    for wire, (first, second) in zip(wires, heads, strict=True):
        tip, barbs = np.array(first.end), (np.array(first.start) + np.array(second.end)) / 2
        start, onwards = wire.centreline.at(np.array([0.0, 0.05 * wire.centreline.domain[1]]))
        assert np.linalg.norm(tip - start) < 14
        assert (tip - barbs) @ (onwards - start) > 0
    tight = Region(rounded_rectangle(20, 20, 21, 21, 0))
    assert not [contour for contour in engraved_wires(wires, tight) if len(contour.edges) == 2]


def test_reference_bar_is_a_hundred_millimetres_long() -> None:
    laser, _ = laser_of(hairpin(), PlateConfig(reference_bar=True))
    for sheet in laser.sheets:
        bar = sheet.marks[0].edges[0]
        assert bar.end[0] - bar.start[0] == pytest.approx(100.0)
        assert sheet.marks[0].layer == "ENGRAVE"
        assert sheet.marks[-1].layer == "NOTE"
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
