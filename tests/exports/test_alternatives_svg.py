"""Choices side by side: each picture whole, none over another, each with what it costs."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest

from tests.exports.pieces_for_tests import eye
from tests.exports.svg_for_tests import NS, root_of, texts
from wrapit.decomposition.model import Trail, Traversal
from wrapit.exports.alternatives_svg import GAP_MM, alternatives_svg, fewer_wires_svg
from wrapit.exports.decomposition_svg import decomposition_svg


@pytest.mark.parametrize("count", [1, 2, 5])
def test_each_choice_stands_beside_the_one_before(count: int) -> None:
    choices = [eye()] * count
    root = root_of(alternatives_svg(choices))
    alone = root_of(decomposition_svg(*choices[0]))
    width = float(alone.get("viewBox", "").split()[2])
    pictures = root.findall(f"{NS}svg")
    assert [float(each.get("x", "")) for each in pictures] == pytest.approx(
        [(width + GAP_MM) * index for index in range(count)], abs=1e-2
    )
    assert [each.get("viewBox") for each in pictures] == [alone.get("viewBox")] * count
    assert float(root.get("width", "").removesuffix("mm")) == pytest.approx(
        count * width + (count - 1) * GAP_MM, abs=1e-2
    )


def test_captions_tell_wires_and_energy() -> None:
    solution, wires = eye()
    said = [text.text or "" for text in texts(root_of(alternatives_svg([(solution, wires)])))]
    assert any(line.startswith("choice 1: ") for line in said)
    assert f"energy {solution.energy.total:.3f}" in said


def test_names_are_there_once() -> None:
    text = alternatives_svg([eye(), eye()])
    assert re.findall(r' id="', text) == []


def test_nothing_to_choose_from_is_the_callers_mistake() -> None:
    with pytest.raises(ValueError, match="nothing to choose"):
        alternatives_svg([])


def test_fewer_wires_tell_what_they_cost() -> None:
    solution, wires = eye()
    root = root_of(fewer_wires_svg([(solution, wires)] * 2))
    said = [text.text or "" for text in texts(root)]
    [first, second] = [said[: len(said) // 2], said[len(said) // 2 :]]
    count = f"{len(wires)} wire{'s' if len(wires) > 1 else ''}"
    assert [line for line in first if "max_wires" in line] == ["no max_wires"]
    assert [line for line in second if "max_wires" in line] == [f"max_wires: {len(wires)}"]
    for caption in (first, second):
        assert f"{count}, {solution.doubled_mm:.0f} mm run twice" in caption
        assert f"bends {np.degrees(solution.energy.smoothness_rad):.0f}° in all" in caption
        assert [line for line in caption if line.startswith("wire-")] == [
            f"{wire.name}: {wire.length_mm:.0f} mm" for wire in wires
        ]
    lowest = max(float(text.get("y", "")) for text in texts(root) if text.text in said)
    assert lowest < float(root.get("viewBox", "").split()[3])


@pytest.mark.parametrize("runs", [1, 2, 3])
def test_what_is_run_again_is_counted_once_less(runs: int) -> None:
    solution, _ = eye()
    first, second = solution.decomposition.drawing.segments[:2]
    again = tuple(Traversal(first.id, bool(run % 2)) for run in range(runs))
    trails = (
        Trail((*again, Traversal(second.id, False)), False),
        Trail((Traversal(second.id, True),), False),
    )
    doubled = replace(solution, trails=trails)
    assert doubled.doubled_mm == pytest.approx((runs - 1) * first.curve.length + second.curve.length)
