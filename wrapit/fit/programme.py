"""Which lines to leave out and which nodes to merge: an integer programme over a sketch.

Unknowns: for each line whether it is left out, for each short one whether its nodes become one, for each
pair of lines at a node whether they become one line because all others there go, for each node whether it is
odd. Costs: what leaves the eye, what moves, and half a wire for each odd node.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Final

from wrapit.fit.districts import cuts_of, parted, regions
from wrapit.fit.faces import Faces
from wrapit.fit.merging.straightness import straight_on
from wrapit.fit.model import Limits
from wrapit.fit.sketch import Sketch
from wrapit.highs import Name, Programme

# What it costs to leave a line too short, or a face too small, in mm of line: rather than half the picture.
_TOO_SHORT: Final = 30.0
_TOO_SMALL: Final = 60.0
# A line that breaks off amid its course costs so many mm, as much as it would take to draw the eye on; and
# more where lines are worth more.
_BROKEN_MM: Final = 8.0
# Odd nodes are told from even ones by odd-set inequalities, 2^(k-1) of them; above so many arms by counting.
_MOST_ARMS: Final = 6
# A line that comes to end in the air, where it met others before, swings: it costs so many mm.
_LOOSE_MM: Final = 5.0
# The choice is within this share of the cheapest: less than any eye tells.
_GAP: Final = 1e-4
# Up to so many lines are chosen from at once, in half a second at most; above region by region, each of so
# many. Nets of 150 to 300 lines take a third to a twelfth of the time so, at 0 to 4 % more in all.
_EXACT: Final = 60
_REGION: Final = 36
# Rounds of inequalities that keep the sketch in one piece; each cuts off at least one way to part it.
_ROUNDS: Final = 40


@dataclass(frozen=True)
class Weights:
    """What a wire less is worth, in mm of line inside the drawing; `nodes` allowed to branch and bound.

    Of more wires than `few` each costs `more_mm` on top.
    """

    wire_mm: float
    few: int
    more_mm: float
    nodes: int = 2000


@dataclass(frozen=True)
class Choice:
    """Lines left out, short lines whose nodes become one, and how many limits that leaves unmet."""

    dropped: frozenset[int]
    merged: frozenset[int]
    unmet: int


@dataclass(frozen=True, eq=False)
class Task:
    """A sketch with all that the choice depends on.

    `mergeable` are short lines whose nodes may become one, and what that costs the eye; `kept` are lines that
    stay; `pairs` mirror images.
    """

    sketch: Sketch
    faces: Faces
    worth: Mapping[int, float]
    limits: Limits
    mergeable: Mapping[int, float]
    kept: frozenset[int]
    pairs: Mapping[int, int]
    weights: Weights


def choose(task: Task) -> Choice:
    """The cheapest choice; the best found within the nodes allowed where a drawing is large."""
    programme = Programme()
    _add_lines(programme, task)
    _add_lengths(programme, task)
    _add_faces(programme, task)
    _add_parity(programme, task)
    _add_breaks(programme, task)
    _add_loose_ends(programme, task)
    _add_likeness(programme, task)
    _add_leads(programme, task)
    values = _cheapest(programme, task)
    if values is None:
        return Choice(frozenset(), frozenset(), len(task.sketch.lines))
    dropped = _dropped(task, values)
    merged = {n for n in task.mergeable if values["one", n] > 0.5 and n not in dropped}
    unmet = sum(value > 0.5 for name, value in values.items() if name[0] == "unmet")
    return Choice(frozenset(dropped), frozenset(merged), unmet)


def _cheapest(programme: Programme, task: Task) -> Mapping[Name, float] | None:
    """Values of the cheapest choice; of a large sketch region by region, the rest held as it is by then."""
    lines, pairs = task.sketch.lines, task.pairs
    free = lines.keys() - task.kept
    if len({frozenset((n, pairs.get(n, n))) for n in free}) <= _EXACT:
        return _in_one_piece(programme, task, {})
    # Nothing done at all is a choice, and no region makes it dearer.
    held: dict[Name, float] = {(what, n): 0.0 for n in lines for what in ("out", "one")}
    values: Mapping[Name, float] | None = None
    for region in regions(task.sketch, free, pairs, _REGION):
        around = {name: value for name, value in held.items() if name[1] not in region}
        found = _in_one_piece(programme, task, around)
        if found is not None:
            values = found
            held |= {name: float(found[name] > 0.5) for name in held if name in found}
    return values


def _in_one_piece(
    programme: Programme, task: Task, held: Mapping[Name, float]
) -> Mapping[Name, float] | None:
    """Values of the cheapest choice that leaves the sketch in one piece; None if none is found in time."""
    for _ in range(_ROUNDS):
        values = programme.solve(task.weights.nodes, _GAP, held).values
        if values is None:
            return None
        cuts = set(cuts_of(task.sketch, _dropped(task, values)))
        if not cuts:
            return values
        for part in sorted(cuts, key=sorted):
            _add_hold(programme, task, part)
    return None


def _dropped(task: Task, values: Mapping[Name, float]) -> set[int]:
    return {n for n in task.sketch.lines if values["out", n] > 0.5}


def _add_lines(programme: Programme, task: Task) -> None:
    for n in sorted(task.sketch.lines):
        programme.add_column(("out", n), task.worth[n])
        if n in task.kept:
            programme.add_row({("out", n): 1.0}, high=0.0)
        if n in task.mergeable:
            programme.add_column(("one", n), task.mergeable[n])
            programme.add_row({("out", n): 1.0, ("one", n): 1.0}, high=1.0)
    programme.add_row({("out", n): 1.0 for n in task.sketch.lines}, high=len(task.sketch.lines) - 1.0)


def _add_lengths(programme: Programme, task: Task) -> None:
    """Each short line goes, becomes a node, or grows: by half a merged neighbour, by one that it joins."""
    sketch, least_mm = task.sketch, task.limits.shortest_mm
    for n, line in sorted(sketch.lines.items()):
        length_mm = line.curve.length
        if length_mm >= least_mm:
            continue
        short = least_mm - length_mm
        row: dict[Name, float] = {("out", n): short, ("one", n): short, ("unmet", n): short}
        programme.add_column(("unmet", n), _TOO_SHORT)
        for node in {line.start, line.end}:
            for other, gain_mm in _growth(programme, task, n, node):
                row[other] = min(short, row.get(other, 0.0) + gain_mm)
        programme.add_row(row, low=short)


def _growth(programme: Programme, task: Task, n: int, node: int) -> Iterator[tuple[Name, float]]:
    sketch = task.sketch
    arms = {arm[0] for arm in sketch.arms[node]} - {n}
    for other in sorted(arms):
        if other in task.mergeable:
            yield ("one", other), sketch.lines[other].curve.length / 2
        name: Name = ("join", node, min(n, other), max(n, other))
        programme.add_column(name, 0.0, whole=False)
        for rest in sorted(arms - {other}):
            programme.add_row({name: 1.0, ("out", rest): -1.0}, high=0.0)
        for own in (n, other):
            programme.add_row({name: 1.0, ("out", own): 1.0}, high=1.0)
        if sketch.lines[other].is_ring:
            programme.add_row({name: 1.0}, high=0.0)
        yield name, sketch.lines[other].curve.length


def _add_faces(programme: Programme, task: Task) -> None:
    """Of the lines about a face without room one goes at least."""
    for index, face in enumerate(task.faces.faces):
        if face.inside_mm >= needed_mm(task.sketch, face.lines, task.limits):
            continue
        programme.add_column(("unmet", "face", index), _TOO_SMALL)
        row: dict[Name, float] = {("out", n): 1.0 for n in face.lines}
        programme.add_row({**row, ("unmet", "face", index): 1.0}, low=1.0)


def needed_mm(sketch: Sketch, lines: frozenset[int], limits: Limits) -> float:
    """How wide a face has to be inside: a ring of one line takes a post of the jig."""
    alone = len(lines) == 1 and all(sketch.lines[n].is_ring for n in lines)
    return limits.ring_mm if alone else limits.room_mm


def _add_parity(programme: Programme, task: Task) -> None:
    """Half a wire for each odd node; between merged nodes two odd ones cancel out."""
    weights, nodes = task.weights, len(task.sketch.arms)
    cost = weights.wire_mm / 2
    if weights.more_mm:
        programme.add_column(("many",), weights.more_mm * nodes / 2, whole=False)
        many: dict[Name, float] = {("odd", node): -0.5 for node in task.sketch.arms}
        programme.add_row({**many, ("many",): nodes / 2}, low=-float(weights.few))
    for n in sorted(task.mergeable):
        programme.add_column(("even", n), 0.0)
        programme.add_row({("even", n): 1.0, ("one", n): -1.0}, high=0.0)
    for node, arms in sorted(task.sketch.arms.items()):
        single = [n for n, _ in arms if not task.sketch.lines[n].is_ring]
        odd: Name = ("odd", node)
        programme.add_column(odd, cost, whole=False)
        # An arm counts where it is there and not even: 1 - out - even, 0 or 1 as no merged line goes.
        if len(single) <= _MOST_ARMS:
            _add_odd_sets(programme, odd, single)
            continue
        # Arms that count = 2 · (halves) + odd.
        halves: list[Name] = [("half", node, k) for k in range(len(single) // 2)]
        for half in halves:
            programme.add_column(half, 0.0)
        row: dict[Name, float] = {(what, n): 1.0 for n in single for what in ("out", "even")}
        row |= dict.fromkeys(halves, 2.0)
        programme.add_row({**row, odd: 1.0}, low=len(single), high=len(single))


def _add_odd_sets(programme: Programme, odd: Name, arms: list[int]) -> None:
    """odd = 1 wherever an odd number of arms counts: each such 0-1 point is cut off unless odd is 1."""
    for size in range(1, len(arms) + 1, 2):
        for there in itertools.combinations(arms, size):
            # Σ those that don't count of `there` + Σ those that do of the others + odd ≥ 1.
            signs = [(n, 1.0 if n in there else -1.0) for n in arms]
            row: dict[Name, float] = {(what, n): sign for n, sign in signs for what in ("out", "even")}
            programme.add_row({**row, odd: 1.0}, low=1.0 - (len(arms) - size))


def _add_breaks(programme: Programme, task: Task) -> None:
    """Of two lines that go straight on into one another both stay or both go, or the course is broken.

    One that ends loose may go: the course is shorter then.
    """
    loose = {arms[0][0] for arms in task.sketch.arms.values() if len(arms) == 1}
    for n, line in sorted(task.sketch.lines.items()):
        for arm in ((n, False), (n, True)):
            other = straight_on(task.sketch, arm)
            if other is None or other[0] <= n or {n, other[0]} & loose:
                continue
            node = line.end if arm[1] else line.start
            broken: Name = ("broken", node, n, other[0])
            seen = min(task.worth[m] / task.sketch.lines[m].curve.length for m in (n, other[0]))
            programme.add_column(broken, _BROKEN_MM * max(1.0, seen), whole=False)
            for sign in (1.0, -1.0):
                programme.add_row({broken: 1.0, ("out", n): -sign, ("out", other[0]): sign}, low=0.0)


def _add_loose_ends(programme: Programme, task: Task) -> None:
    """A node is loose where one of its lines is there and no other."""
    for node, arms in sorted(task.sketch.arms.items()):
        numbers = sorted({n for n, _ in arms})
        if len(arms) < 2 or len(numbers) < len(arms):
            continue
        loose: Name = ("loose", node)
        programme.add_column(loose, _LOOSE_MM, whole=False)
        for n in numbers:
            row: dict[Name, float] = {("out", other): -1.0 for other in numbers if other != n}
            programme.add_row({**row, ("out", n): 1.0, loose: 1.0}, low=2.0 - len(numbers))


def _add_likeness(programme: Programme, task: Task) -> None:
    for n, image in sorted(task.pairs.items()):
        if n < image:
            programme.add_row({("out", n): 1.0, ("out", image): -1.0}, low=0.0, high=0.0)
            programme.add_row({("one", n): 1.0, ("one", image): -1.0}, low=0.0, high=0.0)


def _add_leads(programme: Programme, task: Task) -> None:
    """Where a single line leads to a part, the part goes with it: the lesser of its two sides."""
    around = frozenset().union(*(face.lines for face in task.faces.faces))
    for n in sorted(set(task.sketch.lines) - around):  # a line about a face leads to nothing
        for part in parted(task.sketch, {n}):
            for other, line in sorted(task.sketch.lines.items()):
                if line.start in part and line.end in part:
                    programme.add_row({("out", n): 1.0, ("out", other): -1.0}, high=0.0)


def _add_hold(programme: Programme, task: Task, part: frozenset[int]) -> None:
    """A part stays joined to the rest by a line, or all of it goes."""
    lines = task.sketch.lines
    leading = [n for n, line in lines.items() if (line.start in part) != (line.end in part)]
    for n, line in sorted(lines.items()):
        if line.start in part and line.end in part:
            row: dict[Name, float] = {("out", each): -1.0 for each in leading}
            programme.add_row({**row, ("out", n): 1.0}, low=1.0 - len(leading))
