"""What can't be made where two runs lie side by side is said, or refused."""

from __future__ import annotations

from dataclasses import replace

import pytest

from tests.jig.paired.pairs import ARC, STRAIGHT, hairpin, two_wires
from wrapit.config import Config, JigConfig, PlateConfig
from wrapit.errors import JigError
from wrapit.jig.overbending import overbend_wires
from wrapit.jig.printed.planning import plan_jigs
from wrapit.jig.sheet.stage import plan_stacks
from wrapit.wires.model import WireBead

# On a wire that has the other run on its left from 0 to 40 mm.
BEADS = [
    (WireBead(20, 3.0), True),
    (WireBead(20, 3.0, aside_mm=2.5), True),
    (WireBead(20, 3.0, aside_mm=-2.5), False),
    (WireBead(45, 3.0), False),
]


@pytest.mark.parametrize(("bead", "told"), BEADS)
def test_a_bead_where_another_run_lies_is_told(bead: WireBead, told: bool) -> None:
    wire = replace(hairpin(STRAIGHT), beads=(bead,))
    for findings in (
        plan_jigs((wire,), JigConfig())[1],
        plan_stacks((wire,), JigConfig(), PlateConfig())[2],
    ):
        places = [each.places_mm for each in findings if each.code == "bead-between-runs"]
        assert places == ([(bead.at_mm,)] if told else [])


def test_a_wire_beside_itself_can_t_be_bent_further() -> None:
    config = Config.model_validate({"drawing": "a.svg", "name": "a", "jig": {"springback": "compensate"}})
    with pytest.raises(JigError, match="wire-01 comes to lie beside itself"):
        overbend_wires((hairpin(ARC),), config)
    # Two wires each have a jig of their own.
    bent, _ = overbend_wires(two_wires(ARC), config)
    assert len(bent) == 2
