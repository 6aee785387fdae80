"""Jigs that make up for springback."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely

from tests.jig.metal import arcs, circle, config, wires_of
from wrapit.errors import JigError
from wrapit.geometry.outlines.polygons import polygon_of
from wrapit.jig.printed.stage import build_jig
from wrapit.wires.springback import overbend

LOSS = 3.395 * 200 / (117e3 * 1.0)  # half-hard copper of 1 mm


def test_walls_bend_the_wire_to_the_tighter_radius() -> None:
    settings = config(springback="compensate")
    (drawn,) = wires_of([arcs((0, 0), 0, (10, 0), (10, 120), (10, 0))], settings, diameter_mm=1.0)
    over = overbend(drawn, LOSS, settings)
    jigs, _ = build_jig((over.wire,), settings)
    (jig,) = jigs.jigs
    assert jigs.overbent
    assert jig.valid
    assert jig.support[0].share > 0.99
    # Three points of the wall's face give its circle: 1 / (1/10 + loss) less half the wire and 0.1 mm.
    (wall,) = jig.walls
    lengths = [15.0, 20.0, 25.0]
    line = over.wire.centreline
    from wrapit.geometry.arclength import ArcLength

    u = ArcLength(line).parameter(np.array(lengths))
    tangent = line.derivative(u)
    left = np.column_stack([-tangent[:, 1], tangent[:, 0]]) / np.linalg.norm(tangent, axis=1)[:, None]
    face = polygon_of(wall, 1e-4).exterior
    points = [
        np.array(face.intersection(shapely.LineString([p, p + 2 * n])).coords[0])
        for p, n in zip(line.at(u), left, strict=True)
    ]
    assert _circle_radius(*points) == pytest.approx(1 / (0.1 + LOSS) - 0.6, abs=0.01)


def test_overbent_wires_have_a_jig_each() -> None:
    settings = config(springback="compensate")
    wires = wires_of([circle(9), circle(8, (40, 0))])
    jigs, _ = build_jig(wires, settings)
    assert jigs.split == "per-wire"
    assert [jig.wires for jig in jigs.jigs] == [("wire-01",), ("wire-02",)]
    with pytest.raises(JigError, match=r"jig\.split"):
        build_jig(wires, config(springback="compensate", split="single"))
    alone, _ = build_jig(wires[:1], config(springback="compensate", split="single"))
    assert alone.split == "single"


def _circle_radius(a: np.ndarray, b: np.ndarray, c: np.ndarray) -> float:
    sides = [math.dist(a, b), math.dist(b, c), math.dist(c, a)]
    area = abs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2
    return math.prod(sides) / (4 * area)
