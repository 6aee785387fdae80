"""The part that two solids share, cut out by the kernel's own boolean operation."""

from __future__ import annotations

from typing import Any

from wrapit.errors import KernelError
from wrapit.kernel.guard import guarded
from wrapit.kernel.measures import solids_of, volume_mm3


def common_mm3(first: Any, second: Any, where: str) -> float:
    """Volume of what a solid has in common with each solid of another shape.

    Raises KernelError where the kernel can't tell.
    """
    with guarded("cutting one solid with another", where):
        # One by one: the arms of a folded wire lie in each other, which no boolean operation takes.
        return sum(_common_mm3(first, solid, where) for solid in solids_of(second))


def _common_mm3(first: Any, second: Any, where: str) -> float:
    from OCP.BRepAlgoAPI import BRepAlgoAPI_Common
    from OCP.TopTools import TopTools_ListOfShape

    arguments, tools = TopTools_ListOfShape(), TopTools_ListOfShape()
    arguments.Append(first)
    tools.Append(second)
    operation = BRepAlgoAPI_Common()
    operation.SetArguments(arguments)
    operation.SetTools(tools)
    operation.SetRunParallel(True)
    operation.Build()
    if not operation.IsDone():
        raise KernelError("cutting one solid with another didn't finish", where)
    return abs(volume_mm3(operation.Shape()))
