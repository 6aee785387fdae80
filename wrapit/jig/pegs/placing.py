"""Which hole and which peg serve a turn best, and where on the board the piece lies best.

A peg stands on the inside of a turn. Wire bent round it keeps a distance of peg radius + wire radius from its
middle; the turn follows it where the drawing does too, within `pegs.reach`. No peg may stand in any wire's
way. Each turn takes the peg that most of it follows (of equal ones the nearest, then the thickest).
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from wrapit.config import PegsConfig
from wrapit.geometry import FloatArray
from wrapit.jig.channel import SIDES, Channels
from wrapit.jig.openings.bead_room import bead_obstacles
from wrapit.jig.pegs.model import Board, Cell, Peg, PegPlan
from wrapit.wires.model import Turn

# The piece is tried at so many places in a pitch, along x and along y: finer than a hand lays it on a board.
SHIFTS = 8
# A peg may push wire aside by this much. Boards are tried in steps of an eighth of a pitch, so a peg that
# fills its turn lies up to 0.44 mm off at 5 mm pitch; 0.1 mm refused most of those, and hands bend no finer.
SQUEEZE_MM = 0.3
# Of points along a turn: shares are right to a point in ten on the tightest turns.
STEP_MM = 0.25
# Less of a turn than this is no help to the hand: the peg is left out. (What 30 % up or down changes of all
# four is on the page beside this.)
LEAST_SHARE = 0.3


@dataclass(frozen=True)
class _Choice:
    share: float
    gap_mm: float
    diameter_mm: float
    cell: Cell


@dataclass(frozen=True, eq=False)
class _Inside:
    """A turn's points (m, 2) and normals (m, 2) towards its inside."""

    turn: Turn
    points: FloatArray
    normals: FloatArray


def place_pegs(channels: Channels, config: PegsConfig) -> PegPlan:
    """The board with a peg for each turn that one can serve, the piece lying where most turns are served."""
    import shapely

    low = np.vstack([chain.points.reshape(-1, 2).min(axis=0) for chain in channels.chains]).min(axis=0)
    high = np.vstack([chain.points.reshape(-1, 2).max(axis=0) for chain in channels.chains]).max(axis=0)
    lines = shapely.union_all([shapely.LineString(chain.sampled(0.05)) for chain in channels.chains])
    beads = bead_obstacles(channels.wires, channels.clearance_mm)
    turns = [_inside(channels, turn) for turn in channels.turns if not turn.stretch]
    best: tuple[float, list[list[_Choice]], Board] | None = None
    for board in _boards(low, high, config):
        choices = _choices(board, turns, (lines, beads), channels.diameter_mm / 2, config)
        score = sum(each[0].share for each in choices if each)
        if best is None or score > best[0] + 1e-9:
            best = score, choices, board
        if not turns:
            break
    assert best is not None, "there is at least one place for the board"
    _, choices, board = best
    return _without_conflicts(board, turns, choices)


def _boards(low: FloatArray, high: FloatArray, config: PegsConfig) -> Iterator[Board]:
    """Boards that cover the piece and a pitch around it, shifted by parts of a pitch."""
    pitch = config.pitch
    columns, rows = (math.ceil(float(size) / pitch) + 3 for size in high - low)
    for i, j in itertools.product(range(SHIFTS), repeat=2):
        x, y = (float(low[0]) - pitch * (1 + i / SHIFTS), float(low[1]) - pitch * (1 + j / SHIFTS))
        yield Board((x, y), pitch, columns, rows, config.margin)


def _inside(channels: Channels, turn: Turn) -> _Inside:
    _, points, normals, _ = channels.stations(turn, STEP_MM)
    return _Inside(turn, points, normals * SIDES[turn.inside])


def _choices(
    board: Board, turns: Sequence[_Inside], near_by: tuple[Any, Any], radius_mm: float, config: PegsConfig
) -> list[list[_Choice]]:
    """For each turn the pegs that can serve it, the best first; clear of the wires' lines and their beads."""
    import shapely

    cells = np.array(list(itertools.product(range(board.columns), range(board.rows))))
    places = np.array(board.origin) + cells * board.pitch_mm
    lines, beads = (shapely.distance(shapely.points(places), each) for each in near_by)
    room_mm = np.fmin(lines - radius_mm, beads)  # without beads their distance is no number
    diameters = sorted(set(config.diameters))
    widest_mm = diameters[-1] / 2 + radius_mm + config.reach
    found = []
    for turn in turns:
        near = np.flatnonzero(
            (places >= turn.points.min(axis=0) - widest_mm).all(axis=1)
            & (places <= turn.points.max(axis=0) + widest_mm).all(axis=1)
        )
        away = places[near][:, None] - turn.points[None]
        apart = np.linalg.norm(away, axis=2)
        nearest = apart.argmin(axis=1)
        row = np.arange(len(near))
        inside = (away[row, nearest] * turn.normals[nearest]).sum(axis=1) > 0
        choices = []
        for diameter in diameters:
            follows = np.abs(apart - diameter / 2 - radius_mm) <= config.reach
            fits = inside & (room_mm[near] >= diameter / 2 - SQUEEZE_MM)
            gaps = np.abs(apart[row, nearest] - diameter / 2 - radius_mm)
            choices += [
                _Choice(
                    float(follows[k].mean()),
                    float(gaps[k]),
                    diameter,
                    (int(cells[near[k]][0]), int(cells[near[k]][1])),
                )
                for k in np.flatnonzero(fits & (follows.mean(axis=1) >= LEAST_SHARE))
            ]
        found.append(sorted(choices, key=_rank))
    return found


def _rank(choice: _Choice) -> tuple[float, float, float, Cell]:
    return -round(choice.share, 6), round(choice.gap_mm, 6), -choice.diameter_mm, choice.cell


def _without_conflicts(
    board: Board, turns: Sequence[_Inside], choices: Sequence[Sequence[_Choice]]
) -> PegPlan:
    """Each turn's best peg that leaves room for those of turns before it, the best served first."""
    standing: dict[Cell, float] = {}
    served: dict[Cell, list[tuple[Turn, float]]] = {}
    unserved = []
    order = sorted(range(len(turns)), key=lambda k: (-choices[k][0].share if choices[k] else 0.0, k))
    for k in order:
        choice = next((each for each in choices[k] if _stands(board, each, standing)), None)
        if choice is None:
            unserved.append(turns[k].turn)
            continue
        standing[choice.cell] = choice.diameter_mm
        served.setdefault(choice.cell, []).append((turns[k].turn, choice.share))
    pegs = (
        Peg(cell, standing[cell], tuple(sorted(served[cell], key=lambda one: (one[0].wire, one[0].start_mm))))
        for cell in sorted(standing)
    )
    ordered = sorted(unserved, key=lambda turn: (turn.wire, turn.start_mm))
    return PegPlan(board, tuple(pegs), tuple(ordered))


def _stands(board: Board, choice: _Choice, standing: dict[Cell, float]) -> bool:
    """Whether a peg has room beside those that stand already; one that stands may serve two turns."""
    if choice.cell in standing:
        return standing[choice.cell] == choice.diameter_mm
    here = board.place(choice.cell)
    return all(
        math.dist(here, board.place(cell)) >= (choice.diameter_mm + diameter) / 2
        for cell, diameter in standing.items()
    )
