"""Triangles of solids, closed: neighbouring faces share their corners exactly."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from wrapit.errors import KernelError
from wrapit.geometry import FloatArray, IntArray
from wrapit.kernel.strips import is_straight_across, strip_of

# How far may triangles inside a face lie from it, in mm and in rad, where all are straight across? As far as
# they like: points on the edges say it all. The kernel then takes a quarter less time for the same triangles.
_ANY_MM, _ANY_RAD = 1e3, 3.0


@dataclass(frozen=True, eq=False)
class Mesh:
    """`corners` (n, 3) in mm, `triangles` (m, 3) counter-clockwise seen from outside."""

    corners: FloatArray
    triangles: IntArray

    @property
    def volume_mm3(self) -> float:
        """Volume inside (divergence theorem); right for a closed mesh."""
        a, b, c = (self.corners[self.triangles[:, k]] for k in range(3))
        return float((a * np.cross(b, c)).sum() / 6)

    @property
    def open_edges(self) -> int:
        """Edges that don't have exactly one triangle on each side; 0 for a watertight mesh."""
        return len(self._gaps)

    def place_of_gap(self) -> str:
        """Where the first open edge is, for a person."""
        x, y, z = self.corners[self._gaps[0] // len(self.corners)]
        return f"at ({x:.2f}, {y:.2f}, {z:.2f}) mm"

    @cached_property
    def _gaps(self) -> IntArray:
        """The open edges, each as first corner times number of corners plus second corner."""
        ends = np.concatenate(
            [self.triangles[:, [0, 1]], self.triangles[:, [1, 2]], self.triangles[:, [2, 0]]]
        )
        forward, times = np.unique(ends[:, 0] * len(self.corners) + ends[:, 1], return_counts=True)
        first, second = np.divmod(forward, len(self.corners))
        alone = ~np.isin(forward, second * len(self.corners) + first)
        return np.concatenate([forward[alone], np.repeat(forward, times - 1)])


def mesh_of(solids: Iterable[Any], tolerance_mm: float, angle_rad: float) -> Mesh:
    """The solids' surface within the tolerance; KernelError if a face has no triangles or a gap remains."""

    meshes = [_solid_mesh(solid, tolerance_mm, angle_rad) for solid in solids]
    counts = np.cumsum([0] + [len(mesh.corners) for mesh in meshes])
    mesh = Mesh(
        np.concatenate([mesh.corners for mesh in meshes]),
        np.concatenate([mesh.triangles + count for mesh, count in zip(meshes, counts, strict=False)]),
    )
    if mesh.open_edges:
        raise KernelError(
            f"the solid's triangles leave {mesh.open_edges} open edges",
            mesh.place_of_gap(),
            "take stl and 3mf out of `outputs` and print from the STEP file, or make the piece 1 mm larger",
        )
    return mesh


def _solid_mesh(solid: Any, tolerance_mm: float, angle_rad: float) -> Mesh:
    from OCP.BRepMesh import BRepMesh_IncrementalMesh
    from OCP.BRepTools import BRepTools
    from OCP.IMeshTools import IMeshTools_Parameters

    wishes = IMeshTools_Parameters()
    wishes.Deflection, wishes.Angle = tolerance_mm, angle_rad
    wishes.Relative, wishes.InParallel = False, True
    if all(map(is_straight_across, _faces(solid))):
        wishes.DeflectionInterior, wishes.AngleInterior = _ANY_MM, _ANY_RAD
        wishes.ControlSurfaceDeflection = False
    BRepTools.Clean_s(solid)
    BRepMesh_IncrementalMesh(solid, wishes)
    corners = _Corners(solid)
    triangles = [_face_triangles(face, corners) for face in _faces(solid)]
    BRepTools.Clean_s(solid)
    found = np.concatenate(triangles)
    a, b, c = found.T
    return Mesh(np.array(corners.points), found[(a != b) & (b != c) & (c != a)])


class _Corners:
    """Numbers the corners of a solid's faces: those on a shared edge or vertex once, whatever their place."""

    def __init__(self, solid: Any) -> None:
        from OCP.TopAbs import TopAbs_EDGE, TopAbs_VERTEX
        from OCP.TopExp import TopExp
        from OCP.TopTools import TopTools_IndexedMapOfShape

        self.points: list[tuple[float, float, float]] = []
        self._known: dict[tuple[str, int, int], int] = {}
        self._edges, self._vertices = TopTools_IndexedMapOfShape(), TopTools_IndexedMapOfShape()
        TopExp.MapShapes_s(solid, TopAbs_EDGE, self._edges)
        TopExp.MapShapes_s(solid, TopAbs_VERTEX, self._vertices)

    def of_face(self, face: Any, mesh: Any, location: Any, used: IntArray) -> IntArray:
        """The numbers of those of the face's nodes that are used, in their order."""
        from OCP.BRep import BRep_Tool
        from OCP.TopAbs import TopAbs_EDGE
        from OCP.TopExp import TopExp_Explorer
        from OCP.TopoDS import TopoDS

        names: dict[int, tuple[str, int, int]] = {}
        explorer = TopExp_Explorer(face, TopAbs_EDGE)
        while explorer.More():
            edge = TopoDS.Edge_s(explorer.Current())
            polygon = BRep_Tool.PolygonOnTriangulation_s(edge, mesh, location)
            if polygon is not None:
                names.update(self._names(edge, polygon))
            explorer.Next()
        move = location.Transformation()
        return np.array(
            [self._number(names.get(node), mesh.Node(node).Transformed(move)) for node in used.tolist()],
            dtype=np.int64,
        )

    def _names(self, edge: Any, polygon: Any) -> dict[int, tuple[str, int, int]]:
        """For the face's nodes on an edge: their vertex, or the edge and their place along it."""
        from OCP.TopAbs import TopAbs_FORWARD
        from OCP.TopExp import TopExp
        from OCP.TopoDS import TopoDS

        forward = TopoDS.Edge_s(edge.Oriented(TopAbs_FORWARD))
        index, count = self._edges.FindIndex(edge), polygon.NbNodes()
        names = {polygon.Node(k): ("edge", index, k) for k in range(2, count)}
        names[polygon.Node(1)] = ("vertex", self._vertices.FindIndex(TopExp.FirstVertex_s(forward)), 0)
        names[polygon.Node(count)] = ("vertex", self._vertices.FindIndex(TopExp.LastVertex_s(forward)), 0)
        return names

    def _number(self, name: tuple[str, int, int] | None, point: Any) -> int:
        if name is not None and name in self._known:
            return self._known[name]
        number = len(self.points)
        self.points.append((point.X(), point.Y(), point.Z()))
        if name is not None:
            self._known[name] = number
        return number


def _faces(solid: Any) -> Iterable[Any]:
    from OCP.TopAbs import TopAbs_FACE
    from OCP.TopExp import TopExp_Explorer
    from OCP.TopoDS import TopoDS

    explorer = TopExp_Explorer(solid, TopAbs_FACE)
    while explorer.More():
        yield TopoDS.Face_s(explorer.Current())
        explorer.Next()


def _face_triangles(face: Any, corners: _Corners) -> IntArray:
    from OCP.BRep import BRep_Tool
    from OCP.TopAbs import TopAbs_REVERSED
    from OCP.TopLoc import TopLoc_Location

    location = TopLoc_Location()
    mesh = BRep_Tool.Triangulation_s(face, location)
    if mesh is None:
        raise KernelError("a face can't be divided into triangles")
    facets = strip_of(face, mesh, location)
    if facets is None:
        triangles = (mesh.Triangle(i) for i in range(1, mesh.NbTriangles() + 1))
        facets = np.array([[facet.Value(k) for k in (1, 2, 3)] for facet in triangles], dtype=np.int64)
    used, facets = np.unique(facets, return_inverse=True)
    found = corners.of_face(face, mesh, location, used)[facets.reshape(-1, 3)]
    return found[:, ::-1] if face.Orientation() == TopAbs_REVERSED else found
