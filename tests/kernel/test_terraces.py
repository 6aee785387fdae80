"""Solids built face by face, against volumes worked out on paper."""

from __future__ import annotations

import math

import numpy as np
import pytest

from wrapit.errors import KernelError
from wrapit.geometry import Arc, BezierChain, Line, Loop, Region
from wrapit.geometry.outlines.loops import as_chain
from wrapit.kernel.edges import region_face
from wrapit.kernel.guard import guarded
from wrapit.kernel.measures import count_solids, is_valid, size_mm, volume_mm3
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


def test_faces_of_splines_have_the_right_area() -> None:
    chain = as_chain(Arc((3.0, 1.0), 7.0, 0.2, 2 * math.pi))
    assert isinstance(chain, BezierChain)
    assert abs(_area(region_face(Region(Loop((chain,)))))) == pytest.approx(49 * math.pi, rel=1e-9)


@pytest.mark.parametrize("at_start", [True, False])
def test_slivers_in_an_outline_are_passed_over(at_start: bool) -> None:
    points = as_chain(Arc((0.0, 0.0), 7.0, 0.0, math.pi)).points
    sliver = np.arange(4)[:, None] * np.array([0.0, 2e-8])
    if at_start:
        points = np.concatenate([[points[0, 0] - sliver[::-1]], points])
    else:
        points = np.concatenate([points, [points[-1, 3] - sliver]])
    ends = [(float(x), float(y)) for x, y in (points[-1, 3], points[0, 0])]
    face = region_face(Region(Loop((BezierChain(points), Line(*ends)))))
    assert is_valid(face)
    assert abs(_area(face)) == pytest.approx(49 * math.pi / 2, rel=1e-6)


def test_what_lies_outside_is_an_error_with_the_place() -> None:
    with pytest.raises(KernelError, match="jig seven"):
        terraced_solid(box(0, 0, 10, 10), 0.0, 2.0, [], [disc(30, 5, 1)], "jig seven")


def test_overlapping_terraces_are_refused() -> None:
    overlapping = [Terrace(Region(box(2, 2, 6, 6)), 5.0), Terrace(Region(box(4, 4, 8, 8)), 5.0)]
    with pytest.raises(KernelError):
        terraced_solid(box(0, 0, 10, 10), 0.0, 2.0, overlapping, [], "jig")


def test_exceptions_of_the_kernel_become_errors() -> None:
    from OCP.gp import gp_Dir

    with (
        pytest.raises(KernelError, match=r"wire-03: making a direction failed"),
        guarded("making a direction", "wire-03"),
    ):
        gp_Dir(0, 0, 0)


def test_mesh_notices_a_missing_face() -> None:
    from OCP.BRep import BRep_Builder
    from OCP.TopAbs import TopAbs_FACE
    from OCP.TopExp import TopExp_Explorer
    from OCP.TopoDS import TopoDS_Compound

    made = terraced_solid(box(0, 0, 10, 10), 0.0, 2.0, [], [], "plate")
    open_box, builder = TopoDS_Compound(), BRep_Builder()
    builder.MakeCompound(open_box)
    explorer = TopExp_Explorer(made.solid, TopAbs_FACE)
    explorer.Next()
    while explorer.More():
        builder.Add(open_box, explorer.Current())
        explorer.Next()
    with pytest.raises(KernelError, match="open edges"):
        mesh_of([open_box], 0.01, 0.2)


def _area(face: object) -> float:
    from OCP.BRepGProp import BRepGProp
    from OCP.GProp import GProp_GProps

    properties = GProp_GProps()
    BRepGProp.SurfaceProperties_s(face, properties)
    return float(properties.Mass())


def test_volume_of_a_prism() -> None:
    made = terraced_solid(disc(0, 0, 5), 0.0, 4.0, [], [], "coin")
    assert volume_mm3(made.solid) == pytest.approx(100 * math.pi, rel=1e-9)
