"""Choices side by side: each picture whole, none over another, each with what it costs."""

from __future__ import annotations

import re

import pytest

from tests.exports.pieces_for_tests import eye
from tests.exports.svg_for_tests import NS, root_of, texts
from wrapit.exports.alternatives_svg import GAP_MM, alternatives_svg
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
