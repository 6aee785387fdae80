"""What thinning leaves behind and nobody drew: spurs, split crossings, crumbs, pinholes."""

from __future__ import annotations

from collections.abc import Set

import numpy as np
from numpy.typing import NDArray

from wrapit.drawing.bitmap.strand_graph import StrandGraph
from wrapit.geometry import FloatArray
from wrapit.geometry.disjoint_sets import Sets

# What is a pinhole, where antialiased strokes meet? Less than 0.12 squared widths of paper; they made false
# junctions of degree five and six on prototypes. Looked for only inside rings of strands that are each
# shorter than 1.6 widths, which no larger hole allows. 30 % make no difference.
_PINHOLE_RING = 1.6
_PINHOLE_AREA = 0.12
# What is a spur? A side branch shorter than this many half widths of the ink at its junction, which end
# hardly beyond the edge of the other stroke; set on prototypes.
_SPUR = 1.4
# What is a short stroke's end instead? One as broad up to its round tip as strokes are, at least so long
# (0.45 beyond the other stroke's axis), whose tip is farther than this from what else leaves its fork, some
# of which leaves to the side: at less than 120 degrees from it (minus the cosine), unlike at acute tips.
_STUB = 0.3
_FULL = (0.42, 0.58)
_BEYOND = 0.8
_ASIDE = -0.5
# How far is the edge of the ink where a bar lies on a post? 0.63, up to 0.72 aslant or in few pixels; at the
# tips of arrows, which have stems as well, 0.86.
_FORK = 0.78
# What is a fork into the corners of a flat end? Its twigs are 0.71 of the width long, 1.41 half widths, and a
# pixel or two more or less; those of a drawn fork are longer, or have paper between their tips. And they run
# out into the corners: at five sixths of their length the ink is a third as broad as halfway, that of a short
# stroke nearly as broad (an arrow against a bar lost its bar, and one of short barbs those).
_CORNER = 1.9
_TAPERED = 0.55
_BEFORE_TIPS = 0.75
# What is a loop around nothing, and a speck of dirt? In stroke widths; the first was set on prototypes, the
# second is a dot, no line.
_SMALLEST_LOOP = 2.2
_SPECK = 1.5


class Radii:
    """Half the width of the ink around any place: the distance to its edge."""

    def __init__(self, pixels: FloatArray, distance: FloatArray) -> None:
        from scipy.spatial import cKDTree

        self._tree = cKDTree(pixels)
        self._distance = distance
        self.largest = float(distance.max())

    def __call__(self, point: FloatArray) -> float:
        return float(self._distance[self._tree.query(point)[1]])

    def at(self, points: list[FloatArray]) -> list[float]:
        """The same for many places in one look."""
        found: list[float] = self._distance[self._tree.query(np.array(points))[1]].tolist() if points else []
        return found


def tidy(graph: StrandGraph, radius: Radii, width_px: float) -> bool:
    """Drops small loops and spurs until none is left (a loop may sit at the tip of a spur)."""
    changed = False
    while True:
        before = len(graph.strands)
        _drop_small_loops(graph, width_px)
        _prune_spurs(graph, radius, width_px)
        if len(graph.strands) == before:
            return changed
        changed = True


def _prune_spurs(graph: StrandGraph, radius: Radii, width_px: float) -> None:
    """Drops side branches shorter than `_SPUR` half widths of the ink at their junction, shortest first."""
    longest = _SPUR * max(radius.largest, width_px / 2)
    while True:
        spurs = []
        for strand, s in graph.strands.items():
            free = [graph.degree(node) == 1 for node in (s.start, s.end)]
            if free[0] == free[1]:
                continue
            node = s.end if free[0] else s.start
            length = graph.length(strand)
            short = length < longest and length < _SPUR * max(radius(graph.nodes[node]), width_px / 2)
            if short and not _is_stub(graph, strand, node, radius, width_px):
                spurs.append((length, strand, node))
        if not spurs:
            return
        touched: set[int] = set()
        for length, strand, node in sorted(spurs):
            if node in touched or graph.degree(node) < 3:
                continue
            touched.add(node)
            s = graph.strands[strand]
            tip = s.start if s.end == node else s.end
            graph.note("spur", graph.nodes[tip], length, "shorter than the stroke is wide")
            graph.drop_strand(strand)
            if graph.degree(node) == 2:
                graph.rejoin(node)
        if not touched:
            return
        graph.drop_lonely()


def _is_stub(graph: StrandGraph, strand: int, node: int, radius: Radii, width_px: float) -> bool:
    """Whether a side branch is the short end of a stroke across another, as of a bar on a post."""
    s = graph.strands[strand]
    tip = graph.nodes[s.start if s.end == node else s.end]
    at = graph.nodes[node]
    length, broad = float(np.linalg.norm(tip - at)), radius(tip)
    if length < _STUB * width_px or not _FULL[0] < broad / width_px < _FULL[1]:
        return False
    if radius(at) > _FORK * width_px:
        return False
    outwards = (tip - at) / length
    out = tip + broad * outwards
    crosses = False
    for other, end in graph.ends_at(node):
        if other == strand:
            continue
        points = graph.leaving(other, end)
        if not len(points):
            return False
        if np.linalg.norm(points - out, axis=1).min() < _BEYOND * width_px:
            return False
        aside = points[min(len(points) - 1, round(width_px))] - at
        crosses |= bool(aside @ outwards > _ASIDE * np.linalg.norm(aside))
    return crosses


def join_flat_ends(graph: StrandGraph, mask: NDArray[np.bool_], radius: Radii, width_px: float) -> None:
    """One end in place of the fork into both corners of a broad stroke's flat end."""
    for node in [node for node in graph.nodes if graph.degree(node) == 3]:
        twigs = [
            (strand, tip)
            for strand, end in graph.ends_at(node)
            if graph.degree(tip := graph.other_node(strand, end)) == 1
        ]
        if len(twigs) < 2:
            continue
        reach = _CORNER * max(radius(graph.nodes[node]), width_px / 2)
        twigs = [
            (strand, tip)
            for strand, tip in twigs
            if graph.length(strand) < reach
            and _runs_out(graph.path(strand), tip == graph.strands[strand].end, radius)
        ]
        if len(twigs) != 2:
            continue
        # The tips themselves may be the ink's outermost pixels.
        at = graph.nodes[node]
        one, other = (at + _BEFORE_TIPS * (graph.nodes[tip] - at) for _, tip in twigs)
        between = one + np.linspace(0, 1, max(2, int(2 * reach)))[:, None] * (other - one)
        column, row = np.rint(between).astype(int).T
        if not mask[row, column].all():
            continue
        for strand, tip in twigs:
            graph.note("spur", graph.nodes[tip], graph.length(strand), "a corner of a flat end")
            graph.drop_strand(strand)
        graph.drop_lonely()


def _runs_out(path: FloatArray, forwards: bool, radius: Radii) -> bool:
    """Whether the ink along a twig becomes narrower and narrower towards its tip."""
    path = path if forwards else path[::-1]
    last = len(path) - 1
    return radius(path[last * 5 // 6]) < _TAPERED * radius(path[last // 2])


def contract_short(graph: StrandGraph, radius: Radii, share: float, apart: Set[int] = frozenset()) -> None:
    """Makes one node of two whose strand is shorter than `share` times the sum of their half widths.

    Strands in `apart` stay.
    """
    merged = True
    while merged:
        short = []
        forks = [node for node in graph.nodes if graph.degree(node) >= 3]
        reach = dict(zip(forks, radius.at([graph.nodes[node] for node in forks]), strict=True))
        for strand, s in graph.strands.items():
            if strand in apart or s.start == s.end or s.start not in reach or s.end not in reach:
                continue
            limit = share * (reach[s.start] + reach[s.end])
            if len(s.points) <= limit and (length := graph.length(strand)) < limit:
                short.append((length, strand))
        merged, touched = False, set[int]()
        for _, strand in sorted(short):
            s = graph.strands[strand]
            if s.start in touched or s.end in touched:
                continue
            touched |= {s.start, s.end}
            graph.merge([s.start, s.end], (graph.nodes[s.start] + graph.nodes[s.end]) / 2, [strand])
            merged = True


def _drop_small_loops(graph: StrandGraph, width_px: float) -> None:
    """Drops loops around nothing: shorter than `_SMALLEST_LOOP`, from a node to itself."""
    for strand, s in list(graph.strands.items()):
        if s.start == s.end and graph.length(strand) < _SMALLEST_LOOP * width_px:
            if len(s.points) > width_px / 2:
                graph.note(
                    "loop", graph.nodes[s.start], graph.length(strand), "smaller than the stroke is wide"
                )
            graph.drop_strand(strand)
    graph.drop_lonely()
    graph.rejoin_all()


def components(graph: StrandGraph) -> list[list[int]]:
    """The strands of each connected piece, the longest piece first."""
    group: dict[int, int] = {}
    count = 0
    for seed in graph.nodes:
        if seed in group:
            continue
        queue, group[seed] = [seed], count
        for node in queue:
            for strand, _ in graph.ends_at(node):
                s = graph.strands[strand]
                for other in (s.start, s.end):
                    if other not in group:
                        group[other] = count
                        queue.append(other)
        count += 1
    pieces: list[list[int]] = [[] for _ in range(count)]
    for strand, s in graph.strands.items():
        pieces[group[s.start]].append(strand)
    return sorted(filter(None, pieces), key=lambda strands: -sum(graph.length(k) for k in strands))


def drop_crumbs(graph: StrandGraph, width_px: float) -> None:
    """Drops specks of dirt: pieces shorter than the stroke is wide."""
    for strands in components(graph)[1:]:
        length = sum(graph.length(strand) for strand in strands)
        if length < _SPECK * width_px:
            graph.note(
                "speck", graph.path(strands[0]).mean(axis=0), length, "no longer than the stroke is wide"
            )
            for strand in strands:
                graph.drop_strand(strand)
    graph.drop_lonely()


def without_pinholes(
    graph: StrandGraph, mask: NDArray[np.bool_], width_px: float
) -> NDArray[np.bool_] | None:
    """The mask with pinholes filled, or nothing where there are none.

    Pinholes are specks of paper inside the ink, where antialiased strokes meet; they would become rings.

    Only places where short strands close a ring are looked at, not the whole picture.
    """
    filled = None
    for ring in _rings(graph, width_px):
        points = np.concatenate([graph.path(strand) for strand in ring])
        x0, y0 = np.maximum(points.min(axis=0).astype(int) - 2, 0)
        x1, y1 = points.max(axis=0).astype(int) + 3
        window = (slice(y0, y1), slice(x0, x1))
        holes = _holes(mask[window], _PINHOLE_AREA * width_px**2)
        if holes.any():
            filled = mask.copy() if filled is None else filled
            filled[window] |= holes
    return filled


def _rings(graph: StrandGraph, width_px: float) -> list[list[int]]:
    """Groups of short strands that hang together and close at least one ring."""
    together = Sets()
    short = [s for s in graph.strands if len(graph.strands[s].points) < _PINHOLE_RING * width_px]
    for strand in short:
        s = graph.strands[strand]
        together.merge(s.start, s.end)
    groups: dict[int, list[int]] = {}
    for strand in short:
        groups.setdefault(together.find(graph.strands[strand].start), []).append(strand)
    rings = []
    for group in groups.values():
        nodes = {node for k in group for node in (graph.strands[k].start, graph.strands[k].end)}
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
