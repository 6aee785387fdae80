"""Measures and checks of shapes."""

from __future__ import annotations

from typing import Any

import numpy as np

from wrapit.geometry import FloatArray


def is_valid(shape: Any) -> bool:
    """Whether the kernel's own analysis finds nothing wrong."""
    from OCP.BRepCheck import BRepCheck_Analyzer

    return bool(BRepCheck_Analyzer(shape, True, True).IsValid())


def volume_mm3(shape: Any) -> float:
    """Volume by integration over the shape's faces."""
    from OCP.BRepGProp import BRepGProp
    from OCP.GProp import GProp_GProps

    properties = GProp_GProps()
    BRepGProp.VolumeProperties_s(shape, properties)
    return float(properties.Mass())


def count_solids(shape: Any) -> int:
    """Number of solids in the shape."""
    return len(solids_of(shape))


def solids_of(shape: Any) -> list[Any]:
    """The solids in the shape, or the solid that it is."""
    from OCP.TopAbs import TopAbs_SOLID
    from OCP.TopExp import TopExp_Explorer
    from OCP.TopoDS import TopoDS

    explorer, solids = TopExp_Explorer(shape, TopAbs_SOLID), []
    while explorer.More():
        solids.append(TopoDS.Solid_s(explorer.Current()))
        explorer.Next()
    return solids


def box_mm(shape: Any) -> tuple[FloatArray, FloatArray]:
    """The least and the greatest x, y and z of the shape, (3,) each, right to 1e-6."""
    from OCP.Bnd import Bnd_Box
    from OCP.BRepBndLib import BRepBndLib

    box = Bnd_Box()
    BRepBndLib.AddOptimal_s(shape, box, False, False)
    corners = np.array(box.Get())
    return corners[:3], corners[3:]


def size_mm(shape: Any) -> tuple[float, float, float]:
    """Width, depth and height of the shape's box."""
    low, high = box_mm(shape)
    width, depth, height = (high - low).tolist()
    return (width, depth, height)
