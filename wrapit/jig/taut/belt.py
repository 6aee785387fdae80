"""The shortest loop through a sleeve that ends where it starts: a belt round what it encloses."""

from __future__ import annotations

import numpy as np

from wrapit.geometry import FloatArray
from wrapit.jig.taut.funnel import NO_PORTAL, Bend, shortest
from wrapit.jig.taut.sleeve import Portal, Walker

# How many times round the sleeve a way is pulled to find the loop in its middle. Three were enough for each
# of 676 closed wires in random fields that obstacles held; the others cost nothing until they are needed.
ROUNDS = (3, 6, 24, 96)


def belt(walker: Walker, loop: list[int]) -> FloatArray:
    """The shortest loop (m, 2), first point = last, in a closed walk: first triangle = last, nothing undone.

    A way that goes round several times is drawn onto the loop in its first round and leaves it in its last.
    What repeats itself after one round, bend for bend, is the loop: it is straight or held at every point,
    and there is no other such in its class.
    """
    once = walker.portals(loop)
    x = sum(walker.xs[corner] for corner in walker.corners[loop[0]]) / 3
    y = sum(walker.ys[corner] for corner in walker.corners[loop[0]]) / 3
    for rounds in ROUNDS:
        way = shortest(Bend(x, y), Bend(x, y), once * rounds, walker.xs, walker.ys)
        found = _repeated(way, len(once), rounds // 2 * len(once))
        if found:
            return _from_portal(found, once, walker)
    raise AssertionError("no way round and round settles on a loop")


def _repeated(way: list[Bend], period: int, middle: int) -> list[Bend]:
    """One round of the way, first bend = last, from the last bend before the portal `middle` that will do."""
    places = {(bend.portal, bend.point): place for place, bend in enumerate(way) if bend.portal != NO_PORTAL}
    before = [place for place, bend in enumerate(way) if NO_PORTAL < bend.portal <= middle]
    for place in reversed(before):
        again = places.get((way[place].portal + period, way[place].point))
        if again is None or again + 1 >= len(way):
            continue
        after, then = way[place + 1], way[again + 1]
        if (after.portal + period, after.point) == (then.portal, then.point):
            return way[place : again + 1]
    return []


def _from_portal(found: list[Bend], once: list[Portal], walker: Walker) -> FloatArray:
    """The loop's points from where it crosses the sleeve's first portal."""
    points = np.array([(bend.x, bend.y) for bend in found])
    first = found[0].portal // len(once) * len(once)
    base = first if first == found[0].portal else first + len(once)
    place = max(number for number, bend in enumerate(found) if bend.portal <= base)
    ring = points[:-1]
    start = _crossing(points[place], points[(place + 1) % len(ring)], once[0], walker)
    turned = np.roll(ring, -(place + 1), axis=0)
    return np.concatenate([start[None], turned, start[None]])


def _crossing(a: FloatArray, b: FloatArray, portal: Portal, walker: Walker) -> FloatArray:
    """Where the way from a to b crosses the portal; a where it runs along it or starts there."""
    left = np.array([walker.xs[portal.left], walker.ys[portal.left]])
    right = np.array([walker.xs[portal.right], walker.ys[portal.right]])
    across = left - right
    normal = np.array([-across[1], across[0]])
    rise = float(normal @ (b - a))
    share = float(normal @ (right - a)) / rise if rise != 0 else 0.0
    return np.asarray(a + min(max(share, 0.0), 1.0) * (b - a))
