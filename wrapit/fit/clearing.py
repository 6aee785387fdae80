"""What is left out and merged until all lines are long enough and all faces have room, round by round."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from typing import Final

import numpy as np

from wrapit.drawing.model import Removal
from wrapit.fit.faces import Faces
from wrapit.fit.measuring import fewest_wires
from wrapit.fit.merging.merged import merged, quoted
from wrapit.fit.mirrored import mirror_of
from wrapit.fit.model import Level, Limits
from wrapit.fit.programme import Task, Weights, choose, needed_mm
from wrapit.fit.sketch import STEP_MM, Sketch
from wrapit.fit.worth import worths
from wrapit.fit.zipping.zipped import zipped
from wrapit.geometry import FloatArray, joined
from wrapit.geometry.arclength import piece
from wrapit.geometry.disjoint_sets import Sets

# What a wire less is worth, in mm of line inside the drawing that may go for it; more where there are many.
# With 8 mm beyond five a lobster lost its last stripe; with none it kept 7 of 19 wires, with these 4.
_WORK: Final[dict[Level, Weights]] = {
    "gentle": Weights(1.0, few=6, more_mm=0.0),
    "bold": Weights(6.0, few=6, more_mm=5.0),
}
# Each round's lines are judged as they are by then; the corpus takes two choices at most.
_ROUNDS: Final = 12


def cleared(sketch: Sketch, limits: Limits, level: Level, keep: frozenset[int]) -> Sketch:
    """The sketch without lines that are too short, and faces that have too little room.

    Lines that meet at a node of two are one. `keep` are segments of the original that stay. What can't be
    helped stays as it is.
    """
    sketch = sketch.simplified(limits.shortest_mm)
    sketch = zipped(sketch, limits, keep)
    sketch = _tidied(sketch.simplified(), limits, keep)
    refused: set[int] = set()
    for turn in range(_ROUNDS):
        sketch = sketch.simplified()
        faces = sketch.faces
        if not short_lines(sketch, limits) and not small_faces(sketch, faces, limits):
            break
        pairs = mirror_of(sketch).pairs
        worth = worths(sketch, faces, limits)
        task = Task(
            sketch,
            faces,
            worth,
            limits,
            _mergeable(sketch, limits, worth, keep | refused, pairs),
            _staying(sketch, faces, limits, keep, mending=turn > 0),
            pairs,
            _WORK[level],
        )
        choice = choose(task)
        if not choice.dropped and not choice.merged:
            break
        sketch = _without(sketch, choice.dropped, faces, limits)
        for groups in _groups(sketch, choice.merged, pairs):
            sketch = _as_one(sketch, groups, limits, refused)
    return sketch.simplified()


def _tidied(sketch: Sketch, limits: Limits, keep: frozenset[int]) -> Sketch:
    """Lines shorter than the wire is thick go at once: rings and stubs, and what is between two junctions."""
    stay = set(keep)
    while True:
        specks = [
            (line.curve.length, n)
            for n, line in sketch.lines.items()
            if line.curve.length < limits.diameter_mm and not line.origin & stay and len(sketch.lines) > 1
        ]
        if not specks:
            return sketch
        n = min(specks)[1]
        line = sketch.lines[n]
        if line.is_ring or any(len(sketch.arms[node]) == 1 for node in (line.start, line.end)):
            sketch = sketch.changed((n,), told=(line.told("dropped", "shorter than the wire is thick"),))
        else:
            sketch = _as_one(sketch, [[n]], limits, stay)
        sketch = sketch.simplified()


def short_lines(sketch: Sketch, limits: Limits) -> list[int]:
    """Lines that hands can't bend."""
    return [n for n, line in sorted(sketch.lines.items()) if line.curve.length < limits.shortest_mm]


def small_faces(sketch: Sketch, faces: Faces, limits: Limits) -> list[int]:
    """Faces, by their place in the list, that have too little room."""
    return [
        index
        for index, face in enumerate(faces.faces)
        if face.inside_mm < needed_mm(sketch, face.lines, limits)
    ]


def _staying(
    sketch: Sketch, faces: Faces, limits: Limits, keep: frozenset[int], *, mending: bool
) -> frozenset[int]:
    """Lines that aren't left out: wished for, or while what is left is mended, nowhere near what is wrong."""
    wished = {n for n, line in sketch.lines.items() if line.origin & keep}
    if not mending:
        return frozenset(wished)
    wrong = set(short_lines(sketch, limits)).union(
        *(faces.faces[index].lines for index in small_faces(sketch, faces, limits))
    )
    nodes = {node for n in wrong for node in (sketch.lines[n].start, sketch.lines[n].end)}
    near = {arm[0] for node in nodes for arm in sketch.arms[node]}
    return frozenset(wished | (set(sketch.lines) - near))


def _mergeable(
    sketch: Sketch,
    limits: Limits,
    worth: Mapping[int, float],
    stay: frozenset[int],
    pairs: Mapping[int, int],
) -> dict[int, float]:
    """Short lines whose nodes can become one, and what that costs the eye; `stay` are origins of others."""

    def cost(n: int) -> float | None:
        line = sketch.lines[n]
        if line.curve.length >= limits.shortest_mm or line.origin & stay:
            return None
        if any(len(sketch.arms[node]) < 3 for node in (line.start, line.end)):
            return None
        quote = quoted(sketch, n, limits.diameter_mm)
        if quote is None:
            return None
        moved = sum(mm * worth[m] / sketch.lines[m].curve.length for m, mm in quote.moved.items())
        return moved + (worth[n] if quote.lost else 0.0)

    costs = {n: cost(n) for n in sketch.lines}
    return {n: each for n, each in costs.items() if each is not None and costs[pairs.get(n, n)] is not None}


def _groups(sketch: Sketch, numbers: frozenset[int], pairs: Mapping[int, int]) -> list[list[list[int]]]:
    """Lines that hang together, with the group that is their mirror image if that is another."""
    joint = Sets()
    for n in numbers:
        joint.merge(sketch.lines[n].start, sketch.lines[n].end)
    group: dict[int, list[int]] = {}
    for n in sorted(numbers):
        group.setdefault(joint.find(sketch.lines[n].start), []).append(n)
    of = {n: root for root, some in group.items() for n in some}
    both = {frozenset({root, of.get(pairs.get(some[0], some[0]), root)}) for root, some in group.items()}
    alike = [[group[root] for root in sorted(roots)] for roots in both]
    # The shortest first, however they are numbered.
    return sorted(
        alike, key=lambda some: (round(sum(sketch.lines[n].curve.length for n in some[0]), 3), some)
    )


def _without(sketch: Sketch, dropped: frozenset[int], faces: Faces, limits: Limits) -> Sketch:
    reasons = {n: _why(sketch, n, faces, limits) for n in sorted(dropped)}
    for n, (what, reason) in reasons.items():
        line, wires = sketch.lines[n], fewest_wires(sketch)
        left = sketch.changed((n,))
        saved = _saving(wires - fewest_wires(left)) if left.lines else ""
        sketch = left.changed(told=(line.told(what, reason + saved),))
    return sketch


def _why(sketch: Sketch, n: int, faces: Faces, limits: Limits) -> tuple[str, str]:
    """What is told of a line that goes: what kind of change that is, and the reason."""
    for index in small_faces(sketch, faces, limits):
        face = faces.faces[index]
        if n in face.lines:
            needed = needed_mm(sketch, face.lines, limits)
            room = f"{face.inside_mm:.1f} mm of room, where wire needs {needed:.1f} mm"
            if len(face.lines) == 1:
                return "closed", f"a ring with {room}"
            return ("merged" if len(face.lines) == 2 else "dropped"), f"it closed a face with {room}"
    if sketch.lines[n].curve.length < limits.shortest_mm:
        return "dropped", f"shorter than can be bent ({limits.shortest_mm:g} mm)"
    return "dropped", "less is lost by it than its work is worth"


def _saving(wires: int) -> str:
    return f"; saves {wires} wire{'s' if wires > 1 else ''}" if wires > 0 else ""


def _as_one(sketch: Sketch, groups: list[list[int]], limits: Limits, refused: set[int]) -> Sketch:
    """The sketch with all nodes of each group of lines one: of all groups, or of none."""
    result = sketch
    for numbers in groups:
        place, left = _middle(result, numbers) if len(numbers) > 1 else None, list(numbers)
        while left:
            n = min(left, key=lambda n: (round(_distance(result, n, place), 6), n))
            left.remove(n)
            wires = fewest_wires(result)
            merger = merged(result, n, limits.diameter_mm, place)
            if merger is None:
                refused |= {number for each in numbers for number in sketch.lines[each].origin}
                return sketch
            reason = f"two junctions nearer than can be bent ({limits.shortest_mm:g} mm) are one"
            x, y = merger.at
            told = Removal(
                "merged",
                (float(x), float(y)),
                result.lines[n].curve.length,
                reason + _saving(wires - fewest_wires(merger.sketch)),
            )
            result, place = merger.sketch.changed(told=(told,)), merger.at
    return result


def _middle(sketch: Sketch, numbers: list[int]) -> FloatArray:
    """Half way along lines that follow one another; of any others the node that all are nearest to."""
    lines = [sketch.lines[n] for n in numbers]
    ends = Counter(node for line in lines for node in (line.start, line.end))
    tips = [node for node, count in ends.items() if count == 1]
    if len(tips) != 2 or max(ends.values()) > 2:
        places = np.array([sketch.nodes[node] for node in sorted(ends)])
        return np.asarray(
            places[np.argmin(np.linalg.norm(places[:, None] - places[None], axis=2).sum(axis=1))]
        )
    node, course = min(tips), []
    while lines:
        line = next(line for line in lines if node in (line.start, line.end))
        lines.remove(line)
        course.append(line.curve if line.start == node else line.curve.reversed())
        node = line.end if line.start == node else line.start
    whole = joined(course)
    return piece(whole, 0.0, whole.length / 2).end


def _distance(sketch: Sketch, n: int, place: FloatArray | None) -> float:
    """How far a line is from a place."""
    if place is None:
        return 0.0
    return float(np.hypot(*(sketch.lines[n].curve.sampled(STEP_MM) - place).T).min())
