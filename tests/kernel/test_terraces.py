"""Solids built face by face, against volumes worked out on paper."""

from __future__ import annotations

import math

import pytest

from wrapit.errors import KernelError
from wrapit.geometry import Arc, Line, Loop, Region
from wrapit.kernel.measures import count_solids, is_valid, size_mm
from wrapit.kernel.meshes import mesh_of
from wrapit.kernel.terraces import Terrace, terraced_solid


def disc(x: float, y: float, radius: float) -> Loop:
    return Loop((Arc((x, y), radius, 0.0, 2 * math.pi),))


def box(x0: float, y0: float, x1: float, y1: float) -> Loop:
    corners = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]
    return Loop(tuple(Line(a, b) for a, b in zip(corners, corners[1:] + corners[:1], strict=True)))


def test_plate_with_everything_on_it() -> None:
    ring = Terrace(Region(disc(10, 10, 5), (disc(10, 10, 3),)), 7.0)
    stepped = Terrace(Region(box(20, 2, 30, 12)), 6.0, (Terrace(Region(box(21, 3, 29, 11)), 6.5),))
    pocket = Terrace(Region(box(20, 20, 30, 25)), 2.5)
    inside_ring = Terrace(Region(box(9, 9, 11, 11)), 5.0)
    holes = [disc(35, 5, 1), disc(35, 15, 2)]
    made = terraced_solid(box(0, 0, 40, 30), 0.0, 3.0, [ring, stepped, pocket, inside_ring], holes, "plate")
    expected = 3 * (1200 - 5 * math.pi) + 4 * 16 * math.pi + 300 + 0.5 * 64 - 0.5 * 50 + 2 * 4
    assert made.volume_mm3 == pytest.approx(expected, rel=1e-9)
    assert is_valid(made.solid)
    assert count_solids(made.solid) == 1
    assert size_mm(made.solid) == pytest.approx((40.0, 30.0, 7.0), abs=1e-6)
    mesh = mesh_of([made.solid], 0.01, 0.2)
    assert mesh.open_edges == 0
    assert mesh.volume_mm3 == pytest.approx(expected, rel=1e-3)


def test_clockwise_outlines_are_turned_round() -> None:
    clockwise = Loop(tuple(Line(edge.end, edge.start) for edge in reversed(box(0, 0, 10, 10).edges)))
    made = terraced_solid(clockwise, 0.0, 2.0, [], [disc(5, 5, 1)], "plate")
    assert made.volume_mm3 == pytest.approx(2 * (100 - math.pi))


def test_what_lies_outside_is_an_error_with_the_place() -> None:
    with pytest.raises(KernelError, match="jig seven"):
        terraced_solid(box(0, 0, 10, 10), 0.0, 2.0, [], [disc(30, 5, 1)], "jig seven")


def test_overlapping_terraces_are_refused() -> None:
    overlapping = [Terrace(Region(box(2, 2, 6, 6)), 5.0), Terrace(Region(box(4, 4, 8, 8)), 5.0)]
    with pytest.raises(KernelError):
        terraced_solid(box(0, 0, 10, 10), 0.0, 2.0, overlapping, [], "jig")


def test_an_outline_that_folds_back_becomes_a_polygon_and_says_so() -> None:
    # Past its corner by 0.4 mm and back, crossing itself: no kernel finds a face in it.
    corners = [(2, 2), (8.4, 2.0), (7.9, 2.05), (8.0, 1.95), (8, 8), (2, 8)]
    edges = zip(corners, corners[1:] + corners[:1], strict=True)
    wall = Terrace(Region(Loop(tuple(Line(a, b) for a, b in edges))), 5.0)
    made = terraced_solid(box(0, 0, 10, 10), 0.0, 2.0, [wall], [], "jig")
    assert is_valid(made.solid)
    assert made.plain == ("(2.0, 2.0) mm",)
    assert made.volume_mm3 == pytest.approx(200 + 3 * 36, abs=0.5)
