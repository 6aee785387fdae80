"""Round wires: exact centrelines, true volumes."""

from __future__ import annotations

import math

import numpy as np
import pytest

from tests.jig.metal import arcs, circle, line, scribble, wires_of
from wrapit.geometry import BezierChain, from_chain
from wrapit.geometry.arclength import ArcLength
from wrapit.kernel.interference import common_mm3
from wrapit.kernel.measures import box_mm, count_solids, is_valid, size_mm, volume_mm3
from wrapit.kernel.round_wires.heights import HEIGHT_TOLERANCE_MM, smooth_heights
from wrapit.kernel.round_wires.spines import Spine
from wrapit.kernel.round_wires.sweeps import round_wire, torus

D = 1.0237
AREA = math.pi / 4 * D**2


def sampled(edge: object, count: int) -> np.ndarray:
    from OCP.BRepAdaptor import BRepAdaptor_Curve

    curve = BRepAdaptor_Curve(edge)
    u = np.linspace(curve.FirstParameter(), curve.LastParameter(), count)
    return np.array([(p.X(), p.Y(), p.Z()) for p in (curve.Value(float(t)) for t in u)])


def faces_of(solid: object) -> int:
    from OCP.TopAbs import TopAbs_FACE
    from OCP.TopExp import TopExp
    from OCP.TopTools import TopTools_IndexedMapOfShape

    found = TopTools_IndexedMapOfShape()
    TopExp.MapShapes_s(solid, TopAbs_FACE, found)
    return found.Extent()


@pytest.mark.parametrize(
    "chain",
    [line((0, 0), (40, 0)), arcs((0, 0), 0, (15, 0), (1.5, 180), (15, 0)), circle(5)],
    ids=["line", "hairpin", "circle"],
)
def test_volume_is_section_times_length(chain: BezierChain) -> None:
    solid = round_wire(from_chain(chain), D, (), "wire-01").solid
    assert is_valid(solid)
    assert volume_mm3(solid) == pytest.approx(AREA * chain.length, rel=2e-4)
    assert size_mm(solid)[2] == pytest.approx(D, abs=1e-3)


def test_corner_is_mitred() -> None:
    parts = [line((0, 0), (10, 0)).points, line((10, 0), (12, 8)).points]
    chain = BezierChain(np.concatenate(parts))
    solid = round_wire(from_chain(chain), D, (), "wire-01").solid
    assert is_valid(solid)
    assert volume_mm3(solid) == pytest.approx(AREA * chain.length, rel=1e-6)


def test_flat_centreline_is_the_spline_itself() -> None:
    spline = from_chain(scribble(np.random.default_rng(2), 40, 8))
    edge = round_wire(spline, D, (), "wire-01").centreline
    points = sampled(edge, 300)
    assert np.abs(points[:, :2] - spline.at(np.linspace(*spline.domain, 300))).max() < 1e-12
    assert (points[:, 2] == 0).all()


def test_lifted_centreline_keeps_x_and_y_and_reaches_its_heights() -> None:
    spline = from_chain(arcs((0, 0), 0, (20, 90), (10, -60)))
    lifts = ((0.0, 0.0), (12.0, 0.0), (14.0, 1.0), (16.0, 1.0), (18.0, 0.0), (41.0, 0.0))
    made = round_wire(spline, D, lifts, "wire-01")
    solid, edge = made.solid, made.centreline
    assert is_valid(solid)
    points = sampled(edge, 500)
    u = np.linspace(*spline.domain, 500)
    assert np.abs(points[:, :2] - spline.at(u)).max() < 1e-7
    wanted = np.interp(ArcLength(spline).length(u), *np.array(lifts).T)
    assert (points[:, 2] > wanted - 0.02).all(), "rounding never lowers a wire into the one below"
    assert points[:, 2].max() == pytest.approx(1.0, abs=0.02)
    assert np.abs(np.diff(points[:, 2], 2)).max() < 0.02, "no kinks"


@pytest.mark.parametrize("beside_mm", [0.0, 1e-9, 2e-7, 5e-7, 1e-5, 1e-3])
def test_a_lift_may_begin_next_to_a_joint(beside_mm: float) -> None:
    """A patch narrower than what patches are sewn within closed no skin."""
    lifts = ((0.0, 0.0), (8.0, 0.0), (10.5, D), (14.0, D), (16.5, 0.0), (30.0, 0.0))
    kinks = Spine(from_chain(line((0, 0), (30, 0))), lifts, D).breaks[1:-1]
    for joint_mm in kinks[::3] + beside_mm:
        parts = [line((0, 0), (joint_mm, 0)).points, line((joint_mm, 0), (30, 0)).points]
        made = round_wire(from_chain(BezierChain(np.concatenate(parts))), D, lifts, "wire-01")
        assert made.solid is not None, made.flaw


def test_crossing_wires_dont_touch() -> None:
    from OCP.BRepExtrema import BRepExtrema_DistShapeShape

    wires = wires_of([line((0, 0), (40, 0)), line((20, -15), (21, 15))])
    first, second = (round_wire(w.centreline, D, w.lifts, w.name).centreline for w in wires)
    assert BRepExtrema_DistShapeShape(first, second).Value() > D - 0.02


def test_random_wires_are_valid() -> None:
    rng = np.random.default_rng(7)
    for wire in wires_of([scribble(rng, 60, 7) for _ in range(3)]):
        solid = round_wire(wire.centreline, 0.5, wire.lifts, wire.name).solid
        assert volume_mm3(solid) == pytest.approx(math.pi / 16 * wire.length_mm, rel=0.03)


def test_a_wire_has_few_faces() -> None:
    """A wire with turns and lifts has tens of faces, not hundreds."""
    rng = np.random.default_rng(3)
    for wire in wires_of([scribble(rng, 60, 9) for _ in range(3)]):
        made = round_wire(wire.centreline, 1.0, wire.lifts, wire.name)
        assert made.solid is not None, made.flaw
        assert faces_of(made.solid) < 0.5 * wire.length_mm


def test_heights_run_above_the_ramps_and_are_level_where_these_are() -> None:
    rng = np.random.default_rng(11)
    for _ in range(50):
        at = np.cumsum(rng.uniform(0.3, 6.0, rng.integers(2, 30)))
        at -= at[0]
        z = np.where(rng.random(len(at)) < 0.5, 0.0, rng.uniform(0, 3, len(at)))
        height = smooth_heights(tuple(zip(at.tolist(), z.tolist(), strict=True)), float(at[-1]), 1.0)
        s = np.linspace(0, at[-1], 2000)
        wanted = np.interp(s, at, z)
        assert (height(s) > wanted - 2 * HEIGHT_TOLERANCE_MM).all()
        assert height(s).max() < z.max() + 2 * HEIGHT_TOLERANCE_MM
        assert np.abs(np.diff(height(s, 1))).max() < 40 * at[-1] / 2000, "no kinks"


def test_a_ring_is_whole() -> None:
    ring = torus((1, 2, 0), (0, 1, 0), 3.0, 0.5, "ring")
    assert is_valid(ring)
    assert volume_mm3(ring) == pytest.approx(2 * math.pi**2 * 3.0 * 0.5**2, rel=1e-6)
    assert size_mm(ring) == pytest.approx((7, 1, 7), abs=1e-6)


@pytest.mark.parametrize("lifts", [(), ((0, 0), (23, 0), (26, D), (32, D))])
@pytest.mark.parametrize("degrees", [150, 160, 175, 180])
def test_a_folded_wire_has_a_solid_for_each_arm(degrees: int, lifts: tuple[tuple[float, float], ...]) -> None:
    """From 157 degrees on no mitre is made; both arms end square."""
    turn = math.radians(degrees)
    spline = from_chain(
        BezierChain(
            np.concatenate(
                [
                    line((0, 0), (20, 0)).points,
                    line((20, 0), (20 + 12 * math.cos(turn), 12 * math.sin(turn))).points,
                ]
            )
        )
    )
    wire = round_wire(spline, D, lifts, "wire-01")
    assert wire.solid is not None, wire.flaw
    assert count_solids(wire.solid) == (2 if degrees > 157 else 1)
    assert is_valid(wire.solid)
    assert volume_mm3(wire.solid) == pytest.approx(AREA * 32, rel=2e-2)
    # Nothing of it sticks out beyond the fold.
    if degrees > 157:
        assert box_mm(wire.solid)[1][0] < 20 + D / 2


def test_what_a_folded_wire_shares_with_a_block_is_that_of_its_arms() -> None:
    from OCP.BRepPrimAPI import BRepPrimAPI_MakeBox
    from OCP.gp import gp_Pnt

    spline = from_chain(
        BezierChain(np.concatenate([line((0, 0), (20, 0)).points, line((20, 0), (0, 0)).points]))
    )
    wire = round_wire(spline, D, ((0, 0), (23, 0), (26, D), (40, D)), "wire-01")
    block = BRepPrimAPI_MakeBox(gp_Pnt(5, -9, -9), gp_Pnt(10, 9, 9)).Solid()
    assert common_mm3(block, wire.solid, "wire-01") == pytest.approx(2 * 5 * AREA, rel=1e-3)
