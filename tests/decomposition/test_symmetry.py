"""The mirror axis of a drawing, and wires that keep to it."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest

from tests.decomposition.asking import solved
from tests.decomposition.drawings import drawing_of, lotus
from wrapit.decomposition.json_file import decomposition_json
from wrapit.drawing.reflection import mirror_images


@pytest.mark.parametrize("turn", [0.0, 0.4])
def test_the_mirror_axis_is_found(turn: float) -> None:
    rotation = np.array([[math.cos(turn), -math.sin(turn)], [math.sin(turn), math.cos(turn)]])
    plain = lotus()
    turned = drawing_of(
        [tuple(rotation @ junction.point) for junction in plain.junctions],
        [(segment.start, segment.end) for segment in plain.segments],
    )
    mirror = mirror_images(turned, "auto")
    assert [mirror[2 * e] // 2 for e in range(12)] == [0, 2, 1, 4, 3, 6, 5, 8, 7, 10, 9, 11]
    assert mirror[2 * 5] == 2 * 6
    assert all(mirror[mirror[h]] == h for h in range(24))
    if not turn:
        assert mirror_images(turned, "vertical") == mirror
        assert mirror_images(turned, "horizontal") != mirror


def test_symmetry_is_kept_when_it_weighs() -> None:
    loose = solved(lotus())
    kept = solved(lotus(), weights={"symmetry": 3.0})
    assert kept.optimal
    assert kept.energy.asymmetry < max(1, solved(lotus(), weights={"symmetry": 1e-9}).energy.asymmetry)
    assert kept.energy.total >= loose.energy.total - 1e-9


def test_the_file_speaks_of_symmetry_where_it_was_asked_for() -> None:
    plain = json.loads(decomposition_json(solved(lotus())))
    assert "symmetry" not in plain["weights"]
    assert "asymmetry" not in plain["energy"]
    kept = json.loads(decomposition_json(solved(lotus(), weights={"symmetry": 0.5})))
    terms = kept["energy"]
    assert kept["weights"]["symmetry"] == 0.5
    total = terms["complexity"] + 0.1 * terms["smoothness_rad"] + 0.9 * terms["robustness"]
    assert terms["total"] == pytest.approx(total + 0.5 * terms["asymmetry"])
