"""How far a taut wire passes from the drawn one."""

from __future__ import annotations

import numpy as np

from wrapit.geometry import FloatArray, IntArray

# Most points of the taut wire that drawn ones are matched with. Time and memory grow with their number times
# that of the drawn points: as many of each take 0.25 s and 128 MB, twice as many four times that. The
# distance is taken to the wire between them: only the order depends on it.
MOST_SAMPLES = 4000


def deviations(drawn: FloatArray, taut: FloatArray) -> FloatArray:
    """How far from each drawn vertex (n, 2), at equal steps, the taut wire (m, 2) passes: (n,), mm.

    Each vertex is matched with a place of the taut wire so that places keep the order of the vertices and the
    sum of squared distances is least. Where the wire passes by again is another place: it doesn't count.
    A loop that was pulled straight counts with its full height.
    """
    if len(taut) == 1 or not np.any(taut != taut[0]):
        return np.asarray(np.hypot(*(drawn - taut[0]).T))
    samples = _sampled(taut, _longest_step(drawn, taut))
    matched = _matched(drawn, samples)
    last = len(samples) - 1
    before = _to_segment(drawn, samples[np.maximum(matched - 1, 0)], samples[matched])
    after = _to_segment(drawn, samples[matched], samples[np.minimum(matched + 1, last)])
    return np.minimum(before, after)


def largest_within(deviation: FloatArray, at_mm: FloatArray, intervals_mm: FloatArray) -> FloatArray:
    """The largest deviation (k,) in each interval (k, 2) of the drawn wire; vertices lie at `at_mm` (n,).

    Between vertices deviations are read linearly, so that an interval without a vertex has an answer too.
    """
    found = np.interp(intervals_mm, at_mm, deviation).max(axis=1, initial=0.0)
    for number, (start, end) in enumerate(intervals_mm):
        inside = deviation[np.searchsorted(at_mm, start) : np.searchsorted(at_mm, end, side="right")]
        found[number] = max(found[number], inside.max(initial=0.0))
    return np.asarray(found)


def _longest_step(drawn: FloatArray, taut: FloatArray) -> float:
    """As far apart as drawn vertices, or as `MOST_SAMPLES` bear."""
    steps = np.hypot(*np.diff(drawn, axis=0).T)
    length = float(np.hypot(*np.diff(taut, axis=0).T).sum())
    return max(float(steps.mean()) if len(steps) else length, length / MOST_SAMPLES)


def _sampled(taut: FloatArray, longest: float) -> FloatArray:
    """The taut wire's vertices and points between them, none further than `longest` from the next."""
    along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(taut, axis=0).T))])
    counts = np.maximum(np.ceil(np.diff(along) / longest).astype(int), 1)
    # Each segment's own places: its start, then equal steps up to the next segment's.
    owner = np.repeat(np.arange(len(counts)), counts)
    inner = np.arange(len(owner)) - np.repeat(np.cumsum(counts) - counts, counts)
    share = inner / counts[owner]
    points = taut[owner] + share[:, None] * (taut[owner + 1] - taut[owner])
    return np.concatenate([points, taut[-1:]])


def _matched(drawn: FloatArray, samples: FloatArray) -> IntArray:
    """The sample (n,) of each drawn vertex, in order, with the least sum of squared distances."""
    x, y = np.ascontiguousarray(samples.T)
    totals = np.empty((len(drawn), len(samples)))
    total = np.zeros(len(samples))
    for row, (drawn_x, drawn_y) in enumerate(drawn.tolist()):
        totals[row] = total
        total = np.minimum.accumulate(total) + (x - drawn_x) ** 2 + (y - drawn_y) ** 2
    matched = np.empty(len(drawn), dtype=np.int64)
    matched[-1] = int(np.argmin(total))
    for row in range(len(drawn) - 1, 0, -1):
        # The best for the vertex before, up to here: where its sum is least, the last of such places.
        place = matched[row]
        matched[row - 1] = place - int(np.argmin(totals[row, place::-1]))
    return matched


def _to_segment(points: FloatArray, start: FloatArray, end: FloatArray) -> FloatArray:
    """Distance (n,) of each point from its segment (n, 2), (n, 2); a segment may be a point."""
    along, offset = end - start, points - start
    squared = np.maximum((along**2).sum(axis=1), np.finfo(float).tiny)
    share = np.clip((offset * along).sum(axis=1) / squared, 0.0, 1.0)
    return np.asarray(np.hypot(*(offset - share[:, None] * along).T))
