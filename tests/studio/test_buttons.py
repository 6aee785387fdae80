"""Pressing a button does away with what it stands beside, or makes it less."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from tests.studio.running import PICTURE, Studio, running

LOOP = PICTURE.replace("M 5 20 C 5 0 45 0 45 20 C 45 40 5 40 5 20 Z M 45 20 L 60 20", "{}")
PEGS = "drawing: leaf.svg\njigs: [pegs]\noutputs: [svg]\n"
SAMPLES = {
    "unheld": (PICTURE, f"{PEGS}size: 12 mm\njig: {{least_support: 0.99}}\npegs: {{diameters: [3 mm]}}\n"),
    "tight-bend": (
        LOOP.format("M 5 20 C 30 0 30 40 5 20 M 5 20 L 55 20"),
        f"{PEGS}size: 20 mm\nwire: {{gauge: 12 AWG, temper: hard}}\njig: {{least_support: 0}}\n",
    ),
    "left-out": (LOOP.format("M 5 20 C 5 0 45 0 45 20 M 5 30 C 5 35 45 35 45 30"), f"{PEGS}size: 60 mm\n"),
}


def made(studio: Studio) -> dict[str, Any]:
    return studio.until(lambda state: state["fresh"] or state["problem"])


def badness(state: dict[str, Any], code: str) -> tuple[int, int, int]:
    """How bad it is: that it can't be built, errors, and how many there are."""
    alike = [each["level"] for each in state["findings"] if each["code"] == code]
    stopped = state["problem"] is not None and state["problem"]["code"] == code
    return stopped, alike.count("error"), len(alike)


@pytest.mark.parametrize("code", SAMPLES)
def test_a_button_helps(tmp_path: Path, code: str) -> None:
    picture, config = SAMPLES[code]
    (tmp_path / "leaf.svg").write_text(picture)
    (tmp_path / "leaf.yaml").write_text(config)
    with running(tmp_path, "leaf.yaml") as studio:
        state = made(studio)
        before = badness(state, code)
        told = [each for each in (state["problem"], *state["findings"]) if each and each["code"] == code]
        fixes = {fix["label"]: fix["change"] for each in told for fix in each["fixes"]}
        assert fixes
        for label, change in fixes.items():
            assert studio.post("/change", change)[0] == 200, label
            assert badness(made(studio), code) < before, label
            assert studio.post("/undo", {})[0] == 200
