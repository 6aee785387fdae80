"""The shortest way through a sleeve: the funnel of Lee and Preparata (Networks 14, 1984)."""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from typing import NamedTuple

from wrapit.jig.taut.sleeve import Portal

# Portal of what is no portal's end: a way's own two ends.
NO_PORTAL = -1


class Bend(NamedTuple):
    """A point of the way, and the first portal that ends there."""

    x: float
    y: float
    portal: int = NO_PORTAL
    point: int = NO_PORTAL


def shortest(
    start: Bend, goal: Bend, portals: Sequence[Portal], xs: Sequence[float], ys: Sequence[float]
) -> list[Bend]:
    """The shortest way from `start` through the portals in order to `goal`: both, and where it bends.

    The funnel is what the last point settled (its apex) sees of the newest portal: two chains that bend away
    from each other. Each point of the sleeve joins a chain once and leaves it once, so that time grows with
    the sleeve's length and no faster. A sleeve may overlap itself: only points of one funnel are compared.
    """
    settled = [start]
    left: deque[Bend] = deque()
    right: deque[Bend] = deque()
    newest_left = newest_right = NO_PORTAL
    for number, portal in enumerate(portals):
        if portal.left != newest_left:
            newest_left = portal.left
            _widen(settled, left, right, Bend(xs[newest_left], ys[newest_left], number, newest_left), 1.0)
        if portal.right != newest_right:
            newest_right = portal.right
            _widen(settled, right, left, Bend(xs[newest_right], ys[newest_right], number, newest_right), -1.0)
    _widen(settled, left, right, goal, 1.0)
    return settled + list(left)


def _widen(settled: list[Bend], chain: deque[Bend], other: deque[Bend], new: Bend, side: float) -> None:
    """`new` ends one chain of the funnel, `side` 1 for the left, -1 for the right; the apex may move."""
    while chain:
        before = chain[-2] if len(chain) > 1 else settled[-1]
        if side * _turn(before, chain[-1], new) > 0:
            break
        chain.pop()
    if not chain:
        while other and side * _turn(settled[-1], other[0], new) <= 0:
            settled.append(other.popleft())
    chain.append(new)


def _turn(a: Bend, b: Bend, c: Bend) -> float:
    """Above 0 where a, b, c turn left."""
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)
