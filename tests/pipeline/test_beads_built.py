"""Beads of a drawing from the file to the finished piece: seats in the jig, steps and lists in the guide."""

from __future__ import annotations

import dataclasses
import json
import math
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from wrapit.config import load_config
from wrapit.face import build_jigs, decompose, draw_wires, make_fit, trace
from wrapit.jig.openings.bead_room import bead_obstacles
from wrapit.pipeline.build import Build, build

pytestmark = pytest.mark.usefixtures("kernel_here")

PAGE = '<svg xmlns="http://www.w3.org/2000/svg" width="60mm" height="40mm" viewBox="0 0 60 40">{}</svg>'
STROKE = '<path d="{}" fill="none" stroke="black" stroke-width="1"/>'
# A line that waves, with a ring of 5 mm in its middle, and one of 4 mm at its end.
WAVE = "M 3 20 C 8 8 18 8 25 20 M 30 20 C 37 32 46 32 50 20"
THREADED = "M 25 20 A 2.5 2.5 0 0 1 30 20 A 2.5 2.5 0 0 1 25 20"
AT_END = "M 50 20 A 2 2 0 0 1 50 16 A 2 2 0 0 1 50 20"
# An eye of 3 mm beside the wave, less than a millimetre off it.
EYE = '<circle cx="14" cy="{}" r="1.5"/>'


def written(folder: Path, drawn: str, **settings: Any) -> Path:
    folder.mkdir(exist_ok=True)
    (folder / "piece.svg").write_text(PAGE.format(drawn))
    config = folder / "piece.yaml"
    settings = {"beads": "auto", "outputs": ["step", "html", "pdf"], "jigs": ["printed"], **settings}
    config.write_text(json.dumps({"drawing": "piece.svg", **settings}))
    return config


def necklace(folder: Path, **settings: Any) -> Path:
    return written(folder, "".join(map(STROKE.format, (WAVE, THREADED, AT_END))), **settings)


def page_of(built: Build) -> str:
    assert built.folder is not None
    page = (built.folder / "guide.html").read_text().replace("\u00a0", " ")
    return re.sub(r"\s+", " ", re.sub(r"<[^>]+>", "", page))


def test_a_bead_is_threaded_and_has_its_seat(tmp_path: Path) -> None:
    config = load_config(necklace(tmp_path))
    drawing, _ = trace(tmp_path / "piece.svg", config)
    fitted, _ = make_fit(drawing, config)
    assert sorted(bead.diameter_mm for bead in fitted.beads) == [4, 5]
    assert [removal.what for removal in fitted.drawing.removed].count("bead") == 2
    wires, _ = draw_wires(decompose(fitted.drawing, config)[0], config, fitted.beads)
    (wire,) = wires
    assert [bead.diameter_mm for bead in wire.beads] in ([4, 5], [5, 4])
    for bead, place in zip(wire.beads, wire.bead_places, strict=True):
        drawn = next(each for each in fitted.beads if each.diameter_mm == bead.diameter_mm)
        assert place == pytest.approx(drawn.at, abs=0.3)
        assert bead.threaded
    jigs, _ = build_jigs(wires, config)
    (jig,) = jigs.jigs
    assert jig.valid
    assert sorted(seat.bead_mm for seat in jig.plan.seats) == [4, 5]
    beads = bead_obstacles(wires, config.jig.clearance)
    for wall in jig.plan.walls:
        assert wall.outline.distance(beads) >= -1e-9
        assert not wall.outline.intersection(beads).area > 1e-6


def test_the_plate_lacks_the_pockets_and_nothing_else(tmp_path: Path) -> None:
    """The jig with beads in it against the same jig without pockets: the difference is their cylinders."""
    bare = {"jig": {"course": False, "numbers": False, "split": "single"}}
    config = load_config(necklace(tmp_path, **bare))
    drawing, _ = trace(tmp_path / "piece.svg", config)
    fitted, _ = make_fit(drawing, config)
    wires, _ = draw_wires(decompose(fitted.drawing, config)[0], config, fitted.beads)
    (jig,) = build_jigs(wires, config)[0].jigs
    walls = sum(wall.outline.area * wall.height_mm for wall in jig.plan.walls)  # up to their set-back tops
    openings = sum(_area(hole.outline) for hole in jig.plan.holes)
    openings += sum(math.pi * pin.diameter_mm**2 / 4 for pin in jig.plan.pins)
    plate = (_area(jig.plan.plate.outline.outer) - openings) * config.jig.base_thickness
    pockets = sum(math.pi * (seat.diameter_mm / 2) ** 2 * seat.depth_mm for seat in jig.plan.seats)
    assert pockets > 20
    assert jig.volume_mm3 == pytest.approx(plate + walls - pockets, abs=0.02 * walls + 1.0)


def _area(loop: Any) -> float:
    points = loop.sampled(0.01)
    x, y = np.asarray(points).T
    return float(abs(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1))) / 2)


@pytest.mark.parametrize(
    ("language", "said"),
    [
        ("en", ("Thread the bead of 5 mm", "onto wire 1", "small loop", "Beads", "How many")),
        ("de", ("Fädel zuerst die Perle von 5 mm", "auf Draht 1", "kleinen Öse", "Perlen", "Anzahl")),
    ],
)
def test_the_guide_threads_and_lists_them(tmp_path: Path, language: str, said: tuple[str, ...]) -> None:
    # Gauges in whole numbers, for the lock gives them in nine digits.
    guide = {"language": language, "binding_gauge": "0.3 mm"}
    built = build(necklace(tmp_path, guide=guide, wire={"gauge": "1 mm"}), tmp_path / "out")
    page = page_of(built)
    for words in said:
        assert words in page
    assert built.report["jig"]["seats"] == 2
    (wire,) = built.report["wires"]
    assert sorted((bead["diameter_mm"], bead["held"]) for bead in wire["beads"]) == [
        (4.0, "threaded"),
        (5.0, "threaded"),
    ]
    lock = (tmp_path / "out" / "config.lock.yaml").read_text()
    assert "beads: auto" in lock
    assert "seats: []" in lock
    again = tmp_path / "again"
    again.mkdir()
    (again / "piece.svg").write_text((tmp_path / "piece.svg").read_text())
    (again / "piece.yaml").write_text(lock)
    twice = build(again / "piece.yaml", again / "out")
    hashes = [{a["path"]: a["sha256"] for a in each.report["artifacts"]} for each in (built, twice)]
    assert hashes[0] == hashes[1]


@pytest.mark.parametrize("pair", [False, True])
def test_an_eye_near_a_wire_is_sewn_on_and_one_far_away_is_told(tmp_path: Path, pair: bool) -> None:
    config = written(tmp_path, STROKE.format(WAVE + "M 25 20 L 30 20") + EYE.format(13.7), pair=pair)
    built = build(config, tmp_path / "out")
    page = page_of(built)
    assert "sew it to this one there" in page
    assert "into its seat" in page
    assert built.report["jig"]["seats"] == 1
    if pair:
        assert built.report["jig"]["mirrored"]["seats"] == 1
        return
    far = written(tmp_path / "far", STROKE.format(WAVE + "M 25 20 L 30 20") + EYE.format(30))
    report = build(far, tmp_path / "far" / "out", until="decomposition").report
    assert "no-bead" in {finding["code"] for finding in report["findings"]}


def test_never_is_as_if_beads_were_unknown(tmp_path: Path) -> None:
    report = build(necklace(tmp_path, beads="never"), tmp_path / "out", until="wires").report
    assert report["drawing"]["segments"] > 2
    assert not any("bead" in finding["code"] for finding in report["findings"])


def test_other_kinds_keep_clear_and_say_that_they_have_no_seats(tmp_path: Path) -> None:
    built = build(necklace(tmp_path, jigs=["sheet", "pegs"], outputs=["dxf"]), tmp_path / "out")
    assert "seats-in-print-only" in {finding["code"] for finding in built.report["findings"]}


def test_pictures_show_the_beads(tmp_path: Path) -> None:
    from PIL import Image

    from wrapit.exports.preview_png import BEAD, write_preview
    from wrapit.instructions.pictures import Scene

    config = load_config(necklace(tmp_path))
    drawing, _ = trace(tmp_path / "piece.svg", config)
    fitted, _ = make_fit(drawing, config)
    (wire,), _ = draw_wires(decompose(fitted.drawing, config)[0], config, fitted.beads)
    scene = Scene.of_piece("piece", (wire,))
    line, *rims = scene.shared[scene.wire_key(1)]
    for rim, bead, place in zip(rims, wire.beads, wire.bead_places, strict=True):
        assert isinstance(rim.geometry, type(line.geometry))
        away = np.linalg.norm(rim.geometry.sampled(0.1) - place, axis=1)
        assert away == pytest.approx((bead.diameter_mm - wire.diameter_mm) / 2, abs=1e-3)
    write_preview(tmp_path / "seen.png", (wire,))
    write_preview(tmp_path / "bare.png", (dataclasses.replace(wire, beads=()),))
    seen, bare = (np.asarray(Image.open(tmp_path / name)) for name in ("seen.png", "bare.png"))
    discs = (seen == BEAD).all(axis=2).sum()
    assert not (bare == BEAD).all(axis=2).any()
    wide_mm = np.ptp(wire.centreline.at(np.linspace(*wire.centreline.domain, 500))[:, 0])
    mm2 = discs * (wide_mm / bare.shape[1]) ** 2
    assert mm2 == pytest.approx(math.pi * (2**2 + 2.5**2), rel=0.4)


@pytest.mark.parametrize("level", ["off", "gentle", "bold"])
def test_beads_lie_on_the_lines_of_a_fitted_drawing(tmp_path: Path, level: str) -> None:
    config = load_config(necklace(tmp_path, fit=level))
    drawing, _ = trace(tmp_path / "piece.svg", config)
    fitted, findings = make_fit(drawing, config)
    assert len(fitted.beads) + sum(each.code == "no-bead" for each in findings) == 2
    assert len(fitted.beads) >= 1
    for bead in fitted.beads:
        assert bead.segment is not None
        curve = fitted.drawing.segments[bead.segment].curve
        assert np.linalg.norm(curve.sampled(0.01) - bead.at, axis=1).min() < 0.02
