"""What the guide says of printing the jig: files that are there, numbers on the holes, time and weight."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from tests.jig.metal import arcs, line, wires_of
from tests.jig.test_kinds import piece
from wrapit.config import Config, JigConfig
from wrapit.geometry import Region
from wrapit.jig.printed.printed_kind import handling
from wrapit.jig.printed.printing_page import GRAMS_PER_CM3, MINUTES_PER_CM3, print_page
from wrapit.jig.printed.stage import build_jig
from wrapit.pages.model import Duration, Facts, Figure, Mass, Shape
from wrapit.pipeline.build import build

pytestmark = pytest.mark.usefixtures("kernel_here")


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
    page = print_page(jigs, handling(jigs, wires, settings).benches, settings)
    (jig,) = jigs.jigs
    (figure,) = (block for block in page.blocks if isinstance(block, Figure))
    marks = {mark.text: mark.at for mark in figure.picture.marks}
    assert set(marks) == {"1, 2", "3"}
    assert marks["3"] == pytest.approx(wires[2].ends[0])
    assert marks["1, 2"] == pytest.approx(wires[0].ends[0], abs=1.2)
    shapes = [shape for shape in figure.picture.shapes if isinstance(shape, Shape)]
    walls = [shape.geometry for shape in shapes if shape.style == "wall"]
    assert all(isinstance(wall, Region) for wall in walls)
    assert len(walls) == len(jig.walls) + len(jig.plan.pins)
    assert [shape.colour for shape in shapes if shape.style == "wire"] == [wire.colour for wire in wires]
    (facts,) = (block for block in page.blocks if isinstance(block, Facts))
    told = {name.key: dict(what.values) for name, what in facts.rows}
    assert told["fact-file"]["files"].items == ("jig.stl",)
    assert told["fact-takes"]["time"] == Duration(pytest.approx(MINUTES_PER_CM3 * jig.volume_mm3 / 1000))
    assert told["fact-takes"]["mass"] == Mass(pytest.approx(GRAMS_PER_CM3 * jig.volume_mm3 / 1000))
    # Solid PLA is 1.24 g/cm³, and a jig is mostly skin.
    assert 0.8 < GRAMS_PER_CM3 < 1.24


@pytest.mark.parametrize("settings", [{"pair": True}, {"jig": {"split": "per-wire"}}])
def test_the_files_that_the_guide_names_are_there(tmp_path: Path, settings: dict[str, object]) -> None:
    config = piece(tmp_path, 60, jigs=["printed"], outputs=["3mf", "stl", "html"], **settings)
    build(config, tmp_path / "out")
    html = (tmp_path / "out" / "guide.html").read_text()
    section = html.split('id="print"')[1].split("</section>")[0]
    named = set(re.findall(r"jig[\w-]*\.\w+", section))
    there = {path.name for path in (tmp_path / "out").iterdir() if path.suffix in (".3mf", ".stl")}
    assert named == there
    assert "supports" in section
    # It comes first, since it takes longest.
    assert html.index('id="print"') < html.index('id="materials"') < html.index('id="step-1"')
    # A step names the jig that it takes as its files are named.
    taken = set(re.findall(r"Take ([\w-]+)\.", html))
    assert taken <= {Path(name).stem for name in there}
    assert bool(taken) == (len({Path(name).stem for name in there}) > 1)


def test_no_file_is_promised_that_was_not_asked_for(tmp_path: Path) -> None:
    config = piece(tmp_path, 60, jigs=["printed"], outputs=["html"])
    build(config, tmp_path / "out")
    html = (tmp_path / "out" / "guide.html").read_text()
    section = html.split('id="print"')[1].split("</section>")[0]
    assert "none was asked for" in section
    assert not re.findall(r"jig\.\w+", section)
