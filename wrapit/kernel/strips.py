"""Triangles of upright faces: from the points of their foot straight up to those of their head."""

from __future__ import annotations

from typing import Any

import numpy as np

from wrapit.geometry import FloatArray, IntArray

# How straight are the two sides of an upright face (cosine)? A prism's are by construction.
_STRAIGHT = 1 - 1e-9


def is_straight_across(face: Any) -> bool:
    """Whether the face is flat, or swept along a straight line."""
    from OCP.BRepAdaptor import BRepAdaptor_Surface
    from OCP.GeomAbs import GeomAbs_Cylinder, GeomAbs_Plane, GeomAbs_SurfaceOfExtrusion

    kind = BRepAdaptor_Surface(face, False).GetType()
    return kind in (GeomAbs_Plane, GeomAbs_Cylinder, GeomAbs_SurfaceOfExtrusion)


def strip_of(face: Any, mesh: Any, location: Any) -> IntArray | None:
    """Triangles (m, 3) of nodes of the kernel's mesh, as it turns them; None for any other face.

    Straight across there is nothing to follow, but the kernel puts points inside these faces, ten times as
    many as on the edges.
    """
    chains = _chains(face, mesh, location)
    if chains is None:
        return None
    foot, head = chains
    triangles = _between(_shares(mesh, foot), _shares(mesh, head))
    numbered = np.concatenate([foot, head])[triangles]
    return numbered if _turns_like(mesh, foot) else numbered[:, ::-1]


def _chains(face: Any, mesh: Any, location: Any) -> tuple[IntArray, IntArray] | None:
    """Nodes of foot and head, both the same way; None if the face isn't a foot, a head and two sides."""
    from OCP.BRepAdaptor import BRepAdaptor_Surface
    from OCP.GeomAbs import GeomAbs_SurfaceOfExtrusion

    surface = BRepAdaptor_Surface(face)
    if surface.GetType() != GeomAbs_SurfaceOfExtrusion:
        return None
    edges = _edge_nodes(face, mesh, location)
    if len(edges) != 4:
        return None
    up = surface.Direction()
    axis = np.array([up.X(), up.Y(), up.Z()])
    sides = [nodes for nodes in edges if len(nodes) == 2 and _runs_along(mesh, nodes, axis)]
    long = [nodes for nodes in edges if not any(nodes is side for side in sides)]
    if len(sides) != 2:
        return None
    foot, head = long
    mates = {int(a): int(b) for side in sides for a, b in (side, side[::-1])}
    if mates.get(int(foot[0])) != int(head[0]):
        head = head[::-1]
    meets = (mates.get(int(foot[0])), mates.get(int(foot[-1]))) == (int(head[0]), int(head[-1]))
    return (foot, head) if meets else None


def _edge_nodes(face: Any, mesh: Any, location: Any) -> list[IntArray]:
    """The mesh's nodes on each edge of the face, from its first to its last."""
    from OCP.BRep import BRep_Tool
    from OCP.TopAbs import TopAbs_EDGE
    from OCP.TopExp import TopExp_Explorer
    from OCP.TopoDS import TopoDS

    found = []
    explorer = TopExp_Explorer(face, TopAbs_EDGE)
    while explorer.More():
        polygon = BRep_Tool.PolygonOnTriangulation_s(TopoDS.Edge_s(explorer.Current()), mesh, location)
        if polygon is not None:
            found.append(np.array([polygon.Node(k) for k in range(1, polygon.NbNodes() + 1)], dtype=np.int64))
        explorer.Next()
    return found


def _places(mesh: Any, nodes: IntArray) -> FloatArray:
    """Where nodes (n,) of the mesh are, (n, 3)."""
    points = [mesh.Node(int(node)) for node in nodes]
    return np.array([(point.X(), point.Y(), point.Z()) for point in points])


def _runs_along(mesh: Any, nodes: IntArray, axis: FloatArray) -> bool:
    a, b = _places(mesh, nodes)
    return bool(abs((b - a) @ axis) > _STRAIGHT * np.linalg.norm(b - a))


def _shares(mesh: Any, nodes: IntArray) -> FloatArray:
    """How far along the chain each node is, from 0 to 1."""
    along = np.concatenate([[0.0], np.linalg.norm(np.diff(_places(mesh, nodes), axis=0), axis=1).cumsum()])
    return along / along[-1]


def _between(foot: FloatArray, head: FloatArray) -> IntArray:
    """Triangles (m, 3) between two chains of shares (n,) and (k,), whose numbers go on from n."""
    triangles, i, j = [], 0, 0
    while i < len(foot) - 1 or j < len(head) - 1:
        on_foot = j == len(head) - 1 or (i < len(foot) - 1 and foot[i + 1] <= head[j + 1])
        if on_foot:
            triangles.append((i, i + 1, len(foot) + j))
            i += 1
        else:
            triangles.append((i, len(foot) + j + 1, len(foot) + j))
            j += 1
    return np.array(triangles, dtype=np.int64)


def _turns_like(mesh: Any, foot: IntArray) -> bool:
    """Whether the kernel's triangle on the first step of the foot runs along it, not against it."""
    first, second = int(foot[0]), int(foot[1])
    for index in range(1, mesh.NbTriangles() + 1):
        facet = mesh.Triangle(index)
        a, b, c = (facet.Value(k) for k in (1, 2, 3))
        if (first, second) in ((a, b), (b, c), (c, a)):
            return True
    return False
