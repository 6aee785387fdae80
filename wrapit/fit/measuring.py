"""How fit a sketch is for wire, and what it cost to make it so."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Final

import numpy as np

from wrapit.fit.model import Costs, Limits, Measures
from wrapit.fit.sketch import Sketch
from wrapit.geometry import BezierChain
from wrapit.geometry.disjoint_sets import Sets
from wrapit.geometry.steering.tight import tight_places_of

# What turns by less (rad) is no bend: joints of drawings are that exact, and no hand.
NOISE_RAD: Final = 2e-3
# How finely distances of lines are measured.
_STEP_MM: Final = 0.1


def measures(sketch: Sketch, limits: Limits) -> Measures:
    """How fit a sketch is; the smallest face is None where there is none."""
    return Measures(
        segments=len(sketch.lines),
        wires=fewest_wires(sketch),
        tight_bends=sum(tight_bends([line.curve for line in sketch.lines.values()], limits.radius_mm)),
        smallest_face_mm=min((face.inside_mm for face in sketch.faces.faces), default=None),
        length_mm=sum(line.curve.length for line in sketch.lines.values()),
    )


def fewest_wires(sketch: Sketch) -> int:
    """The fewest wires that can run along all lines once: half the odd nodes, one at least for each piece."""
    pieces = Sets()
    for line in sketch.lines.values():
        pieces.merge(line.start, line.end)
    odd: dict[int, int] = {pieces.find(node): 0 for node in sketch.nodes}
    for node, arms in sketch.arms.items():
        odd[pieces.find(node)] += len(arms) % 2
    return sum(max(1, count // 2) for count in odd.values())


def tight_bends(curves: Sequence[BezierChain], radius_mm: float) -> list[int]:
    """How many stretches of each curve bend more tightly than a radius; a corner is one."""
    return [
        sum(bool(place.turn > NOISE_RAD) for place in places)
        for places in tight_places_of(curves, radius_mm, closed=False)
    ]


def costs(before: Sketch, after: Sketch, outline: Iterable[int], limits: Limits) -> Costs:
    """What was given up: of the outline, of the length, and in place where a line was kept."""
    from scipy.spatial import cKDTree

    tree = cKDTree(np.concatenate([line.curve.sampled(_STEP_MM) for line in after.lines.values()]))
    kept = frozenset().union(*(line.origin for line in after.lines.values()))
    near_mm, deviation_mm = limits.diameter_mm / 2 + _STEP_MM / 2, 0.0
    seen = outer = left_out = whole = 0.0
    for number, line in before.lines.items():
        far = tree.query(line.curve.sampled(_STEP_MM))[0]
        length = line.curve.length
        whole += length
        if number in outline:
            outer += length
            seen += length * float((far <= near_mm).mean())
        if number in kept:
            deviation_mm = max(deviation_mm, float(far.max()))
        else:
            left_out += length
    return Costs(seen / outer if outer else 1.0, left_out / whole, deviation_mm)
