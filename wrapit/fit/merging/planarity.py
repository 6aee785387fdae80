"""Whether lines cross where they have no node."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Final, Protocol

import numpy as np

from wrapit.fit.sketch import Line, Sketch
from wrapit.geometry import FloatArray

if TYPE_CHECKING:
    import shapely

# Lines that meet at a node may touch this near to it (mm).
_NODE_MM: Final = 0.05


class Shaped(Protocol):
    """What runs between two nodes, as a chain of points."""

    @property
    def start(self) -> int:
        """The number of a node."""

    @property
    def end(self) -> int:
        """The number of a node."""

    @property
    def shape(self) -> shapely.LineString:
        """The points."""


def is_planar(sketch: Sketch, lines: Mapping[int, Line], before: Sketch) -> bool:
    """Whether lines that are new since `before` cross neither themselves nor any line but at their nodes.

    What crossed before may cross still: not every drawing that is read is planar to the last micron.
    """
    return not crossed(sketch.lines, sketch.nodes, lines, before, _NODE_MM)


def crossed(
    lines: Mapping[int, Shaped],
    nodes: Mapping[int, FloatArray],
    new: Mapping[int, Shaped],
    before: Sketch,
    near_mm: float,
) -> bool:
    """Whether one of the `new` lines crosses itself, or another farther than that from their nodes.

    But for those that did before.
    """
    import shapely

    numbers, tree = before.places
    judged: set[int] = set()
    for number, line in new.items():
        if not line.shape.is_simple and (number not in before.lines or before.lines[number].shape.is_simple):
            return True
        near = {numbers[index] for index in tree.query(line.shape).tolist()} | set(new)
        judged.add(number)
        others = sorted((near - judged) & lines.keys())
        shapely.prepare(line.shape)
        meet = shapely.intersects(line.shape, [lines[other].shape for other in others])
        for other in np.array(others)[meet].tolist():
            if _meet_elsewhere(line, lines[other], nodes, near_mm) and not _met_before(before, number, other):
                return True
    return False


def _met_before(before: Sketch, one: int, other: int) -> bool:
    lines = before.lines
    return (
        one in lines and other in lines and _meet_elsewhere(lines[one], lines[other], before.nodes, _NODE_MM)
    )


def _meet_elsewhere(first: Shaped, second: Shaped, nodes: Mapping[int, FloatArray], near_mm: float) -> bool:
    """Whether two lines have a place in common that isn't near to a node of both."""
    import shapely

    both = shapely.intersection(first.shape, second.shape)
    if both.is_empty:  # a touch that is lost in rounding
        return False
    places = [nodes[node].tolist() for node in {first.start, first.end} & {second.start, second.end}]
    # A part with all its corners near to a node is near to it.
    parts = (shapely.get_coordinates(part).tolist() for part in shapely.get_parts(both))
    return not all(
        any(all(math.dist(corner, place) <= near_mm for corner in part) for place in places) for part in parts
    )
