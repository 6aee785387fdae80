"""The wires are numbered, in their colours, and the same each time."""

from __future__ import annotations

import tempfile
from pathlib import Path

import pytest

from tests.bench.large_drawings import drawing_text
from tests.exports.pieces_for_tests import eye
from tests.exports.svg_for_tests import NS, root_of, texts
from wrapit import decompose, draw_wires
from wrapit.drawing.json_file import read_drawing
from wrapit.exports.decomposition_svg import decomposition_svg
from wrapit.exports.svgpage import MANY_LABELS


def test_wires_are_numbered_and_doubled_segments_drawn_twice() -> None:
    solution, _ = eye()
    wires, _ = draw_wires(solution)
    assert solution.doubled == (4,)
    root = root_of(decomposition_svg(solution, wires))
    groups = {group.get("id"): group for group in root.iter(f"{NS}g")}
    assert groups["wire-01"].get("stroke") == wires[0].colour
    assert [text.text for text in texts(root)] == ["1", "2"]
    # The stem out, round the eye, the stem back: both passes of the stem are drawn side by side, as they lie.
    (run,) = (path.get("d", "") for path in groups["wire-01"].iter(f"{NS}path"))
    ends = [place.split(",") for place in (run[1 : run.index("C")], run.split(" ")[-1])]
    assert float(ends[0][0]) == pytest.approx(float(ends[1][0]), abs=1e-3)
    aside = abs(float(ends[0][1]) - float(ends[1][1]))
    assert aside == pytest.approx(1.02 * wires[0].diameter_mm, abs=1e-3)
    assert len(root.findall(f".//{NS}circle[@class='end']")) == 3  # the closed wire has one


def test_same_input_gives_the_same_bytes() -> None:
    first, second = eye(), eye()
    assert decomposition_svg(*first) == decomposition_svg(*second)


def test_very_many_wires_have_small_numbers_or_say_them_where_the_pointer_rests() -> None:
    text = drawing_text("strands", 260, 60)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "strands.json"
        path.write_text(text)
        drawing = read_drawing(path)
    solution, _ = decompose(drawing)
    wires, _ = draw_wires(solution)
    assert len(wires) > MANY_LABELS
    root = root_of(decomposition_svg(solution, wires))
    titles = [title.text for group in root.iter(f"{NS}g") for title in group.findall(f"{NS}title")]
    assert titles == [f"wire {wire.number}" for wire in wires]
    shown = [element.text for element in texts(root)]
    assert len(shown) == len(set(shown)) > MANY_LABELS / 2
    width, height = (float(root.get(side, "").removesuffix("mm")) for side in ("width", "height"))
    assert max(width, height) < 75  # numbers stay by the drawing
