"""From ink to a graph of pixel chains: thinning, junction clusters, ordered chains."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from wrapit.drawing.bitmap.strand_graph import StrandGraph
from wrapit.geometry import FloatArray, IntArray

if TYPE_CHECKING:
    from scipy.spatial import cKDTree

BoolImage = NDArray[np.bool_]
# How much shorter is the distance from a stroke's centre to the nearest paper pixel than half its width,
# twice? Measured from pixel centres, it is half a pixel too long.
_PIXEL_EXCESS = 0.5
# Of the rim's pixels, which are looked at to see whether thinning ate an end away? Every eighth: where an
# end is eaten away, all around it is bare.
_RIM_STEP = 8


@dataclass(frozen=True, eq=False)
class Skeleton:
    """Pixels (n, 2) as x, y; pairs (m, 2) of neighbours; distance (n,) of each to the edge of the ink."""

    pixels: FloatArray
    pairs: IntArray
    distance: FloatArray
    width_px: float


def thin_within(mask: BoolImage) -> Skeleton:
    """The skeleton of the ink, worked out only in the box around it."""
    rows, columns = np.flatnonzero(mask.any(axis=1)), np.flatnonzero(mask.any(axis=0))
    if not len(rows):
        raise ValueError("there is no ink")
    top, left = int(rows[0]), int(columns[0])
    skeleton = thin(np.ascontiguousarray(mask[top : rows[-1] + 1, left : columns[-1] + 1]))
    return replace(skeleton, pixels=skeleton.pixels + np.array([left, top]))


def thin(mask: BoolImage) -> Skeleton:
    """The skeleton of the ink.

    Zhang's method is fast, but on diagonal strokes of even width it eats the ends away; where that has
    happened Lee's slower one is used. Raises ValueError where there is no ink.
    """
    from skimage import morphology

    if not mask.any():
        raise ValueError("there is no ink")
    rim = _rim(mask)
    skeletonize: Any = morphology.skeletonize
    skeleton = _measured(skeletonize(mask), rim)
    reach, _ = _tree(skeleton.pixels).query(rim[::_RIM_STEP])
    if reach.max() > max(skeleton.width_px + 1, 1.2 * skeleton.distance.max()):
        skeleton = _measured(skeletonize(mask, method="lee") > 0, rim)
    return skeleton


def _rim(mask: BoolImage) -> FloatArray:
    """Paper pixels (n, 2) that touch ink, as x, y."""
    padded = np.pad(mask, 1)
    touching = np.zeros_like(padded)
    touching[1:] |= padded[:-1]
    touching[:-1] |= padded[1:]
    touching[:, 1:] |= padded[:, :-1]
    touching[:, :-1] |= padded[:, 1:]
    # Places in one row are found several times as fast as pairs of them.
    y, x = np.divmod(np.flatnonzero(touching > padded), padded.shape[1])
    return np.column_stack([x - 1.0, y - 1.0])


def _tree(points: FloatArray) -> cKDTree:
    """Looks up which of the points (n, 2) is nearest; leaves of 32 take a tenth less time than of 16."""
    from scipy.spatial import cKDTree

    return cKDTree(points, leafsize=32, balanced_tree=False, compact_nodes=False)


def _measured(thinned: BoolImage, rim: FloatArray) -> Skeleton:
    pixels, pairs = _neighbours(thinned)
    distance, _ = _tree(rim).query(pixels)
    return Skeleton(pixels, pairs, distance, float(2 * np.median(distance) - _PIXEL_EXCESS))


def _neighbours(thinned: BoolImage) -> tuple[FloatArray, IntArray]:
    """Pixels, and pairs of neighbours among them.

    A diagonal pair counts only where no pixel beside it connects the two, so that stairs have
    two neighbours each and only true branchings have more.
    """
    padded = np.pad(thinned, 1)
    stride = padded.shape[1]
    ink = padded.ravel()
    at = np.flatnonzero(ink)
    right, below = ink[at + 1], ink[at + stride]
    steps = (
        (1, right),
        (stride, below),
        (stride + 1, ink[at + stride + 1] & ~right & ~below),
        (stride - 1, ink[at + stride - 1] & ~ink[at - 1] & ~below),
    )
    pairs = [
        np.column_stack([np.flatnonzero(there), np.searchsorted(at, at[there] + step)])
        for step, there in steps
    ]
    pixels = np.column_stack([at % stride - 1, at // stride - 1]).astype(np.float64)
    return pixels, np.concatenate(pairs)


def strand_graph_of(pixels: FloatArray, pairs: IntArray) -> StrandGraph:
    """The strand graph of a skeleton: a node for each cluster of branching pixels, end and closed loop."""
    from scipy.sparse.csgraph import connected_components

    count = len(pixels)
    degree = np.bincount(pairs.ravel(), minlength=count)
    branching = degree >= 3
    between = branching[pairs]
    of_cluster = pairs[between.all(axis=1)]
    _, label = connected_components(_matrix(of_cluster, count), directed=False)
    clusters, label = np.unique(label[branching], return_inverse=True)
    cluster_of = np.full(count, -1)
    cluster_of[branching] = label

    graph = StrandGraph()
    sizes = np.bincount(label, minlength=len(clusters))
    for x, y in zip(*(np.bincount(label, pixels[branching, k]) / sizes for k in (0, 1)), strict=True):
        graph.add_node(np.array([x, y]))

    along = pairs[~between.any(axis=1)]
    order, starts = _chains(along, ~branching)
    touching = pairs[between.sum(axis=1) == 1]
    inner = np.where(branching[touching[:, 0]], touching[:, 1], touching[:, 0])
    outer = np.where(branching[touching[:, 0]], touching[:, 0], touching[:, 1])
    cluster_at: dict[int, list[int]] = {}
    for pixel, cluster in zip(inner.tolist(), cluster_of[outer].tolist(), strict=True):
        cluster_at.setdefault(pixel, []).append(cluster)

    closed = degree == 2
    for chain in np.split(order, starts[1:]) if len(order) else []:
        _add_chain(graph, chain, pixels, cluster_at, closed)
    return graph


def _add_chain(
    graph: StrandGraph,
    chain: IntArray,
    pixels: FloatArray,
    cluster_at: dict[int, list[int]],
    two_neighbours: NDArray[np.bool_],
) -> None:
    points = pixels[chain]
    first, last = int(chain[0]), int(chain[-1])
    heads, tails = cluster_at.get(first, []), cluster_at.get(last, [])
    if first == last:
        heads, tails = heads[:1], heads[1:2]
    if not heads and not tails and len(chain) > 2 and two_neighbours[first] and two_neighbours[last]:
        node = graph.add_node(points[0])
        graph.add_strand(node, node, points[1:])
        return
    head = heads[0] if heads else graph.add_node(points[0])
    tail = tails[0] if tails else graph.add_node(points[-1])
    inside = points[0 if heads else 1 : len(points) if tails else len(points) - 1]
    if head != tail or len(inside):
        graph.add_strand(head, tail, inside)


def _chains(pairs: IntArray, member: NDArray[np.bool_]) -> tuple[IntArray, IntArray]:
    """Pixels of all chains in walking order, and where each chain starts in that list.

    One depth-first search from a virtual root that touches one end of each chain, instead of a walk
    over pixels in Python.
    """
    from scipy.sparse.csgraph import connected_components, depth_first_order

    count = len(member)
    neighbours = np.bincount(pairs.ravel(), minlength=count)
    _, component = connected_components(_matrix(pairs, count), directed=False)
    ids = np.flatnonzero(member)
    # The first pixel of each chain: an end if it has one (fewest neighbours first), else any pixel.
    ranked = ids[np.lexsort((ids, neighbours[ids], component[ids]))]
    first = np.ones(len(ranked), dtype=bool)
    first[1:] = component[ranked[1:]] != component[ranked[:-1]]
    starts = ranked[first]
    cut = _cycle_cuts(pairs, starts[neighbours[starts] == 2])
    links = np.concatenate([pairs[~cut], np.column_stack([np.full(len(starts), count), starts])])
    order = depth_first_order(_matrix(links, count + 1), count, directed=False, return_predecessors=False)[
        1:
    ].astype(np.int64)
    is_start = np.zeros(count, dtype=bool)
    is_start[starts] = True
    return order, np.flatnonzero(is_start[order])


def _cycle_cuts(pairs: IntArray, starts: IntArray) -> NDArray[np.bool_]:
    """One pair of each closed chain, so that it becomes an open one."""
    cut = np.zeros(len(pairs), dtype=bool)
    for start in starts:
        cut[np.flatnonzero((pairs == start).any(axis=1))[0]] = True
    return cut


def _matrix(pairs: IntArray, count: int) -> object:
    from scipy.sparse import coo_matrix

    return coo_matrix(
        (np.ones(len(pairs), dtype=np.int8), (pairs[:, 0], pairs[:, 1])), (count, count)
    ).tocsr()
