"""Frames: a plain rectangle around everything else is the picture's border, not part of the drawing."""

from __future__ import annotations

import numpy as np

from wrapit.drawing.bitmap.cleanup import components
from wrapit.drawing.bitmap.strand_graph import Network
from wrapit.geometry import FloatArray

# A photographed frame is a little askew.
_ASKEW = 0.02
_ON_SIDES = 0.98
_LEAST_INSIDE = 0.05


def drop_frames(net: Network, width_px: float) -> None:
    """Drops rectangles that surround all other pieces without touching them, and says so."""
    while _drop_frame(net, width_px):
        pass


def _drop_frame(net: Network, width_px: float) -> bool:
    pieces = components(net)
    if len(pieces) < 2:
        return False
    chains = [np.concatenate([net.path(strand) for strand in strands]) for strands in pieces]
    boxes = [(chain.min(axis=0), chain.max(axis=0)) for chain in chains]
    lengths = [sum(net.length(strand) for strand in strands) for strands in pieces]
    for k, (low, high) in enumerate(boxes):
        others = [box for index, box in enumerate(boxes) if index != k]
        around = all((inner > low).all() and (outer < high).all() for inner, outer in others)
        enough = sum(lengths) - lengths[k] > _LEAST_INSIDE * lengths[k]
        if around and enough and _is_rectangle(chains[k], low, high, width_px):
            net.note("frame", (low + high) / 2, lengths[k], "a rectangle around the drawing")
            net.tell(
                "warning",
                "frame",
                low,
                "the rectangle around the drawing is taken for its frame and left out",
                "connect the drawing to it if it belongs to the piece",
            )
            for strand in pieces[k]:
                net.drop_strand(strand)
            net.drop_lonely()
            return True
    return False


def _is_rectangle(points: FloatArray, low: FloatArray, high: FloatArray, width_px: float) -> bool:
    """Whether nearly all points lie on the sides of their box, and all four sides are there."""
    slack = np.maximum(_ASKEW * (high - low)[::-1], width_px)
    near = np.column_stack([points - low < slack, high - points < slack])
    covered = [np.ptp(points[near[:, side], 1 - side % 2]) for side in range(4) if near[:, side].any()]
    whole = (high - low)[[1, 0, 1, 0]]
    return bool(
        near.any(axis=1).mean() > _ON_SIDES
        and len(covered) == 4
        and (np.array(covered) > 0.9 * whole).all()
        and min(high - low) > 6 * width_px
    )
