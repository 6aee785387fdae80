"""The report agrees with itself."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from tests.conftest import CONFIGS
from wrapit.pipeline.build import Build

NAMES = sorted(path.stem for path in CONFIGS.glob("*.yaml"))


@pytest.mark.parametrize("name", NAMES)
def test_each_turn_is_listed_with_its_support(piece: Callable[[str], Build], name: str) -> None:
    report = piece(name).report
    turns = report["jig"]["turns"]
    assert {turn["inside"] for turn in turns} <= {"left", "right"}
    lengths = [turn["to_mm"] - turn["from_mm"] for turn in turns]
    held = sum(length * turn["support"] for length, turn in zip(lengths, turns, strict=True))
    assert held / sum(lengths) == pytest.approx(report["jig"]["turn_support"], abs=1e-3)
    bent, doubled = sum(wire["turns"] for wire in report["wires"]), len(report["decomposition"]["doubled"])
    # Where a wire is bent round the run that lies there already, there is no wall to list.
    assert bent - doubled <= len(turns) <= bent
