"""What the guide says of printing the jig: files that are there, numbers on the holes, time and weight."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from tests.jig.metal import arcs, line, wires_of
from tests.jig.test_kinds import piece
from wrapit.config import Config, JigConfig
from wrapit.instructions.wording import duration
from wrapit.jig.printed.printing_page import GRAMS_PER_CM3, MINUTES_PER_CM3, plan_print_page
from wrapit.jig.printed.stage import build_jig
from wrapit.pipeline.build import build


def test_each_wire_has_its_number_on_the_hole_where_it_starts() -> None:
    # Two hooks that start in one hole, and a line that crosses both.
    wires = wires_of(
        [
            arcs((0, 0), 0, (15, 0), (6, 180), (15, 0)),
            arcs((0, 0), 180, (15, 0), (6, -180), (15, 0)),
            line((-8, -4), (-8, 16)),
        ]
    )
    settings = Config(drawing="x", outputs=["stl"])
    jigs, _ = build_jig(wires, JigConfig(split="single"))
    (page,) = plan_print_page(jigs, wires, settings)
    (jig,) = jigs.jigs
    marks = {mark.text: (float(mark.x), float(mark.y)) for mark in page.starts}
    assert set(marks) == {"1, 2", "3"}
    left, top = (float(each) for each in page.view_box.split()[:2])
    assert (left, top) == (0, 0)
    width, height = (float(each) for each in page.view_box.split()[2:])
    # The picture has the plate with a millimetre round it, y down.
    xs, ys = zip(*(hole.centre for hole in jig.plan.holes), strict=True)
    apart = [marks["3"][axis] - marks["1, 2"][axis] for axis in (0, 1)]
    first, third = wires[0].ends[0], wires[2].ends[0]
    assert apart[0] == pytest.approx(third[0] - first[0], abs=1.2)
    assert apart[1] == pytest.approx(first[1] - third[1], abs=1.2)
    assert all(0 < x < width and 0 < y < height for x, y in marks.values())
    assert max(xs) - min(xs) < width
    assert max(ys) - min(ys) < height
    assert len(page.walls) == len(jig.walls)
    assert [colour for _, colour in page.courses] == [wire.colour for wire in wires]
    assert page.files == ("jig.stl",)
    assert page.minutes == pytest.approx(MINUTES_PER_CM3 * jig.volume_mm3 / 1000)
    assert page.grams == pytest.approx(GRAMS_PER_CM3 * jig.volume_mm3 / 1000)
    # Solid PLA is 1.24 g/cm³, and a jig is mostly skin.
    assert 0.8 < GRAMS_PER_CM3 < 1.24


@pytest.mark.parametrize("settings", [{"pair": True}, {"jig": {"split": "per-wire"}}])
def test_the_files_that_the_guide_names_are_there(tmp_path: Path, settings: dict[str, object]) -> None:
    config = piece(tmp_path, 60, jigs=["printed"], outputs=["3mf", "stl", "html"], **settings)
    build(config, tmp_path / "out")
    html = (tmp_path / "out" / "guide.html").read_text()
    section = html.split('<section id="print">')[1].split("</section>")[0]
    named = set(re.findall(r"<strong>([^<]+)</strong>", section))
    there = {path.name for path in (tmp_path / "out").iterdir() if path.suffix in (".3mf", ".stl")}
    assert named == there
    assert "supports" in section
    # It comes first, since it takes longest.
    assert html.index('id="print"') < html.index('id="materials"') < html.index('id="making"')


def test_no_file_is_promised_that_was_not_asked_for(tmp_path: Path) -> None:
    config = piece(tmp_path, 60, jigs=["printed"], outputs=["html"])
    build(config, tmp_path / "out")
    html = (tmp_path / "out" / "guide.html").read_text()
    section = html.split('<section id="print">')[1].split("</section>")[0]
    assert "none was asked for" in section
    assert not re.findall(r"jig\.\w+", section)


def test_durations_are_as_rough_as_they_are_known() -> None:
    said = {0.2: "15 min", 20: "15 min", 24: "30 min", 62: "1 h", 70: "1 h 15 min", 250: "4 h 15 min"}
    assert {minutes: duration(minutes) for minutes in said} == said
