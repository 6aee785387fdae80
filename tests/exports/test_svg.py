"""The SVGs are true to size, complete, readable and the same each time."""

from __future__ import annotations

import itertools
import re
import xml.etree.ElementTree as ET

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.exports.pieces_for_tests import drawing_of, eye
from wrapit.drawing.model import Removal
from wrapit.exports.decomposition_svg import decomposition_svg
from wrapit.exports.drawing_svg import drawing_svg
from wrapit.exports.svgpage import anchors
from wrapit.geometry import FloatArray, joined, label_places, straight
from wrapit.geometry.arrays import IntArray
from wrapit.geometry.label_places import place_labels

NS = "{http://www.w3.org/2000/svg}"


def root_of(svg: str) -> ET.Element:
    return ET.fromstring(svg)


def texts(root: ET.Element) -> list[ET.Element]:
    return list(root.iter(f"{NS}text"))


def box(text: ET.Element) -> tuple[float, float, float, float]:
    size, x, y = (float(text.get(key, "nan")) for key in ("font-size", "x", "y"))
    half = 0.31 * size * len(text.text or "")
    return x - half, y - 0.75 * size, x + half, y + 0.05 * size


def collide(a: tuple[float, ...], b: tuple[float, ...]) -> bool:
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]


def test_drawing_is_at_true_size_and_complete() -> None:
    solution, _ = eye()
    drawing = solution.decomposition.drawing
    root = root_of(drawing_svg(drawing))
    width, height = (float(root.get(key, "").removesuffix("mm")) for key in ("width", "height"))
    assert root.get("viewBox") == f"0 0 {root.get('width')} {root.get('height')}".replace("mm", "")
    low, high = drawing.bounds_mm
    assert width > high[0] - low[0]
    assert height > high[1] - low[1]
    stem = root.find(f".//{NS}path[@id='segment-4']")
    assert stem is not None
    numbers = [float(value) for value in re.findall(r"-?\d+\.?\d*", stem.get("d", ""))]
    assert numbers[-2] - numbers[0] == pytest.approx(12.0, abs=1e-3)
    assert len(root.findall(f".//{NS}path[@class='removed']")) == 1
    assert "spur" in ET.tostring(root, encoding="unicode")


def test_numbers_are_all_there_and_never_collide() -> None:
    rng = np.random.default_rng(3)
    points = rng.uniform(0, 30, (14, 2))
    drawing = drawing_of([straight(points[a], points[b]) for a, b in itertools.combinations(range(9), 2)])
    root = root_of(drawing_svg(drawing))
    numbers = [text for text in texts(root) if (text.text or "").isdigit()]
    assert len(numbers) == len(drawing.segments) + len(drawing.junctions)
    boxes = [box(text) for text in numbers]
    assert not any(collide(a, b) for a, b in itertools.combinations(boxes, 2))
    width, height = (float(root.get(key, "").removesuffix("mm")) for key in ("width", "height"))
    assert all(a >= 0 and b >= 0 and c <= width and d <= height for a, b, c, d in boxes)


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 2**32), st.integers(1, 40))
def test_labels_never_overlap(seed: int, count: int) -> None:
    points = np.random.default_rng(seed).uniform(0, 10, (count, 2))
    labels = place_labels([(str(index), point[None]) for index, point in enumerate(points)], points, 1.0)
    for a, b in itertools.combinations(labels, 2):
        apart = np.abs(np.subtract(a.centre, b.centre)) >= np.add(a.half_size, b.half_size) - 1e-9
        assert apart.any()


def test_a_number_is_beside_the_share_of_its_curve() -> None:
    curve = joined([straight((0, 0), (30, 0)), straight((30, 0), (30, 10))])
    places = [(20, 0), (16, 0), (24, 0), (12, 0), (28, 0), (8, 0), (30, 2)]
    for quickly in (False, True):
        assert anchors(curve, quickly=quickly) == pytest.approx(np.array(places), abs=1e-6)


def test_labels_look_only_at_what_is_near(monkeypatch: pytest.MonkeyPatch) -> None:
    looked_at: list[int] = []
    hits = label_places._hits

    def counted(centres: FloatArray, half: FloatArray, ink: FloatArray) -> IntArray:
        looked_at.append(len(ink))
        return hits(centres, half, ink)

    monkeypatch.setattr(label_places, "_hits", counted)
    side = 20
    places = 4.0 * np.array(list(itertools.product(range(side), range(side))))
    ink = 0.5 * np.array(list(itertools.product(range(8 * side), range(8 * side))))
    labels = place_labels([(str(index), place[None]) for index, place in enumerate(places)], ink, 1.5)
    assert len(labels) == side**2
    assert np.median(looked_at) < 0.05 * len(ink)


def test_a_crowded_drawing_tells_numbers_to_the_pointer() -> None:
    rng = np.random.default_rng(5)
    points = rng.uniform(0, 60, (24, 2))
    drawing = drawing_of([straight(points[a], points[b]) for a, b in itertools.combinations(range(24), 2)])
    root = root_of(drawing_svg(drawing))
    tips = {title.text for title in root.iter(f"{NS}title")}
    assert {f"segment {segment.id}" for segment in drawing.segments} <= tips
    assert {f"junction {junction.id}" for junction in drawing.junctions} <= tips
    numbers = [text for text in texts(root) if (text.text or "").isdigit()]
    assert 0 < len(numbers) <= len(drawing.segments) + len(drawing.junctions)
    boxes = [box(text) for text in numbers]
    assert not any(collide(a, b) for a, b in itertools.combinations(boxes, 2))


def test_markup_in_a_reason_is_escaped() -> None:
    drawing = drawing_of([straight((0, 0), (10, 0))], removed=(Removal("<spur>", (1, 1), 0.5, 'a & "b"'),))
    root = root_of(drawing_svg(drawing))
    assert "<spur>" in "".join(root.itertext())


def test_wires_are_numbered_and_doubled_segments_drawn_twice() -> None:
    solution, wires = eye()
    assert solution.doubled == (4,)
    root = root_of(decomposition_svg(solution, wires))
    groups = {group.get("id"): group for group in root.iter(f"{NS}g")}
    assert groups["wire-01"].get("stroke") == wires[0].colour
    assert [text.text for text in texts(root)] == ["1", "2"]
    # The stem out, round the eye, the stem back: three runs, of which the passes of the stem lie apart.
    runs = [path.get("d", "") for path in groups["wire-01"].iter(f"{NS}path")]
    assert len(runs) == 3
    heights = [float(run.split("L")[1].split(",")[1]) for run in (runs[0], runs[2])]
    assert abs(heights[0] - heights[1]) == pytest.approx(1.1 * wires[0].diameter_mm, abs=1e-3)
    assert len(root.findall(f".//{NS}circle[@class='end']")) == 3  # the closed wire has one


def test_same_input_gives_the_same_bytes() -> None:
    (first, first_wires), (second, second_wires) = eye(), eye()
    assert drawing_svg(first.decomposition.drawing) == drawing_svg(second.decomposition.drawing)
    assert decomposition_svg(first, first_wires) == decomposition_svg(second, second_wires)
