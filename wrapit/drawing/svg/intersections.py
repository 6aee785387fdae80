"""Where exact curves meet: crossings, and ends that touch another curve."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from wrapit.drawing.svg.newton import crossings_near, points_at
from wrapit.drawing.svg.steps import Steps
from wrapit.errors import DrawingError
from wrapit.geometry import FloatArray, IntArray

# Parameters closer than this are one place: Newton's method comes to 1e-9 of the drawing's size.
_SAME = 1e-6
# On one curve, meeting itself: closer than this is a step and its neighbour.
_ITSELF = 1e-3
# What takes about a minute: 1,200 random lines with 164,000 crossings were measured at 47 s, and pairs of
# steps that only run close beside each other, as in hatching, at 4 million a second.
MOST_CONTACTS = 200_000
MOST_PAIRS = 200_000_000


@dataclass(frozen=True, eq=False)
class Contact:
    """A place where curves meet, and for each the curve's number and its parameter there.

    The whole part of a parameter counts the cubics before it.
    """

    point: FloatArray
    on: tuple[tuple[int, float], ...]


def crossings(steps: Steps, closed: list[bool], where: str = "drawing") -> list[Contact]:
    """All crossings of curves with each other and with themselves, exact to rounding.

    Raises DrawingError, which names `where`, if there are too many to be a drawing.
    """
    found = _Found()
    pairs = 0
    for first, second in steps.pairs():
        pairs += len(first)
        apart = ~steps.adjacent(first, second, closed)
        for contact in _contacts(steps, first[apart], second[apart]):
            found.add(contact)
        if len(found.contacts) > MOST_CONTACTS or pairs > MOST_PAIRS:
            raise _too_many(steps, int(np.bincount(first).argmax()), where)
    return found.contacts


def _contacts(steps: Steps, first: IntArray, second: IntArray) -> Iterator[Contact]:
    rows, at_a, at_b = crossings_near(steps, first, second)
    a, b = steps.curve[first[rows]], steps.curve[second[rows]]
    true = (a != b) | (np.abs(at_a - at_b) >= _ITSELF)
    a, b, at_a, at_b = a[true], b[true], at_a[true], at_b[true]
    points = points_at(steps, a, at_a)
    rest = (a.tolist(), at_a.tolist(), b.tolist(), at_b.tolist())
    for point, one, at, other, there in zip(points, *rest, strict=True):
        yield Contact(point, ((one, at), (other, there)))


def _too_many(steps: Steps, dense: int, where: str) -> DrawingError:
    x, y = steps.ends[dense].mean(axis=0)
    return DrawingError(
        f"the lines cross, or run close beside each other, in more than {MOST_CONTACTS:,} places, "
        f"many of them near ({x:.1f}, {y:.1f}) px",
        where,
        "draw only the lines that are to become wire, without hatching and patterns",
    )


class _Found:
    """Contacts, each once however often it is found."""

    def __init__(self) -> None:
        self.contacts: list[Contact] = []
        self._near: dict[tuple[int, int, int], list[Contact]] = {}

    def add(self, contact: Contact) -> None:
        """Adds a contact that isn't there yet."""
        (one, at), (other, there) = contact.on
        cell = int(at / _SAME)
        for near in (cell - 1, cell, cell + 1):
            if any(_same(contact, known) for known in self._near.get((one, other, near), ())):
                return
        self.contacts.append(contact)
        # A curve that meets itself may be found from either side.
        for own in (at, there) if one == other else (at,):
            self._near.setdefault((one, other, int(own / _SAME)), []).append(contact)


def touches(curves: list[FloatArray], closed: list[bool], reach: float, steps: Steps) -> list[Contact]:
    """Ends of open curves that come closer than `reach` to a curve (their own far part included)."""
    found = []
    for curve, (cubics, loop) in enumerate(zip(curves, closed, strict=True)):
        if loop:
            continue
        along = np.diff(steps.ends[steps.of(curve)], axis=1)[:, 0]
        lengths = np.linalg.norm(along, axis=1)
        walk = lengths.cumsum()
        for at, walked in ((0.0, walk - lengths), (float(len(cubics)), walk[-1] - walk)):
            contact = _touch(curves, steps, curve, at, walked, reach)
            if contact is not None:
                found.append(contact)
    return found


def _touch(
    curves: list[FloatArray], steps: Steps, curve: int, at: float, walked: FloatArray, reach: float
) -> Contact | None:
    """The contact of one end, if any; `walked` is how far its own steps are from it along the curve."""
    end = _point(curves[curve], at)
    near = steps.near(end, reach)
    # Its own near part is no contact: what lies within a walk of three reaches.
    own = np.flatnonzero(steps.curve[near] == curve)
    near = np.delete(near, own[walked[near[own] - steps.of(curve).start] < 3 * reach])
    if not len(near):
        return None
    a, d = steps.ends[near, 0], steps.ends[near, 1] - steps.ends[near, 0]
    share = np.clip(((end - a) * d).sum(axis=1) / np.maximum((d * d).sum(axis=1), 1e-18), 0, 1)
    distance = np.linalg.norm(a + share[:, None] * d - end, axis=1)
    best = int(np.argmin(distance))
    if distance[best] > reach:
        return None
    nearest = int(near[best])
    other = int(steps.curve[nearest])
    t = float(steps.start[nearest] + share[best] * (steps.end[nearest] - steps.start[nearest]))
    t = _straight_on(curves[other], _foot(curves[other], t, end), curves[curve], at, reach)
    for tip in (0.0, float(len(curves[other]))):
        if np.linalg.norm(_point(curves[other], tip) - end) <= min(
            reach, 1.5 * distance[best] + 1e-9 * reach
        ):
            t = tip
    return Contact(_point(curves[other], t), ((other, t), (curve, at)))


def _foot(cubics: FloatArray, at: float, point: FloatArray) -> float:
    """Parameter nearest to a point, starting near it."""
    for _ in range(6):
        k = min(int(at), len(cubics) - 1)
        on, d = _local(cubics[k], at - k)
        at = float(np.clip(at + (point - on) @ d / max(float(d @ d), 1e-18), 0, len(cubics)))
    return at


def _straight_on(other: FloatArray, foot: float, own: FloatArray, at: float, reach: float) -> float:
    """Parameter where a curve, carried on (or cut back) straight at one end, meets another near its foot."""
    k = min(int(at), len(own) - 1)
    end, slope = _local(own[k], at - k)
    length = float(np.linalg.norm(slope))
    if length < 1e-12:
        return foot
    s, t = 0.0, foot
    for _ in range(8):
        m = min(int(t), len(other) - 1)
        on, d = _local(other[m], t - m)
        matrix = np.column_stack([slope / length, -d])
        if abs(np.linalg.det(matrix)) <= 0.2 * np.linalg.norm(d):
            return foot
        step = np.linalg.solve(matrix, on - end - s * slope / length)
        s, t = s + float(step[0]), float(np.clip(t + step[1], 0, len(other)))
    m = min(int(t), len(other) - 1)
    missed = np.linalg.norm(_local(other[m], t - m)[0] - end - s * slope / length)
    return t if abs(s) <= 1.5 * reach and missed < 1e-6 * reach else foot


def _point(cubics: FloatArray, at: float) -> FloatArray:
    k = min(int(at), len(cubics) - 1)
    return _local(cubics[k], at - k)[0]


def _local(cubic: FloatArray, t: float) -> tuple[FloatArray, FloatArray]:
    a, b, c, d = cubic
    s = 1 - t
    return (
        s**3 * a + 3 * s * s * t * b + 3 * s * t * t * c + t**3 * d,
        3 * (s * s * (b - a) + 2 * s * t * (c - b) + t * t * (d - c)),
    )


def _same(one: Contact, other: Contact) -> bool:
    """Whether two contacts of the same curves are at the same parameters, on one curve in any order."""
    return all(
        min(abs(at - there) for where, there in other.on if where == curve) < _SAME for curve, at in one.on
    )
