"""The kernel's booleans judge the finished jigs: they have nothing in common with wires and channels."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from tests.conftest import CONFIGS, OPENED
from tests.jig.metal import arcs, line, wires_of
from wrapit import check
from wrapit.config import Config
from wrapit.errors import KernelError
from wrapit.geometry import BSpline
from wrapit.jig.made import Made, Wires
from wrapit.jig.printed.judging import judged
from wrapit.jig.printed.printed_kind import make

CONFIG = Config(drawing="drawing.svg", jigs=("printed",))


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


@pytest.mark.usefixtures("recalling")
@pytest.mark.parametrize("name", OPENED)
def test_our_pieces_are_judged(name: str) -> None:
    report = check(CONFIGS / f"{name}.yaml", ["jigs=[printed]"], exact=True).report
    assert report["jig"]["interference_mm3"] == 0
    assert not [finding for finding in report["findings"] if finding["code"] == "not-judged"]
