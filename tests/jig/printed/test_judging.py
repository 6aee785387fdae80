"""The kernel's booleans judge the finished jigs: they have nothing in common with wires and channels."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.conftest import CONFIGS
from tests.jig.metal import arcs, line, wires_of
from wrapit import check
from wrapit.config import Config
from wrapit.errors import KernelError
from wrapit.geometry import BSpline
from wrapit.jig.made import Made, Wires, file_stem
from wrapit.jig.printed.judging import judged
from wrapit.jig.printed.printed_kind import make
from wrapit.kernel.measures import solids_of
from wrapit.pipeline.build import Build, build
from wrapit.pipeline.work import Work

CONFIG = Config(drawing="drawing.svg", jigs=("printed",))
# Of those that are opened in other programs, these differ in what booleans see: six wires in one jig, walls
# close together, one wire that crosses itself, several jigs. A boolean takes the longer the more faces jig
# and wire have: those of the mandala's 16 wires took a minute, and the three pieces that are left out
# (mandala, lotus, butterfly: several wires in one jig, as the bee's) half as long again as these four.
JUDGED = ("bee", "dolphin", "heart-knot", "leaf")


def crossing_wires() -> Wires:
    return tuple(wires_of([arcs((0, 0), 0, (15, 0), (4, 180), (15, 0)), line((7, -6), (8, 15))]))


@pytest.fixture(scope="module")
def jig() -> tuple[Made, Wires]:
    wires = crossing_wires()
    return make(wires, CONFIG), wires


def test_a_sound_jig_has_nothing_in_common_with_its_wires(jig: tuple[Made, Wires]) -> None:
    made, wires = jig
    assert judged(made, wires, CONFIG).numbers["interference_mm3"] == 0


@pytest.mark.parametrize("by_mm", [0.2, 0.5, 1.5])
def test_a_wire_laid_beside_its_channel_is_noticed(jig: tuple[Made, Wires], by_mm: float) -> None:
    """Less than the clearance is noticed by the channel alone, more by the wire itself."""
    made, wires = jig
    first = wires[0].centreline
    beside = BSpline(first.degree, first.poles + np.array([by_mm, by_mm]), first.knots)
    with pytest.raises(KernelError, match=r"wire-0\d.* in common"):
        judged(made, (dataclasses.replace(wires[0], centreline=beside), *wires[1:]), CONFIG)


def test_a_wire_in_the_plate_is_noticed(jig: tuple[Made, Wires]) -> None:
    made, wires = jig
    thicker = Config(drawing="drawing.svg", jigs=("printed",), jig={"base_thickness": "1.8 mm"})
    with pytest.raises(KernelError, match="in common"):
        judged(made, wires, thicker)


@pytest.mark.parametrize("name", JUDGED)
@pytest.mark.usefixtures("recalling")
def test_our_pieces_are_judged(piece: Callable[[str], Build], tmp_path: Path, name: str) -> None:
    """As their files have them, which tests of this session wrote: plans and wires are recalled."""
    folder = piece(name).folder
    assert folder is not None
    works: list[Work] = []
    build(CONFIGS / f"{name}.yaml", tmp_path / name, after=lambda _, work: works.append(work))
    work = works[-1]
    assert work.made is not None
    made = work.made["printed"]
    parts = tuple(
        dataclasses.replace(part, solid=solid_in(folder / f"{file_stem(part.name, len(made.parts))}.step"))
        for part in made.parts
    )
    judgement = judged(dataclasses.replace(made, parts=parts), work.laid, work.config)
    assert judgement.numbers["interference_mm3"] == 0
    assert not [finding for finding in judgement.findings if finding.code == "not-judged"]


def solid_in(path: Path) -> Any:
    """The one solid of a STEP file."""
    from OCP.IFSelect import IFSelect_ReturnStatus
    from OCP.STEPControl import STEPControl_Reader

    reader = STEPControl_Reader()
    assert reader.ReadFile(str(path)) == IFSelect_ReturnStatus.IFSelect_RetDone
    reader.TransferRoots()
    (solid,) = solids_of(reader.OneShape())
    return solid


@pytest.mark.usefixtures("recalling")
def test_a_pair_is_judged_as_it_is_checked() -> None:
    report = check(CONFIGS / "earrings.yaml", ["jigs=[printed]"], exact=True).report
    assert report["jig"]["interference_mm3"] == 0
    assert not [finding for finding in report["findings"] if finding["code"] == "not-judged"]
