"""Meshes are closed, or it is said that they aren't."""

from __future__ import annotations

import numpy as np
import pytest

from tests.jig.metal import circle
from tests.kernel.test_terraces import box
from wrapit.errors import KernelError
from wrapit.geometry import BezierChain, Loop
from wrapit.kernel.meshes import Mesh, mesh_of
from wrapit.kernel.terraces import terraced_solid

TETRAHEDRON = Mesh(
    np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], dtype=float),
    np.array([(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]),
)


def test_a_tetrahedron_has_a_sixth_of_its_cube() -> None:
    assert TETRAHEDRON.volume_mm3 == pytest.approx(1 / 6)
    assert TETRAHEDRON.open_edges == 0


@pytest.mark.parametrize("missing", range(4))
def test_a_missing_triangle_leaves_three_open_edges(missing: int) -> None:
    rest = np.delete(TETRAHEDRON.triangles, missing, axis=0)
    assert Mesh(TETRAHEDRON.corners, rest).open_edges == 3


def test_a_triangle_too_many_is_noticed() -> None:
    twice = np.concatenate([TETRAHEDRON.triangles, TETRAHEDRON.triangles[:1]])
    assert Mesh(TETRAHEDRON.corners, twice).open_edges == 3


@pytest.mark.parametrize("turned", [False, True])
def test_upright_faces_have_no_corner_between_foot_and_head(turned: bool) -> None:
    from wrapit.kernel.edges import turned as facing

    chain = circle(5, (10.0, 10.0))
    oval = BezierChain(chain.points * np.array([1.0, 0.6]))
    outline = facing(Loop((oval,)), counter_clockwise=turned)
    solid = terraced_solid(outline, 0.0, 8.0, [], [], "plate")
    mesh = mesh_of([solid.solid], 0.002, 0.2)
    assert set(mesh.corners[:, 2].round(9)) == {0.0, 8.0}
    assert len(mesh.triangles) == 2 * (len(mesh.corners) - 2)
    assert mesh.volume_mm3 == pytest.approx(solid.volume_mm3, rel=1e-3)


def test_a_round_surface_is_followed_inside_its_faces_too() -> None:
    from OCP.BRepPrimAPI import BRepPrimAPI_MakeSphere

    mesh = mesh_of([BRepPrimAPI_MakeSphere(5.0).Solid()], 0.002, 0.2)
    a, b, c = (mesh.corners[mesh.triangles[:, k]] for k in range(3))
    assert np.linalg.norm((a + b + c) / 3, axis=1).min() > 5.0 - 0.01
    assert mesh.open_edges == 0


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
