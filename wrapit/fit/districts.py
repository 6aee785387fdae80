"""Parts of a sketch: what it falls into, and regions that are looked at one after another."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping

import numpy as np

from wrapit.fit.sketch import Sketch
from wrapit.geometry.disjoint_sets import Sets


def regions(
    sketch: Sketch, of: Collection[int], pairs: Mapping[int, int], size: int
) -> Iterator[frozenset[int]]:
    """The lines `of` a sketch near to one another, so many each, that overlap by half and cover all.

    Mirror images are in one region, and count as one.
    """
    numbers = np.array(sorted(of))
    middles = np.array([sketch.lines[n].curve.sampled(1.0).mean(axis=0) for n in numbers.tolist()])
    across = int(np.argmax(np.ptp(middles, axis=0)))
    left = set(numbers.tolist())
    for first in np.argsort(middles[:, across], kind="stable").tolist():
        if numbers[first] not in left:
            continue
        apart = np.hypot(*(middles - middles[first]).T)
        apart[first] = -1.0  # itself before others at its place
        near = np.argsort(apart, kind="stable")
        alike = dict.fromkeys(frozenset((n, pairs.get(n, n))) for n in numbers[near].tolist())
        region = [*alike][:size]
        left.difference_update(*region[: max(1, size // 2)])
        yield frozenset().union(*region)


def parted(sketch: Sketch, dropped: set[int]) -> Iterator[frozenset[int]]:
    """Nodes of the parts that what is left falls into, but for the largest part."""
    parts = Sets()
    length_mm: dict[int, float] = {}
    left = {n: line for n, line in sketch.lines.items() if n not in dropped}
    for line in left.values():
        parts.merge(line.start, line.end)
    for line in left.values():
        root = parts.find(line.start)
        length_mm[root] = length_mm.get(root, 0.0) + line.curve.length
    whole = max(length_mm, key=lambda root: (length_mm[root], -root), default=None)
    for root in sorted(length_mm):
        if root != whole:
            yield frozenset(node for node in sketch.nodes if parts.find(node) == root)
