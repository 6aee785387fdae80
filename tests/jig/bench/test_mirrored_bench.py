"""The mirror image of a jig on the bench is that of each of its parts; twice is the jig again."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from tests.jig.metal import arcs, line, wires_of
from wrapit.config import Config
from wrapit.geometry.outlines.polygons import polygon_of
from wrapit.jig.bench.mirrored_bench import mirrored_handling
from wrapit.jig.bench.model import Contact
from wrapit.jig.bench.touching import contacts
from wrapit.jig.channel import Channels
from wrapit.jig.sheet.sheet_kind import make


def test_walls_wires_and_sides_are_exchanged() -> None:
    wires = wires_of([arcs((0, 0), 0, (15, 0), (9, 180), (1.2, -150), (15, 0)), line((-5, 9), (25, 9))])
    config = Config(drawing="x", jigs=["sheet"])
    handling = make(wires, config).handling
    assert handling is not None
    other, again = mirrored_handling(handling), mirrored_handling(mirrored_handling(handling))
    reach_mm = Channels.of(wires, config.jig).reach_mm
    for bench, image, same in zip(handling.benches, other.benches, again.benches, strict=True):
        for wall, flipped, back in zip(bench.walls, image.walls, same.walls, strict=True):
            there, here = polygon_of(wall, 0.01), polygon_of(flipped, 0.01)
            exact = shapely.affinity.scale(there, xfact=-1, origin=(0, 0))
            assert here.is_valid
            assert exact.symmetric_difference(here).area < 0.01 * exact.area
            assert polygon_of(back, 0.01).area == pytest.approx(there.area)
        for wire, mirror in zip(bench.wires, image.wires, strict=True):
            assert np.allclose(wire.centreline.poles * [-1, 1], mirror.centreline.poles)
            # What is found anew round the mirrored walls is what was exchanged.
            pins = {each.index for each in image.contacts[wire.name] if each.around == "pin"}
            found = [each for each in contacts(mirror, image.walls, reach_mm) if each.index not in pins]
            told = [each for each in image.contacts[wire.name] if each.around == "wall"]
            for each, anew in zip(sorted(told, key=where), sorted(found, key=where), strict=True):
                assert (each.side, each.index) == (anew.side, anew.index)
                assert each.start_mm == pytest.approx(anew.start_mm, abs=0.21)
                assert each.end_mm == pytest.approx(anew.end_mm, abs=0.21)


def where(contact: Contact) -> tuple[int, float]:
    return contact.index, contact.start_mm
