"""Random fields: what must hold of every taut wire, whatever it goes round."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tests.jig.taut.ground import elastic, field_beside, length, pulled, wandering
from wrapit.geometry import FloatArray
from wrapit.jig.taut.shortest import HAIR_MM

seeds = st.integers(0, 2**32 - 1)
few = settings(max_examples=25, deadline=None, suppress_health_check=[HealthCheck.too_slow])
# Hairs are as round as octagons and turn with the axes: a way that bends at n of them is that much off.
TURNED = 2 * HAIR_MM


def drawn_among_walls(seed: int, closed: bool = False) -> tuple[shapely.MultiPolygon, FloatArray]:
    rng = np.random.default_rng(seed)
    path = wandering(rng, int(rng.integers(2, 12)))
    if closed:
        path = np.concatenate([path, path[:1]])
    return field_beside(rng, path, int(rng.integers(1, 40))), path


@few
@given(seeds, st.booleans())
def test_it_stays_out_of_walls_and_is_no_longer_than_drawn(seed: int, closed: bool) -> None:
    walls, path = drawn_among_walls(seed, closed)
    found = pulled(walls, path, closed)
    assert length(found) <= length(path) + 1e-9
    if len(found) > 1:
        solid = shapely.union_all(shapely.get_parts(walls)).buffer(-1e-6)
        way = shapely.LineString(path).buffer(1.1 * HAIR_MM)
        assert shapely.LineString(found).intersection(solid.difference(way)).length < 1e-9
    if not closed:
        assert np.array_equal(found[[0, -1]], path[[0, -1]])


@few
@given(seeds, st.booleans())
def test_pulled_again_it_stays(seed: int, closed: bool) -> None:
    walls, path = drawn_among_walls(seed, closed)
    found = pulled(walls, path, closed)
    # Along a wall's side the wall gives way by a hair again: at each bend by twice its tangent at most.
    turns = len(found)
    assert length(found) - TURNED * turns <= length(pulled(walls, found, closed)) <= length(found) + 1e-9


@few
@given(seeds, st.booleans())
def test_backwards_it_is_the_same(seed: int, closed: bool) -> None:
    walls, path = drawn_among_walls(seed, closed)
    assert length(pulled(walls, path[::-1], closed)) == pytest.approx(
        length(pulled(walls, path, closed)), abs=1e-9
    )


@few
@given(seeds)
def test_more_points_on_the_same_way_change_nothing(seed: int) -> None:
    walls, path = drawn_among_walls(seed)
    finer = shapely.get_coordinates(shapely.segmentize(shapely.LineString(path), 0.07))
    assert length(pulled(walls, finer)) == pytest.approx(length(pulled(walls, path)), abs=1e-6)


@few
@given(seeds, st.floats(0, 2 * math.pi), st.booleans(), st.floats(-300, 300), st.floats(-300, 300))
def test_moved_turned_or_mirrored_it_is_as_long(
    seed: int, angle: float, mirror: bool, x: float, y: float
) -> None:
    walls, path = drawn_among_walls(seed)
    turn = np.array([(math.cos(angle), -math.sin(angle)), (math.sin(angle), math.cos(angle))])
    turn = turn @ np.diag([-1.0 if mirror else 1.0, 1.0])

    def moved(points: FloatArray) -> FloatArray:
        return np.asarray(points @ turn.T + (x, y))

    before = pulled(walls, path)
    after = pulled(shapely.transform(walls, moved), moved(path))
    assert length(after) == pytest.approx(length(before), abs=TURNED * len(before))


@few
@given(seeds, st.floats(0.05, 0.95), st.floats(0.05, 0.95))
def test_a_way_there_and_back_changes_nothing(seed: int, where: float, along: float) -> None:
    """A detour that is taken back at once: along a piece of the path itself."""
    walls, path = drawn_among_walls(seed)
    at, back = int(where * len(path)), int(along * len(path))
    step = 1 if back >= at else -1
    detour = np.arange(at, back, step)
    there = np.concatenate([path[: at + 1], path[detour], path[detour[::-1]], path[at:]])
    assert length(pulled(walls, there)) == pytest.approx(length(pulled(walls, path)), abs=1e-9)


@few
@given(seeds, st.floats(0, 0.99))
def test_a_closed_wire_has_no_start(seed: int, share: float) -> None:
    walls, path = drawn_among_walls(seed, closed=True)
    turned = np.roll(path[:-1], int(share * (len(path) - 1)), axis=0)
    assert length(pulled(walls, turned, True)) == pytest.approx(length(pulled(walls, path, True)), abs=1e-6)


@pytest.mark.parametrize("seed", [0, 3, 5, 7])
def test_an_elastic_band_comes_to_the_same(seed: int) -> None:
    rng = np.random.default_rng(seed)
    path = wandering(rng, 4)
    walls = field_beside(rng, path, 12)
    found = pulled(walls, path)
    # Half a millimetre from point to point: grown walls are twice as thick, no point jumps over one.
    band = elastic(walls, path, 81, 4000)
    # It cuts corners by its step: up to 1.7e-3 shorter was measured, and 0.08 mm beside the taut wire.
    assert length(band) == pytest.approx(length(found), rel=2.5e-3)
    assert shapely.LineString(band).hausdorff_distance(shapely.LineString(found)) < 0.12


@few
@given(seeds)
def test_through_walls_it_is_no_longer_than_drawn_and_the_same_backwards(seed: int) -> None:
    """Ends inside of walls that give way by a hair lie on sides of triangles."""
    rng = np.random.default_rng(seed)
    walls = shapely.union_all(shapely.points(rng.uniform(0, 40, (40, 2))).tolist()).buffer(3, quad_segs=6)
    path = rng.uniform(0, 40, (int(rng.integers(2, 9)), 2))
    found = pulled(walls, path)
    assert length(found) <= length(path) + 1e-9
    assert length(pulled(walls, path[::-1])) == pytest.approx(length(found), abs=1e-9)
