"""A drawing that was made fit lies over what it was; both numberings can be read, and each change is told."""

from __future__ import annotations

import dataclasses
import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.exports.pieces_for_tests import drawing_of
from tests.exports.svg_for_tests import NS, box, collide, root_of, texts
from wrapit.config import Config
from wrapit.drawing.model import Drawing, Removal
from wrapit.exports.before_fit import MOST_LINES, NUMBER, changes, listed, renumbered
from wrapit.exports.drawing_svg import drawing_svg
from wrapit.fit.model import Fitted
from wrapit.fit.stage import make_fit
from wrapit.geometry import straight


def star(arms: int, seed: int) -> Drawing:
    """Lines between places around a middle, and to it."""
    rng = np.random.default_rng(seed)
    angles = np.arange(arms) * 2 * np.pi / arms
    rim = np.column_stack([np.cos(angles), np.sin(angles)]) * rng.uniform(12, 24, (arms, 1))
    curves = [straight(rim[a], rim[(a + 1) % arms]) for a in range(arms)]
    curves += [straight(place, np.zeros(2)) for place in rim]
    return drawing_of(curves, removed=(Removal("spur", (1.0, 1.0), 0.4),))


def dropped(drawing: Drawing, numbers: tuple[int, ...]) -> Fitted:
    return make_fit(drawing, Config(drawing="x.svg", drop=numbers))[0]


@settings(max_examples=20)
@given(st.integers(4, 12), st.data())
def test_no_two_numbers_overlap_and_none_is_missing(arms: int, data: st.DataObject) -> None:
    drawing = star(arms, data.draw(st.integers(0, 99)))
    numbers = data.draw(st.sets(st.integers(0, 2 * arms - 1), min_size=1, max_size=2 * arms - 1))
    fitted = dropped(drawing, tuple(numbers))
    root = root_of(drawing_svg(fitted.drawing, fitted))
    shown = [text for text in texts(root) if (text.text or "").isdigit()]
    grey = {int(text.text or "") for text in shown if text.get("fill") == NUMBER}
    assert grey == {segment.id for segment in renumbered(fitted)}
    assert grey >= numbers
    assert len(shown) == len(grey) + len(fitted.drawing.segments) + len(fitted.drawing.junctions)
    boxes = [box(text) for text in shown]
    assert not any(collide(a, b) for a, b in itertools.combinations(boxes, 2))
    width, height = (float(root.get(key, "").removesuffix("mm")) for key in ("width", "height"))
    for text in texts(root):
        x, y = (float(text.get(key, "nan")) for key in ("x", "y"))
        assert 0 <= x <= width
        assert 0 <= y <= height


def test_numbers_that_are_the_same_are_written_once() -> None:
    drawing = star(6, 1)
    fitted = dropped(drawing, (11,))
    assert 11 in {segment.id for segment in renumbered(fitted)}
    kept = {segment.id for segment in drawing.segments} - {segment.id for segment in renumbered(fitted)}
    for number in kept:
        one, other = drawing.segments[number].curve, fitted.drawing.segments[number].curve
        assert min(abs(one.start - other.start).max(), abs(one.start - other.end).max()) < 1e-6
    assert renumbered(dropped(drawing, ())) == ()


def test_the_original_lies_beneath_in_its_own_place() -> None:
    fitted = dropped(star(5, 2), (3,))
    root = root_of(drawing_svg(fitted.drawing, fitted))
    ids = [path.get("id", "") for path in root.iter(f"{NS}path")]
    first_ink = next(index for index, name in enumerate(ids) if name.startswith("segment-"))
    beneath = {name for name in ids[:first_ink] if name.startswith("original-")}
    assert beneath == {f"original-{segment.id}" for segment in fitted.original.segments}
    crosses = root.findall(f".//{NS}path[@class='removed']")
    assert len(crosses) == len(fitted.drawing.removed) == 2
    said = " ".join(text.text or "" for text in texts(root))
    assert "changed by clean-up: 1 × spur" in said
    assert "changed to be fit: 1 × dropped" in said.replace("   ", " ")
    assert "as the config says" in said


def test_nothing_of_it_without_fit() -> None:
    drawing = star(5, 2)
    root = root_of(drawing_svg(drawing))
    assert not [path for path in root.iter(f"{NS}path") if path.get("id", "").startswith("original-")]
    assert not [text for text in texts(root) if text.get("fill") == NUMBER]


@given(st.integers(0, 90), st.integers(20, 400), st.text("abc ", max_size=120))
def test_the_list_is_short_and_counts_the_rest(count: int, width_mm: int, reason: str) -> None:
    removals = [Removal("merged", (1.0, index), 2.5, reason.strip()) for index in range(count)]
    lines = listed(removals, float(width_mm), 1.0)
    assert len(lines) <= MOST_LINES + 1
    told = sum(line.startswith("at (") for line in lines)
    left = int(lines[-1].split()[1]) if lines and lines[-1].endswith(" more") else 0
    assert told + left == count


@pytest.mark.parametrize("count", [3, 200])
def test_the_page_grows_with_what_is_told(count: int) -> None:
    fitted = dropped(star(8, 4), (1,))
    told = tuple(Removal("faired", (float(index % 9), 1.0), 1.5, "a bend < 2 mm") for index in range(count))
    drawing = dataclasses.replace(fitted.drawing, removed=(*fitted.drawing.removed, *told))
    more = dataclasses.replace(fitted, drawing=drawing)
    assert len(changes(more)) == count + 1
    root, plain = root_of(drawing_svg(drawing, more)), root_of(drawing_svg(drawing))
    height, usual = (float(each.get("height", "").removesuffix("mm")) for each in (root, plain))
    assert usual < height < usual + 120
    said = [text.text or "" for text in texts(root)]
    assert any(line.startswith("and ") and line.endswith(" more") for line in said) == (count > MOST_LINES)


def test_crowded_numbers_of_before_are_told_to_the_pointer() -> None:
    fitted = dropped(star(80, 3), tuple(range(0, 160, 2)))
    root = root_of(drawing_svg(fitted.drawing, fitted))
    tips = {title.text for title in root.iter(f"{NS}title")}
    assert {f"segment {segment.id} as it was read" for segment in fitted.original.segments} <= tips
    boxes = [box(text) for text in texts(root) if (text.text or "").isdigit()]
    assert not any(collide(a, b) for a, b in itertools.combinations(boxes, 2))
