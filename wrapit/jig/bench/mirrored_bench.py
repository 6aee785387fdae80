"""The mirror image of jigs on the bench, for the other one of a pair where no jig of its own is made."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from wrapit.geometry import Arc, Edge, Line, Loop, Region
from wrapit.jig.bench.model import Bench, Handling
from wrapit.wires.mirror import OTHER_SIDE, flipped, mirrored


def mirrored_handling(handling: Handling) -> Handling:
    """All jigs with left and right exchanged (x → −x), and the wires in them."""
    return replace(handling, benches=tuple(map(_bench, handling.benches)))


def _bench(bench: Bench) -> Bench:
    return replace(
        bench,
        wires=mirrored(bench.wires),
        walls=tuple(map(mirrored_region, bench.walls)),
        plate=mirrored_region(bench.plate),
        contacts={
            wire: tuple(replace(contact, side=OTHER_SIDE[contact.side]) for contact in along)
            for wire, along in bench.contacts.items()
        },
    )


def mirrored_region(region: Region) -> Region:
    """A flat piece with x → −x; its loops run the other way round."""
    return Region(_loop(region.outer), tuple(map(_loop, region.holes)))


def _loop(loop: Loop) -> Loop:
    return Loop(tuple(map(_edge, loop.edges)))


def _edge(edge: Edge) -> Edge:
    if isinstance(edge, Line):
        return Line(flipped(edge.start), flipped(edge.end))
    if isinstance(edge, Arc):
        return Arc(flipped(edge.centre), edge.radius_mm, np.pi - edge.start_rad, -edge.sweep_rad)
    return edge.mapped(np.diag([-1.0, 1.0]))
