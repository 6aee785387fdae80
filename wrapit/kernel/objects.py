"""Named, coloured solids as the objects of build123d and cadquery, for files and for scripts.

Both libraries wrap the same kernel shapes, so nothing is converted: a solid is handed over exactly as it is.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from wrapit.kernel.guard import guarded
from wrapit.kernel.measures import solids_of

if TYPE_CHECKING:
    import build123d
    import cadquery


@dataclass(frozen=True, eq=False)
class FilePart:
    """A named solid (STEP: or none) with its sRGB colour `#rrggbb`, and edges that go with it."""

    name: str
    solid: Any
    colour: str
    edges: tuple[Any, ...] = ()


def moved(part: FilePart, by_mm: tuple[float, float, float]) -> FilePart:
    """The same part in another place; its geometry is shared."""
    from OCP.gp import gp_Trsf, gp_Vec
    from OCP.TopLoc import TopLoc_Location

    move = gp_Trsf()
    move.SetTranslation(gp_Vec(*by_mm))
    there = TopLoc_Location(move)
    solid = None if part.solid is None else part.solid.Moved(there)
    return replace(part, solid=solid, edges=tuple(edge.Moved(there) for edge in part.edges))


def build123d_part(part: FilePart) -> build123d.Part:
    """The part's solid with its name as `label` and its `color`. Raises KernelError."""
    import build123d

    with guarded("handing over to build123d", part.name):
        # A Part around the bare solid would have no volume: it adds up those of its members.
        members = [build123d.Solid(solid) for solid in solids_of(part.solid)]
        return build123d.Part(members, label=part.name, color=_linear(part.colour))


def build123d_edge(part: FilePart) -> build123d.Edge:
    """The part's first edge, with name and colour likewise. Raises KernelError."""
    import build123d

    with guarded("handing over to build123d", part.name):
        return build123d.Edge(part.edges[0], label=part.name, color=_linear(part.colour))


def cadquery_workplane(part: FilePart) -> cadquery.Workplane:
    """A workplane with the part's solid on its stack, tagged with its name. Raises KernelError."""
    import cadquery

    with guarded("handing over to cadquery", part.name):
        return cadquery.Workplane(obj=cadquery.Shape.cast(part.solid)).tag(part.name)


def cadquery_assembly(
    name: str, parts: Sequence[FilePart], named: Callable[[str], str] = str
) -> cadquery.Assembly:
    """A tree `name`/{parts}, each with name and colour; edges beside their part.

    `named` spells each name, as a file's format may want it. Names in a tree are unique: where a part is
    called like the whole, the whole is called `name (all)`.
    """
    import cadquery

    taken = {part.name for part in parts}
    tree = cadquery.Assembly(name=named(f"{name} (all)" if name in taken else name))
    for part in parts:
        colour = cadquery.Color(*channels(part.colour))
        if part.solid is not None:
            tree.add(cadquery.Shape.cast(part.solid), name=named(part.name), color=colour)
        for index, edge in enumerate(part.edges, start=1):
            suffix = "centreline" if len(part.edges) == 1 else f"curve-{index}"
            tree.add(cadquery.Shape.cast(edge), name=named(f"{part.name} {suffix}"), color=colour)
    return tree


def _linear(colour: str) -> build123d.Color:
    """The colour for build123d, which takes plain channels for linear light; cadquery knows them for sRGB."""
    import build123d
    from OCP.Quantity import Quantity_Color, Quantity_ColorRGBA, Quantity_TOC_sRGB

    return build123d.Color(Quantity_ColorRGBA(Quantity_Color(*channels(colour), Quantity_TOC_sRGB)))


def channels(colour: str) -> tuple[float, float, float]:
    """Red, green and blue from 0 to 1.

    >>> channels("#ff0033")
    (1.0, 0.0, 0.2)
    """
    red, green, blue = (int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5))
    return red, green, blue
