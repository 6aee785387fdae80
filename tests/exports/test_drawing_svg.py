"""The drawing is true to size, complete, readable and the same each time."""

from __future__ import annotations

import itertools
import re
import xml.etree.ElementTree as ET

import numpy as np
import pytest

from tests.exports.pieces_for_tests import drawing_of, eye
from tests.exports.svg_for_tests import NS, box, collide, root_of, texts
from wrapit.drawing.model import Removal
from wrapit.exports.drawing_svg import drawing_svg
from wrapit.geometry import FloatArray, label_places, straight
from wrapit.geometry.arrays import IntArray
from wrapit.geometry.label_places import place_labels


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


def test_markup_in_a_reason_is_escaped() -> None:
    drawing = drawing_of([straight((0, 0), (10, 0))], removed=(Removal("<spur>", (1, 1), 0.5, 'a & "b"'),))
    root = root_of(drawing_svg(drawing))
    assert "<spur>" in "".join(root.itertext())


def test_same_input_gives_the_same_bytes() -> None:
    (first, _), (second, _) = eye(), eye()
    assert drawing_svg(first.decomposition.drawing) == drawing_svg(second.decomposition.drawing)


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
