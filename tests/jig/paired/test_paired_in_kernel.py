"""A wire that comes back beside itself, through the kernel: jig and wire have nothing in common."""

from __future__ import annotations

from tests.jig.paired.pairs import S_SHAPE, hairpin
from wrapit.config import Config
from wrapit.jig.printed.judging import judged
from wrapit.jig.printed.printed_kind import make


def test_the_jig_of_a_fold_has_nothing_in_common_with_its_wire_and_channel() -> None:
    config = Config(drawing="drawing.svg", jigs=("printed",))
    wires = (hairpin(S_SHAPE),)
    made = judged(make(wires, config), wires, config)
    assert made.numbers["interference_mm3"] == 0
    assert not [each for each in made.findings if each.level != "note" or each.code == "not-judged"]
    (part,) = made.parts
    assert part.name == "jig"
