"""Parts of a sketch that are looked at one after another, where all of it at once would take too long."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping

import numpy as np

from wrapit.fit.sketch import Sketch


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
        near = np.argsort(np.hypot(*(middles - middles[first]).T), kind="stable")
        alike = dict.fromkeys(frozenset((n, pairs.get(n, n))) for n in numbers[near].tolist())
        region = [*alike][:size]
        left.difference_update(*region[: max(1, size // 2)])
        yield frozenset().union(*region)
