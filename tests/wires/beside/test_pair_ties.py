"""Two runs side by side are tied to one another on their way, in any drawing."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import wrapit
from wrapit.geometry.arclength import ArcLength
from wrapit.wires.beside.pair_ties import EVERY_MM
from wrapit.wires.model import Wire

CONFIGS = Path(__file__).parents[3] / "configs"


@pytest.fixture(scope="module", params=[("butterfly", 60.0), ("tree-of-life", 150.0)])
def one_line(request: pytest.FixtureRequest) -> tuple[Wire, int]:
    name, size_mm = request.param
    config = wrapit.load_config(CONFIGS / f"{name}.yaml").model_copy(update={"size": size_mm})
    wanted = config.decomposition.model_copy(update={"max_wires": 1})
    config = config.model_copy(update={"decomposition": wanted})
    drawing, _ = wrapit.trace(CONFIGS / Path(config.drawing).name, config)
    (wire,), _ = wrapit.draw_wires(wrapit.decompose(drawing, config)[0], config)
    return wire, len(drawing.junctions)


def test_no_stretch_gapes_between_ties(one_line: tuple[Wire, int]) -> None:
    wire, _ = one_line
    assert any(run.end_mm - run.start_mm > EVERY_MM for run in wire.doubles), "nothing to tie"
    for run in wire.doubles:
        if run.first:
            inside = [tie.at_mm for tie in wire.bindings if run.start_mm < tie.at_mm < run.end_mm]
            gaps = np.diff([run.start_mm, *inside, run.end_mm])
            assert gaps.max() <= EVERY_MM


def test_a_tie_is_of_both_runs_and_lies_between_them(one_line: tuple[Wire, int]) -> None:
    wire, junctions = one_line
    lengths = ArcLength(wire.centreline)
    between = {tie.junction for tie in wire.bindings if tie.junction >= junctions}
    assert between
    for number in between:
        ties = [tie for tie in wire.bindings if tie.junction == number]
        assert len(ties) == 2
        assert {tie.point for tie in ties} == {ties[0].point}
        for tie in ties:
            at = wire.centreline.at(lengths.parameter(np.array([tie.at_mm])))[0]
            assert np.hypot(*(at - tie.point)) < 0.6 * wire.diameter_mm


def test_wires_alone_have_no_such_ties() -> None:
    config = wrapit.load_config(CONFIGS / "butterfly.yaml")
    drawing, _ = wrapit.trace(CONFIGS / "butterfly.png", config)
    wires, _ = wrapit.draw_wires(wrapit.decompose(drawing, config)[0], config)
    assert all(tie.junction < len(drawing.junctions) for wire in wires for tie in wire.bindings)
