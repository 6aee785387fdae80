"""Parts of a sketch: what it falls into, and regions that are looked at one after another."""

from __future__ import annotations

import itertools
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


def parted(sketch: Sketch, dropped: set[int]) -> list[frozenset[int]]:
    """Nodes of the parts that what is left falls into, but for the largest part."""
    return _parts(sketch, dropped)[1][1:]


def cuts_of(sketch: Sketch, dropped: set[int]) -> Iterator[frozenset[int]]:
    """Sets of nodes that no line that is left leads out of; none where it hangs together.

    A part, then it with all that its dropped lines lead to, and so on until the largest part is reached, and
    the same from there: each is cut off by other lines (nested cuts; Koch and Martin 1998, Steiner trees).
    """
    joint, (largest, *others) = _parts(sketch, dropped)

    def wider(part: frozenset[int]) -> Iterator[frozenset[int]]:
        reached: frozenset[int] = frozenset()
        while part != reached:
            yield part
            reached, ends = part, [(line.start, line.end) for line in sketch.lines.values()]
            around = {joint.find(node) for each in ends if len(part.intersection(each)) == 1 for node in each}
            part |= {node for node in sketch.nodes if joint.find(node) in around}

    for part in others:
        yield from itertools.takewhile(largest.isdisjoint, wider(part))
    apart = frozenset[int]().union(*others)
    for part in itertools.takewhile(lambda part: not apart <= part, wider(largest)):
        yield part.symmetric_difference(sketch.nodes)


def _parts(sketch: Sketch, dropped: set[int]) -> tuple[Sets, list[frozenset[int]]]:
    """Nodes that lines that are left join, and of each part its nodes, the largest first."""
    joint = Sets()
    length_mm: dict[int, float] = {}
    left = [line for n, line in sketch.lines.items() if n not in dropped]
    for line in left:
        joint.merge(line.start, line.end)
    for line in left:
        root = joint.find(line.start)
        length_mm[root] = length_mm.get(root, 0.0) + line.curve.length
    roots = sorted(length_mm, key=lambda root: (-length_mm[root], root))
    return joint, [frozenset(n for n in sketch.nodes if joint.find(n) == root) for root in roots]
