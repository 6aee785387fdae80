"""guide.pdf, measured: what is drawn at true size has it, on both papers, with the same bytes each time."""

from __future__ import annotations

import functools
import io
import re
from typing import Any

import pdfplumber
import pytest

from tests.jig.metal import arcs, line, wires_of
from wrapit.config import Config, GuideConfig, WireConfig
from wrapit.instructions.model import Guide
from wrapit.instructions.plan import Held, plan_guide, size_mm
from wrapit.instructions.stage import write_page, write_print
from wrapit.jig.sheet.sheet_kind import make
from wrapit.wires.model import Wire

MM = 72 / 25.4


@functools.cache
def wires(scale: float = 1.0) -> tuple[Wire, ...]:
    """A hook of a good hundred millimetres, and a line across it."""
    hook = arcs((0, 0), 0, (45 * scale, 0), (12 * scale, 180), (30 * scale, 0))
    return wires_of([hook, line((20 * scale, -6), (20 * scale, 30 * scale))])


@functools.cache
def guide(scale: float = 1.0, name: str = "hook") -> Guide:
    mine = wires(scale)
    config = Config(drawing="x", jigs=["sheet"])
    made = make(mine, config)
    pages = [made.page] if made.page is not None else []
    held = Held(made.handling, made.findings)
    return plan_guide(mine, GuideConfig(), WireConfig(), name=name, held=held, pages=pages)


def pages(settings: GuideConfig, scale: float = 1.0) -> list[Any]:
    printed, findings = write_print(guide(scale), settings)
    assert findings == ()
    return list(pdfplumber.open(io.BytesIO(printed)).pages)


def words(page: Any) -> str:
    return " ".join(page.extract_text().split())


@pytest.mark.parametrize(("paper", "size_mm"), [("A4", (210.0, 297.0)), ("letter", (215.9, 279.4))])
def test_check_lines_are_as_long_as_they_say(paper: str, size_mm: tuple[float, float]) -> None:
    (page,) = [each for each in pages(GuideConfig(paper=paper)) if "true size" in words(each)]
    assert (page.width / MM, page.height / MM) == pytest.approx(size_mm, abs=0.1)
    across = [each["width"] / MM for each in page.lines if abs(each["height"]) < 1e-6]
    assert min(abs(width - 50.0) for width in across) < 0.01
    assert min(abs(width - 50.8) for width in across) < 0.01


def test_the_piece_has_its_size() -> None:
    (page,) = [each for each in pages(GuideConfig()) if "true size" in words(each)]
    colours = {wire.colour.lower() for wire in wires()}
    drawn = [each for each in page.curves + page.lines if _hex(each["stroking_color"]) in colours]
    assert drawn
    thick = max(each["linewidth"] for each in drawn)
    # Line widths are counted in the picture's millimetres, ends of curves are on the page.
    width = max(each["x1"] for each in drawn) - min(each["x0"] for each in drawn)
    height = max(each["y1"] for each in drawn) - min(each["y0"] for each in drawn)
    assert thick in (pytest.approx(wires()[0].diameter_mm), pytest.approx(wires()[0].diameter_mm * MM))
    x, y = size_mm(wires())
    diameter = wires()[0].diameter_mm
    assert width / MM + diameter == pytest.approx(x, abs=0.2)
    assert height / MM + diameter == pytest.approx(y, abs=0.2)


def test_strips_are_as_long_as_the_wires() -> None:
    (page,) = [each for each in pages(GuideConfig()) if "Ruler strips" in words(each)]
    # Each row begins and ends with thick strokes where the wire was cut, or goes on in the next.
    cuts = [each for each in page.lines if each["linewidth"] == 1.0 and abs(each["width"]) < 1e-6]
    rows: dict[int, list[float]] = {}
    for each in cuts:
        rows.setdefault(round(each["top"]), []).append(each["x0"] / MM)
    whole = sorted(max(xs) - min(xs) for xs in rows.values() if len(xs) == 2)
    short = sorted(wire.cut_length_mm for wire in wires() if wire.cut_length_mm <= 186)
    assert whole == pytest.approx(short, abs=0.1)
    assert short
    long = [wire for wire in wires() if wire.cut_length_mm > 186]
    parted = [xs for xs in rows.values() if len(xs) == 1]
    assert len(parted) == 2 * len(long)


def test_a_large_piece_goes_over_several_pages() -> None:
    large = [each for each in pages(GuideConfig(), 5.0) if "true size" in words(each)]
    assert len(large) > 1
    assert all(f"part {index} of {len(large)}" in words(each) for index, each in enumerate(large, start=1))


def test_same_guide_same_bytes() -> None:
    assert write_print(guide(), GuideConfig())[0] == write_print(guide(), GuideConfig())[0]


def test_print_and_page_say_the_same_in_both_languages() -> None:
    for language in ("en", "de"):
        settings = GuideConfig(language=language)
        text = " ".join(words(page) for page in pages(settings)).replace("- ", "-")
        html = write_page(guide(), settings)
        steps = re.findall(r'<h3><span class="number">(\d+)</span> ([^<]+)</h3>', html)
        assert len(steps) == len(guide().steps)
        for number, heading in steps:
            assert f"{number}. {heading}".replace("\u00a0", " ") in text.replace("\u00a0", " ")


def test_names_in_other_scripts_and_with_markup_stay_as_they_are() -> None:
    for name in ("бабочка & <b>Łódź</b>", "ευχή"):
        printed, findings = write_print(guide(name=name), GuideConfig())
        assert findings == ()
        assert name in words(pdfplumber.open(io.BytesIO(printed)).pages[0])
    _, findings = write_print(guide(name="蝶"), GuideConfig())
    assert [each.code for each in findings] == ["letters-missing"]


def _hex(colour: Any) -> str:
    return "#" + "".join(f"{round(255 * each):02x}" for each in colour) if colour and len(colour) == 3 else ""
