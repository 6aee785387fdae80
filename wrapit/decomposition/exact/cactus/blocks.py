"""Drawings whose closed loops share no segment: rings and lines that hang on one another at junctions."""

from __future__ import annotations

from dataclasses import dataclass, field

from wrapit.decomposition.graph import Graph

Doors = tuple[int, ...]


@dataclass(frozen=True)
class HangingBlock:
    """One ring, or one segment on no ring, as it hangs on a junction.

    `doors` are its half-edges at that junction, two or one; `junctions` are its others, of a ring in
    the order in which it visits them.
    """

    doors: Doors
    junctions: tuple[int, ...]


@dataclass
class Cactus:
    """Junctions and blocks as a tree that grows from one junction.

    `order` has each junction before all that hangs on it; `hanging[j]` are the blocks that hang on
    junction j, `doors[j]` the half-edges at j of the block that j hangs on.
    """

    order: list[int] = field(default_factory=list)
    hanging: dict[int, list[HangingBlock]] = field(default_factory=dict)
    doors: dict[int, Doors] = field(default_factory=dict)


def as_cactus(graph: Graph) -> Cactus | None:
    """The blocks of a connected piece, grown from a junction where most segments meet.

    None where two rings share a segment.
    """
    incident, junction_of = graph.incident, graph.junction_of
    root = max(range(len(incident)), key=lambda junction: len(incident[junction]))
    cactus = Cactus([root], {j: [] for j in range(len(incident))}, {root: ()})
    hanging, doors = cactus.hanging, cactus.doors
    up = {root: -1}  # the half-edge at a junction that leads towards the root
    used = bytearray(graph.segments)
    stack = [iter(incident[root])]
    while stack:
        for h in stack[-1]:
            if used[h >> 1]:
                continue
            used[h >> 1] = True
            top, bottom = junction_of[h ^ 1], junction_of[h]
            if top not in up:
                up[top] = h ^ 1
                cactus.order.append(top)
                stack.append(iter(incident[top]))
                break
            # A segment that leads back closes a ring with the way down to it.
            junctions, end = [], h
            while bottom != top:
                if bottom in doors:
                    return None
                doors[bottom] = (up[bottom], end)
                junctions.append(bottom)
                end = up[bottom] ^ 1
                bottom = junction_of[end]
            hanging[top].append(HangingBlock((h ^ 1, end), tuple(junctions)))
        else:
            stack.pop()
    for junction in cactus.order[1:]:
        if junction not in doors:
            h = up[junction]
            doors[junction] = (h,)
            hanging[junction_of[h ^ 1]].append(HangingBlock((h ^ 1,), (junction,)))
    return cactus
