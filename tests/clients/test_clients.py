"""Real programs open what wrapit writes, and find what wrapit says."""

from __future__ import annotations

import json
import re
import subprocess
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import pytest

from tests.clients import freecad
from tests.conftest import OPENED
from wrapit.pipeline.build import Build

pytestmark = pytest.mark.client

Piece = Callable[[str], Build]
Program = Callable[[str], str]


def files(build: Build, pattern: str) -> list[Path]:
    assert build.folder is not None
    found = sorted(build.folder.glob(pattern))
    assert found, pattern
    return found


def wire_colours(report: dict[str, Any]) -> list[list[float]]:
    """Red, green and blue of each wire, from 0 to 1."""
    from wrapit.wires.palette import wire_colour

    colours = [wire_colour(index) for index in range(len(report["wires"]))]
    return [[int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5)] for colour in colours]


@pytest.mark.parametrize("names", [OPENED[::2], OPENED[1::2]], ids=" ".join)
def test_freecad_finds_names_and_volumes(
    piece: Piece, program: Program, tmp_path: Path, names: Sequence[str]
) -> None:
    """In two halves, so that two workers share the work."""
    xvfb, gui = program("xvfb-run"), program("freecad")
    builds = {name: piece(name) for name in names}
    steps = {name: [files(builds[name], f"{stem}.step")[0] for stem in ("jig", "wires")] for name in names}
    trees = freecad.tree(xvfb, gui, [path for paths in steps.values() for path in paths], tmp_path)
    for name, build in builds.items():
        jig, wires = (trees[path] for path in steps[name])
        in_freecad_all_is_as_reported(name, build.report, jig, wires)


def in_freecad_all_is_as_reported(
    name: str, report: dict[str, Any], jig: dict[str, Any], wires: dict[str, Any]
) -> None:
    assert all(feature["valid"] for feature in jig["features"] + wires["features"]), name
    assert sum(feature["solids"] for feature in jig["features"]) == report["jig"]["solids"], name
    volume = sum(feature["volume"] for feature in jig["features"])
    assert volume == pytest.approx(report["jig"]["volume_mm3"], rel=1e-6), name

    # As the README says: one object a file, until the merging of compounds is switched off.
    ring = report.get("bail", {}).get("kind") == "ring"
    assert wires["as_it_comes"] == {"wires": len(report["wires"]) + ring}, name
    assert len(jig["as_it_comes"]) == 1, name

    assert wires["groups"] in ([name], []), name
    found = {feature["label"]: feature for feature in wires["features"]}
    expected = {wire["name"] for wire in report["wires"]}
    centrelines = {f"{each} centreline" for each in expected}
    assert set(found) == expected | centrelines | ({"jump-ring"} if ring else set()), name
    for wire, colour in zip(report["wires"], wire_colours(report), strict=True):
        where = f"{name}: {wire['name']}"
        solid, centreline = found[wire["name"]], found[f"{wire['name']} centreline"]
        assert solid["solids"] == 1, where
        assert solid["colour"] == pytest.approx(colour, abs=1e-3), where
        assert centreline["curves"] == ["Part::GeomBSplineCurve"], where
        assert wire["length_mm"] - 1e-3 <= centreline["length"] <= 1.1 * wire["length_mm"], where


@pytest.mark.parametrize("name", OPENED)
def test_slicer_needs_no_repairs(piece: Piece, program: Program, tmp_path: Path, name: str) -> None:
    """Both files hold one mesh, as the slicer says of each: one of them is sliced."""
    slicer = program("prusa-slicer")
    stls, three_mfs = files(piece(name), "jig*.stl"), files(piece(name), "jig*.3mf")
    for stl, three_mf in zip(stls, three_mfs, strict=True):
        told, also = told_by(slicer, stl), told_by(slicer, three_mf)
        assert told["manifold"] == also["manifold"] == "yes"
        assert told["number_of_facets"] == also["number_of_facets"]
        assert float(told["volume"]) == pytest.approx(float(also["volume"]), rel=1e-4)
    for model in three_mfs:
        gcode = tmp_path / f"{model.name}.gcode"
        # Paths may leave a layer's outline by half of what a nozzle can place, once it is cut from the mesh:
        # as long as it follows each facet, the slicer takes thrice the time.
        coarse = ["--resolution", "0.05", "--gcode-resolution", "0.1"]
        command = [slicer, "--export-gcode", *coarse, "--output", str(gcode), str(model)]
        run = subprocess.run(command, capture_output=True, text=True, timeout=300, check=False)
        said = (run.stdout + run.stderr).replace(str(tmp_path), "")
        assert run.returncode == 0, said
        assert not re.search(r"repair|non-manifold|open edges|auto-?repaired", said, re.IGNORECASE), said
        assert gcode.stat().st_size > 10_000


def told_by(slicer: str, model: Path) -> dict[str, str]:
    """What the slicer says of a model that it has read; it names each kind of repair that it made."""
    said = subprocess.run([slicer, "--info", str(model)], capture_output=True, text=True, check=True).stdout
    assert not re.search("open_|degenerate|_fixed|_added|_removed|_reversed|backwards", said), said
    return dict(re.findall(r"^(\w+) = *(.+)$", said, re.MULTILINE))


@pytest.mark.parametrize("name", OPENED)
def test_stl_is_watertight(piece: Piece, program: Program, name: str) -> None:
    admesh = program("admesh")
    for model in files(piece(name), "jig*.stl"):
        said = subprocess.run(
            [admesh, "--exact", str(model)], capture_output=True, text=True, check=True
        ).stdout
        for fault in ("Total disconnected facets", "Backwards edges", "Degenerate facets", "Normals fixed"):
            numbers = re.search(rf"{fault}\s*:\s*(\d+)(?:\s+(\d+))?", said)
            assert numbers, said
            assert {number for number in numbers.groups() if number is not None} == {"0"}, said


@pytest.mark.parametrize("name", OPENED)
def test_dxf_audit_is_clean(piece: Piece, name: str) -> None:
    import ezdxf

    for path in files(piece(name), "plate*.dxf"):
        document = ezdxf.readfile(path)
        audit = document.audit()
        assert not audit.errors
        assert not audit.fixes
        assert document.units == ezdxf.units.MM
        assert len(document.modelspace()) > 0


def test_guide_shows_in_a_browser(piece: Piece, program: Program, tmp_path: Path) -> None:
    browser = program("chromium")
    build = piece("butterfly")
    (guide,) = files(build, "guide.html")
    command = [browser, "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run"]
    command += ["--disable-background-networking", "--disable-component-update", "--disable-sync"]
    command += [f"--user-data-dir={tmp_path / 'profile'}", "--dump-dom", guide.as_uri()]
    page = subprocess.run(command, capture_output=True, text=True, timeout=120, check=True).stdout
    text = re.sub(r"<[^>]+>", " ", page)
    for index, wire in enumerate(build.report["wires"], start=1):
        assert f"Wire {index} of {len(build.report['wires'])}" in " ".join(text.split())
        assert f"{wire['cut_length_mm']:.0f}" in text
    assert not re.search(r"""(?:src|href)=["'](?:https?:)?//""", page), "the page must need no network"


def test_report_names_every_file(piece: Piece) -> None:
    build = piece("butterfly")
    assert build.folder is not None
    report = json.loads((build.folder / "report.json").read_text())
    listed = {artifact["path"] for artifact in report["artifacts"]}
    assert listed == {path.name for path in build.folder.iterdir()} - {"report.json"}
    solids = {"jig.step", "jig.stl", "jig.3mf", "wires.step"}
    texts = {"drawing.svg", "drawing.json", "decomposition.svg", "decomposition.json", "config.lock.yaml"}
    assert solids | texts | {"plate-1-3mm.dxf", "plate-2-6mm.dxf", "preview.png", "guide.html"} <= listed
