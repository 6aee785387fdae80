"""Pieces laid of known wires, as in the paper's Figure 5, drawn in ink.

Wires are smooth, or have one sharp bend where they touch another wire; they start and end on other
wires, often two at one point, or run out freely; they cross at clear angles.
"""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from examples.ink import PIXELS_PER_UNIT, ink
from wrapit.geometry import BezierChain, FloatArray

UNITS_PER_STROKE = 1.2
_STEP = 0.5  # between samples, in units
_APART = 6.0  # least distance of two junctions
_CLEAR = 2.6  # least distance of two lines away from their junctions
_STEEP_RAD = math.radians(45)
_FREE, _SHARED, _BOUNCE = 0.15, 0.02, 0.4  # of the wires proposed; most with a bounce find no room


@dataclass(frozen=True, eq=False)
class Composed:
    """Known wires in drawing units, y down; `lines` are samples (m, 2) of each."""

    wires: tuple[BezierChain, ...]
    lines: tuple[FloatArray, ...]
    side: float
    px_per_unit: float = PIXELS_PER_UNIT

    @property
    def wires_apart(self) -> set[int]:
        """The wires that end where no other one ends."""
        ends = [(wire.start, wire.end) for wire in self.wires]
        return {
            index
            for index, own in enumerate(ends)
            if not any(
                np.allclose(a, b)
                for other, theirs in enumerate(ends)
                if other != index
                for a, b in itertools.product(own, theirs)
            )
        }


@dataclass(eq=False)
class _Table:
    """What lies on the table so far."""

    side: float
    wires: list[BezierChain]
    lines: list[FloatArray]
    joints: list[FloatArray]
    ends: list[tuple[FloatArray, FloatArray]]  # of wires on others: place, direction into the wire
    loose: list[FloatArray]


def compose(rng: np.random.Generator, wires: int) -> Composed:
    """A piece of that many wires, each touched by others at two places or more (but for the first)."""
    while True:
        table = _begun(rng, 30 * math.sqrt(wires))
        for _ in range(400 * wires):
            if len(table.wires) == wires:
                return Composed(tuple(table.wires), tuple(table.lines), table.side)
            _try_another(rng, table)


def write_ink(piece: Composed, folder: Path) -> Path:
    """Draws the piece as a scanned pen drawing, `piece.png`, beside its strokes, `piece.svg`."""
    strokes = "\n".join(f'<path d="{_data(wire)}"/>' for wire in piece.wires)
    side = f"{piece.side:.0f}"
    source = folder / "piece.svg"
    source.write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{side}mm" height="{side}mm" '
        f'viewBox="0 0 {side} {side}" fill="none" stroke="black" stroke-width="{UNITS_PER_STROKE}">'
        f"\n{strokes}\n</svg>\n",
        encoding="utf-8",
    )
    target = folder / "piece.png"
    ink(source).save(target)
    return target


def _data(wire: BezierChain) -> str:
    words = [f"M{wire.start[0]:.4f} {wire.start[1]:.4f}"]
    words += ["C" + " ".join(f"{x:.4f} {y:.4f}" for x, y in cubic[1:]) for cubic in wire.points]
    return " ".join(words)


def _begun(rng: np.random.Generator, side: float) -> _Table:
    """One wire across the table."""
    a, b = (np.array([x * side, rng.uniform(0.3, 0.7) * side]) for x in (0.1, 0.9))
    lift = rng.uniform(-0.3, 0.3, 2) * side
    lifts = np.array([[0.3 * side, lift[0]], [-0.3 * side, lift[1]]])
    wire = BezierChain(np.array([[a, a + lifts[0], b + lifts[1], b]]))
    return _Table(side, [wire], [wire.sampled(_STEP)], [], [], [a, b])


def _try_another(rng: np.random.Generator, table: _Table) -> None:
    """Proposes a wire, and lays it where it keeps clear of the others."""
    start, heading = _landing(rng, table)
    stops = [(start, heading, heading)]
    if rng.random() < _BOUNCE:
        stops.append(_bounce(rng, table))
    free = rng.random() < _FREE
    end, way = (rng.uniform(0.1, 0.9, 2) * table.side, _unit(rng)) if free else _landing(rng, table)
    stops.append((end, way, way))
    cubics = []
    for (a, _, out), (b, into, _) in itertools.pairwise(stops):
        handle = rng.uniform(0.3, 0.5) * float(np.linalg.norm(b - a))
        cubics.append([a, a + handle * out, b + handle * into, b])
    wire = BezierChain(np.array(cubics))
    places = [stop[0] for stop in (stops[:-1] if free else stops)]
    if not 14 < wire.length < 1.2 * table.side or (joints := _contacts(table, wire, places)) is None:
        return
    table.wires.append(wire)
    table.lines.append(wire.sampled(_STEP))
    table.joints += joints
    table.ends += [(start, heading)] + ([] if free else [(end, way)])
    table.loose += [end] if free else []


def _landing(rng: np.random.Generator, table: _Table) -> tuple[FloatArray, FloatArray]:
    """A place on a wire and the direction in which another one leaves it; some leave where one landed."""
    if table.ends and rng.random() < _SHARED:
        place, taken = table.ends[rng.integers(len(table.ends))]
        return place, _turned(-taken, rng.uniform(-0.4, 0.4))
    place, along = _somewhere(rng, table)
    return place, _turned(along, rng.choice([-1, 1]) * rng.uniform(0.9, math.pi - 0.9))


def _bounce(rng: np.random.Generator, table: _Table) -> tuple[FloatArray, FloatArray, FloatArray]:
    """A place on a wire where another one touches it and turns away on the same side."""
    place, along = _somewhere(rng, table)
    side, tilt = rng.choice([-1, 1]), rng.uniform(-0.15, 0.15)
    return place, _turned(along, side * (0.9 + tilt)), _turned(along, side * (math.pi - 0.9 + tilt))


def _somewhere(rng: np.random.Generator, table: _Table) -> tuple[FloatArray, FloatArray]:
    line = table.lines[rng.integers(len(table.lines))]
    index = int(rng.integers(6, max(7, len(line) - 6)))
    way = line[index + 1] - line[index - 1]
    return line[index], way / np.linalg.norm(way)


def _contacts(table: _Table, wire: BezierChain, places: list[FloatArray]) -> list[FloatArray] | None:
    """Where the wire would touch the others; None where it would come too near them, or to itself."""
    line = wire.sampled(_STEP)
    if line.min() < 3 or line.max() > table.side - 3 or not _easy(line, places):
        return None
    crossings = []
    for other in table.lines:
        for point, angle_rad in _crossings(line, other):
            if all(np.linalg.norm(point - place) > 1 for place in places):
                if angle_rad < _STEEP_RAD:
                    return None
                crossings.append(point)
    joints = [*places, *crossings]
    roomy = len(joints) >= 2 and _apart(table, joints, line[-1], len(places)) and _clear(table, joints, line)
    return joints if roomy else None


def _apart(table: _Table, joints: list[FloatArray], end: FloatArray, places: int) -> bool:
    """Whether junctions keep their distance; only an end may lie where one other wire ends."""
    for index, joint in enumerate(joints):
        own = [float(np.linalg.norm(joint - other)) for other in joints[:index]]
        laid = [float(np.linalg.norm(joint - other)) for other in table.joints]
        loose = [float(np.linalg.norm(joint - other)) for other in [*table.loose, end]]
        shared = sum(distance < 1e-9 for distance in laid)
        if min(own, default=_APART) < _APART or any(1e-9 < d < _APART for d in [*laid, *loose]):
            return False
        if shared > (1 if index in (0, places - 1) else 0):
            return False
    return True


def _clear(table: _Table, joints: list[FloatArray], line: FloatArray) -> bool:
    """Whether a line keeps clear of the others wherever it doesn't touch them."""
    away = np.min([np.linalg.norm(line - joint, axis=1) for joint in joints], axis=0)
    free = line[away > _CLEAR / math.sin(_STEEP_RAD) + 0.5]
    return all(
        (np.linalg.norm(free[:, None] - other[None], axis=2) >= _CLEAR).all()
        for other in [*table.lines, *(end[None] for end in table.loose)]
    )


def _easy(line: FloatArray, corners: list[FloatArray]) -> bool:
    """Whether a wire bends gently but at its corners, and keeps clear of itself."""
    way = np.diff(line, axis=0)
    angles = np.abs(np.diff(np.unwrap(np.arctan2(way[:, 1], way[:, 0]))))
    radius = np.linalg.norm(way[1:], axis=1) / np.maximum(angles, 1e-9)
    corner = np.min([np.linalg.norm(line[1:-1] - place, axis=1) for place in corners], axis=0) < 2 * _STEP
    if (radius[~corner] < 4).any():
        return False
    gap = np.linalg.norm(line[:, None] - line[None], axis=2)
    along = np.abs(np.subtract.outer(np.arange(len(line)), np.arange(len(line)))) * _STEP
    return not ((gap < 4) & (along > 10)).any()


def _crossings(line: FloatArray, other: FloatArray) -> list[tuple[FloatArray, float]]:
    """Points and angles at which two polylines cross."""
    low = np.maximum(line.min(axis=0), other.min(axis=0))
    high = np.minimum(line.max(axis=0), other.max(axis=0))
    (a, da), (b, db) = _steps_within(line, low, high), _steps_within(other, low, high)
    a, da, b, db = a[:, None], da[:, None], b[None], db[None]
    det = da[..., 0] * db[..., 1] - da[..., 1] * db[..., 0]
    safe = np.where(np.abs(det) < 1e-15, np.inf, det)
    gap = b - a
    s = (gap[..., 0] * db[..., 1] - gap[..., 1] * db[..., 0]) / safe
    t = (gap[..., 0] * da[..., 1] - gap[..., 1] * da[..., 0]) / safe
    found = []
    for i, j in np.argwhere((s >= 0) & (s < 1) & (t >= 0) & (t < 1)).tolist():
        angle_rad = abs(math.atan2(det[i, j], float((da[i, 0] * db[0, j]).sum())))
        found.append((a[i, 0] + s[i, j] * da[i, 0], min(angle_rad, math.pi - angle_rad)))
    return found


def _steps_within(line: FloatArray, low: FloatArray, high: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Starts and ways of the steps of a polyline that may reach into a box."""
    least, most = np.minimum(line[:-1], line[1:]), np.maximum(line[:-1], line[1:])
    near = ((most >= low) & (least <= high)).all(axis=1)
    return line[:-1][near], np.diff(line, axis=0)[near]


def _unit(rng: np.random.Generator) -> FloatArray:
    return _turned(np.array([1.0, 0.0]), rng.uniform(0, 2 * math.pi))


def _turned(direction: FloatArray, angle_rad: float) -> FloatArray:
    c, s = math.cos(angle_rad), math.sin(angle_rad)
    return np.array([c * direction[0] - s * direction[1], s * direction[0] + c * direction[1]])
