"""The integer programme of what to leave out, against every choice there is, with its costs written anew."""

from __future__ import annotations

import itertools
import math
from functools import cache

import numpy as np

from tests.fit.drawn import config, drawn
from wrapit.fit.faces import Faces, faces_of
from wrapit.fit.limits import limits_of
from wrapit.fit.mirrored import mirror_of
from wrapit.fit.model import Limits
from wrapit.fit.programme import Task, Weights, choose
from wrapit.fit.sketch import STEP_MM, Sketch, heading
from wrapit.fit.worth import worths

LEVELS = {"gentle": Weights(1.0, few=6, more_mm=0.0), "bold": Weights(6.0, few=2, more_mm=8.0)}
# Choices within this share of one another are as good: as exactly as the programme is solved.
ALIKE = 2e-4


def directions(sketch: Sketch) -> dict[int, list[tuple[int, np.ndarray]]]:
    """For each node the lines that leave it, and whereto."""
    leaving: dict[int, list[tuple[int, np.ndarray]]] = {}
    for n, line in sorted(sketch.lines.items()):
        leaving.setdefault(line.start, []).append((n, heading(line.curve.sampled(STEP_MM))))
        leaving.setdefault(line.end, []).append((n, heading(line.curve.reversed().sampled(STEP_MM))))
    return leaving


def courses(sketch: Sketch) -> list[tuple[int, int]]:
    """Pairs of ends that are one another's straightest, within 40 degrees; none where a line ends loose."""
    leaving = directions(sketch)
    loose = {ends[0][0] for ends in leaving.values() if len(ends) == 1}
    found = []
    for ends in leaving.values():

        def turn(a: int, b: int, ends: list[tuple[int, np.ndarray]] = ends) -> float:
            return math.acos(float(np.clip(-ends[a][1] @ ends[b][1], -1, 1)))

        best = {
            a: min((b for b in range(len(ends)) if b != a), key=lambda b: turn(a, b), default=a)
            for a in range(len(ends))
        }
        for a, b in best.items():
            if a < b and best[b] == a and turn(a, b) < math.radians(40):
                one, other = ends[a][0], ends[b][0]
                if one != other and not {one, other} & loose:
                    found.append((one, other))
    return found


def in_one_piece(sketch: Sketch, left: set[int]) -> bool:
    reached, rest = set(), set(left)
    first = sketch.lines[min(left)]
    reached |= {first.start, first.end}
    while grown := {n for n in rest if {sketch.lines[n].start, sketch.lines[n].end} & reached}:
        rest -= grown
        reached |= {node for n in grown for node in (sketch.lines[n].start, sketch.lines[n].end)}
    return not rest


def price(task: Task, dropped: set[int], straight: list[tuple[int, int]]) -> float:
    """What leaving lines out costs, in mm; infinite where the rest falls apart."""
    sketch, limits, weights = task.sketch, task.limits, task.weights
    left = set(sketch.lines) - dropped
    if not left or dropped & task.kept or not in_one_piece(sketch, left):
        return math.inf
    cost = sum(task.worth[n] for n in dropped)
    ends: dict[int, list[int]] = {}
    for n, line in sketch.lines.items():
        ends.setdefault(line.start, []).append(n)
        ends.setdefault(line.end, []).append(n)
    odd = sum(sum(n in left for n in there) % 2 for there in ends.values())
    cost += weights.wire_mm * odd / 2 + weights.more_mm * max(0.0, odd / 2 - weights.few)
    for there in ends.values():
        if len(there) > 1 and len(set(there)) == len(there) and sum(n in left for n in there) == 1:
            cost += 5.0
    for one, other in straight:
        if (one in left) != (other in left):
            seen = min(task.worth[n] / sketch.lines[n].curve.length for n in (one, other))
            cost += 8.0 * max(1.0, seen)
    for n in left:
        short = limits.shortest_mm - sketch.lines[n].curve.length
        grown = sum(
            sketch.lines[other].curve.length
            for node in {sketch.lines[n].start, sketch.lines[n].end}
            for other in {m for m in ends[node] if m in left and m != n}
            if {m for m in ends[node] if m in left} == {n, other}
            and sketch.lines[other].start != sketch.lines[other].end
        )
        cost += 30.0 if short > grown else 0.0
    for face in task.faces.faces:
        alone = len(face.lines) == 1 and all(sketch.lines[n].is_ring for n in face.lines)
        if face.inside_mm < (limits.ring_mm if alone else limits.room_mm) and face.lines <= left:
            cost += 60.0
    return cost


def task_of(sketch: Sketch, faces: Faces, limits: Limits, level: str) -> Task:
    return Task(sketch, faces, worths(sketch, faces, limits), limits, {}, frozenset(), {}, LEVELS[level])


@cache
def small_tasks() -> list[tuple[str, Task]]:
    """Drawings of at most seven lines, wherever something is wrong with them."""
    found = []
    kinds = ("net", "comb", "lens", "double", "scribble", "letters", "tree", "concentric", "rings", "grate")
    for seed, kind, level in itertools.product(range(33), kinds, ("gentle", "bold")):
        sketch = Sketch.of(drawn(kind, seed, (25.0, 40.0)[seed % 2])).simplified()
        if not 2 <= len(sketch.lines) <= 7:
            continue
        limits = limits_of(config(level, (22, 18, 16)[seed % 3]), level)
        found.append((f"{kind} {seed} {level}", task_of(sketch, faces_of(sketch), limits, level)))
    return found


def test_the_choice_is_the_cheapest_of_all() -> None:
    tasks = small_tasks()
    changed = 0
    for name, task in tasks:
        choice = choose(task)
        straight = courses(task.sketch)
        every = [
            price(task, set(some), straight)
            for size in range(len(task.sketch.lines))
            for some in itertools.combinations(sorted(task.sketch.lines), size)
        ]
        best = min(every)
        assert not choice.merged
        assert price(task, set(choice.dropped), straight) <= best * (1 + ALIKE) + 1e-6, name
        changed += bool(choice.dropped)
    assert len(tasks) >= 200
    assert changed >= 20, "in some there is something to leave out"


def test_lines_that_stay_are_never_chosen() -> None:
    for _, task in small_tasks()[::10]:
        kept = frozenset(sorted(task.sketch.lines)[::2])
        choice = choose(Task(task.sketch, task.faces, task.worth, task.limits, {}, kept, {}, task.weights))
        assert not choice.dropped & kept


def test_images_are_chosen_alike() -> None:
    for kind, seed in itertools.product(("comb", "tips", "tree"), range(2)):
        sketch = Sketch.of(drawn(kind, seed, 40.0, twin=True)).simplified()
        limits = limits_of(config("bold", 18), "bold")

        pairs, faces = mirror_of(sketch).pairs, faces_of(sketch)
        task = Task(
            sketch, faces, worths(sketch, faces, limits), limits, {}, frozenset(), pairs, LEVELS["bold"]
        )
        dropped = choose(task).dropped
        assert all((n in dropped) == (pairs[n] in dropped) for n in pairs)
