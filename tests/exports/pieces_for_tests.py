"""Small drawings and wires made by hand, so that these tests need no other stage."""

from __future__ import annotations

import itertools
import math

import numpy as np

from wrapit.config import JigConfig
from wrapit.decomposition.model import (
    NO_MATE,
    Decomposition,
    Energy,
    Solution,
    Trail,
    Traversal,
    Weights,
)
from wrapit.drawing.model import Drawing, Junction, Removal, Segment
from wrapit.geometry import BezierChain, from_chain, joined, straight
from wrapit.wires.model import Binding, Wire
from wrapit.wires.turns import find_turns

COLOURS = ("#b87333", "#2a78b8", "#3f8f4f", "#8a4fb0")


def arc_chain(centre: tuple[float, float], radius: float, start_rad: float, sweep_rad: float) -> BezierChain:
    """A circular arc as cubic Béziers of at most 45°."""
    count = max(1, math.ceil(abs(sweep_rad) / (math.pi / 4)))
    step = sweep_rad / count
    handle = 4 / 3 * math.tan(step / 4) * radius
    angles = start_rad + step * np.arange(count + 1)
    on = np.array(centre) + radius * np.column_stack([np.cos(angles), np.sin(angles)])
    tangent = np.column_stack([-np.sin(angles), np.cos(angles)]) * handle
    return BezierChain(np.stack([on[:-1], on[:-1] + tangent[:-1], on[1:] - tangent[1:], on[1:]], axis=1))


def drawing_of(curves: list[BezierChain], removed: tuple[Removal, ...] = (), **more: object) -> Drawing:
    """Curves whose ends coincide exactly share a junction."""
    points: dict[tuple[float, float], int] = {}
    ends = [
        tuple(
            points.setdefault((float(point[0]), float(point[1])), len(points))
            for point in (curve.start, curve.end)
        )
        for curve in curves
    ]
    return Drawing(
        tuple(Junction(index, np.array(point)) for point, index in points.items()),
        tuple(
            Segment(index, start, end, curve)
            for index, (curve, (start, end)) in enumerate(zip(curves, ends, strict=True))
        ),
        removed=removed,
        **more,  # type: ignore[arg-type]
    )


def solution_of(drawing: Drawing, trails: list[list[tuple[int, bool]]]) -> tuple[Solution, tuple[Wire, ...]]:
    """A solution with these trails and its wires; segments in two trails count as doubled."""
    walks = tuple(
        Trail(
            tuple(Traversal(*step) for step in trail),
            closed=_end(drawing, trail[0], first=True) == _end(drawing, trail[-1], first=False),
        )
        for trail in trails
    )
    runs = [step[0] for trail in trails for step in trail]
    solution = Solution(
        Decomposition(drawing, (NO_MATE,) * (2 * len(drawing.segments))),
        walks,
        Energy(len(trails), 0.0, 0, 0, float(len(trails))),
        Weights(),
        "annealing",
        1,
        0,
        doubled=tuple(sorted({segment for segment in runs if runs.count(segment) > 1})),
    )
    return solution, tuple(_wire(drawing, index, trail, walks) for index, trail in enumerate(walks))


def _end(drawing: Drawing, step: tuple[int, bool], *, first: bool) -> int:
    segment = drawing.segments[step[0]]
    return segment.start if first != bool(step[1]) else segment.end


def _visits(drawing: Drawing, trail: Trail) -> list[int]:
    steps = trail.traversals
    return [_end(drawing, steps[0], first=True)] + [_end(drawing, step, first=False) for step in steps]


def _wire(drawing: Drawing, index: int, trail: Trail, walks: tuple[Trail, ...]) -> Wire:
    curves = [
        curve.reversed() if step.reversed else curve
        for step in trail.traversals
        for curve in (drawing.segments[step.segment].curve,)
    ]
    chain = joined(curves)
    reach = np.concatenate([[0.0], np.cumsum([curve.length for curve in curves])])
    bindings = []
    for at, junction in zip(reach, _visits(drawing, trail), strict=True):
        others = tuple(
            f"wire-{other + 1:02d}"
            for other, walk in enumerate(walks)
            if other != index and junction in _visits(drawing, walk)
        )
        if others:
            x, y = drawing.junctions[junction].point
            bindings.append(Binding(junction, float(at), others, (float(x), float(y))))
    length = float(reach[-1])
    name, spline = f"wire-{index + 1:02d}", from_chain(chain)
    return Wire(
        number=index + 1,
        centreline=spline,
        diameter_mm=1.02,
        length_mm=length,
        cut_length_mm=length + max(50.0, 0.15 * length),
        traversals=trail.traversals,
        segment_spans_mm=tuple((float(a), float(b)) for a, b in itertools.pairwise(reach)),
        turns=find_turns(name, spline, JigConfig())[0],
        bindings=tuple(bindings),
        min_bend_radius_mm=3.0,
        max_deviation_from_drawing_mm=0.0,
        layers=1,
        mass_g=1.0,
        closed=trail.closed,
        colour=COLOURS[index % len(COLOURS)],
    )


def eye() -> tuple[Solution, tuple[Wire, ...]]:
    """Two arcs that meet at two corners, a stem run along twice, and a bar across: two wires."""
    left, right = np.array([-20.0, 0.0]), np.array([20.0, 0.0])
    angle = math.atan2(10, 20)
    points = arc_chain((0, -10), math.hypot(20, 10), angle, math.pi - 2 * angle).points.copy()
    points[0, 0], points[-1, 3] = right, left
    upper, lower = BezierChain(points), BezierChain(points[::-1, ::-1] * np.array([1, -1]))
    stem = straight(right, right + np.array([12.0, 0.0]))
    middle = upper.points[len(upper) // 2, 0]
    first = BezierChain(upper.points[: len(upper) // 2])
    second = BezierChain(upper.points[len(upper) // 2 :])
    below = BezierChain(lower.points[: len(lower) // 2])
    beyond = BezierChain(lower.points[len(lower) // 2 :])
    bar = straight(middle, below.end)
    drawing = drawing_of(
        [first, second, below, beyond, stem, bar],
        removed=(Removal("spur", (5.0, 3.0), 0.41, "shorter than the stroke is wide"),),
        stroke_width_mm=0.6,
    )
    steps = [(4, True), (0, False), (1, False), (2, False), (3, False), (4, False)]
    return solution_of(drawing, [steps, [(5, False)]])


def hairpin() -> tuple[Wire, ...]:
    """A wire that turns back on a radius of 1.6 mm, between legs of 25 mm."""
    turn = arc_chain((25, 1.6), 1.6, -math.pi / 2, math.pi).points.copy()
    turn[0, 0], turn[-1, 3] = (25.0, 0.0), (25.0, 3.2)
    chain = joined([straight((0, 0), (25, 0)), BezierChain(turn), straight((25, 3.2), (0, 3.2))])
    return solution_of(drawing_of([chain]), [[(0, False)]])[1]


def spiral(pitch_mm: float = 6.0, turns: float = 3.0) -> tuple[Wire, ...]:
    """An Archimedean spiral from a radius of 4 mm outward, closed by an arc and a line back to its start."""
    angles = np.linspace(0, math.tau * turns, round(12 * turns) + 1)
    radii = 4 + pitch_mm * angles / math.tau
    on = radii[:, None] * np.column_stack([np.cos(angles), np.sin(angles)])
    slope = pitch_mm / math.tau
    along = (
        np.column_stack(
            [
                slope * np.cos(angles) - radii * np.sin(angles),
                slope * np.sin(angles) + radii * np.cos(angles),
            ]
        )
        * (angles[1] - angles[0])
        / 3
    )
    cubics = np.stack([on[:-1], on[:-1] + along[:-1], on[1:] - along[1:], on[1:]], axis=1)
    return solution_of(drawing_of([BezierChain(cubics)]), [[(0, False)]])[1]


def woven(count: int) -> tuple[Wire, ...]:
    """Wavy wires, `count` across as many."""
    curves = []
    for index in range(count):
        for upright in (False, True):
            y, waves = 9.0 * index, range(max(2, 3 * count // 4))
            arcs = [arc_chain((6.0 + 12 * k, y), 6.0, math.pi, -math.pi if k % 2 else math.pi) for k in waves]
            points = np.concatenate([arc.points for arc in arcs]).copy()
            points[1:, 0] = points[:-1, 3]
            curves.append(BezierChain(points[..., ::-1] if upright else points))
    return solution_of(drawing_of(curves), [[(index, False)] for index in range(2 * count)])[1]
