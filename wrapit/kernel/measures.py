"""Measures and checks of shapes."""

from __future__ import annotations

from typing import Any


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
    from OCP.TopAbs import TopAbs_SOLID
    from OCP.TopExp import TopExp_Explorer

    explorer, count = TopExp_Explorer(shape, TopAbs_SOLID), 0
    while explorer.More():
        count += 1
        explorer.Next()
    return count


def size_mm(shape: Any) -> tuple[float, float, float]:
    """Width, depth and height of the shape's box."""
    from OCP.Bnd import Bnd_Box
    from OCP.BRepBndLib import BRepBndLib

    box = Bnd_Box()
    BRepBndLib.AddOptimal_s(shape, box, False, False)
    low_x, low_y, low_z, high_x, high_y, high_z = box.Get()
    return (high_x - low_x, high_y - low_y, high_z - low_z)
