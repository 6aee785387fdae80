"""Pinholes: specks of paper inside the ink, where antialiased strokes meet, that would become rings."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from wrapit.drawing.bitmap.strand_graph import Network

# In stroke widths, and squares of them.
_SHORT = 1.6
_AREA = 0.12


def without_pinholes(net: Network, mask: NDArray[np.bool_], width_px: float) -> NDArray[np.bool_] | None:
    """The mask with pinholes filled, or nothing where there are none.

    Only places where short strands close a ring are looked at, not the whole picture.
    """
    filled = None
    for ring in _rings(net, width_px):
        points = np.concatenate([net.path(strand) for strand in ring])
        x0, y0 = np.maximum(points.min(axis=0).astype(int) - 2, 0)
        x1, y1 = points.max(axis=0).astype(int) + 3
        window = (slice(y0, y1), slice(x0, x1))
        holes = _holes(mask[window], _AREA * width_px**2)
        if holes.any():
            filled = mask.copy() if filled is None else filled
            filled[window] |= holes
    return filled


def _rings(net: Network, width_px: float) -> list[list[int]]:
    """Groups of short strands that hang together and close at least one ring."""
    parent: dict[int, int] = {}

    def root(node: int) -> int:
        while parent.setdefault(node, node) != node:
            node = parent[node]
        return node

    short = [s for s in net.strands if len(net.strands[s].points) < _SHORT * width_px]
    for strand in short:
        s = net.strands[strand]
        parent[root(s.start)] = root(s.end)
    groups: dict[int, list[int]] = {}
    for strand in short:
        groups.setdefault(root(net.strands[strand].start), []).append(strand)
    rings = []
    for group in groups.values():
        nodes = {node for k in group for node in (net.strands[k].start, net.strands[k].end)}
        if len(group) >= len(nodes):
            rings.append(group)
    return rings


def _holes(window: NDArray[np.bool_], largest: float) -> NDArray[np.bool_]:
    from scipy.ndimage import label

    labels, _ = label(~window)
    areas = np.bincount(labels.ravel())
    small = areas <= largest
    small[0] = False
    small[np.concatenate([labels[0], labels[-1], labels[:, 0], labels[:, -1]])] = False
    return small[labels]
