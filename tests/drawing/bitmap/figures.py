"""Strokes to render, and what to ask of the drawing traced from them; places in pixels."""

from __future__ import annotations

import math

import numpy as np
from hypothesis import HealthCheck, settings
from hypothesis import strategies as st

from tests.drawing.generated import Points
from wrapit.drawing.model import Drawing

SIZE_PX = 420

CENTRE = SIZE_PX / 2

WIDTHS = st.floats(4.0, 15.0)

TURNS = st.floats(0, 2 * math.pi)

SHIFTS = st.tuples(st.floats(-6, 6), st.floats(-6, 6))

few = settings(
    max_examples=12,
    deadline=None,
    derandomize=True,
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)


def line(*points: tuple[float, float]) -> Points:
    return np.array(points, dtype=np.float64)


def turned(points: Points, angle: float, shift: tuple[float, float] = (0, 0)) -> Points:
    c, s = math.cos(angle), math.sin(angle)
    return (points - CENTRE) @ np.array([[c, s], [-s, c]]) + CENTRE + shift


def in_pixels(drawing: Drawing, point: Points) -> Points:
    frame = drawing.pixel_frame
    assert frame is not None
    return (point - np.array(frame.origin_mm)) / frame.mm_per_px * [1, -1]


def junction_near(drawing: Drawing, degree: int) -> Points:
    """The place, in pixels, of the only junction with this degree."""
    found = [j for j, ends in enumerate(drawing.half_edges()) if len(ends) == degree]
    assert len(found) == 1
    return in_pixels(drawing, drawing.junctions[found[0]].point)


ACROSS = line((50, CENTRE), (SIZE_PX - 50, CENTRE))


def arc(radius: float, half_angle: float, offset: float) -> Points:
    """An arc that bulges upwards around the middle of its chord, `offset` below the centre at its top."""
    a = np.linspace(-half_angle, half_angle, 120)
    return CENTRE + np.column_stack([radius * np.sin(a), offset + radius * (1 - np.cos(a))])


def scallops(radius: float, turn_degrees: float, count: int, width: float) -> tuple[Points, Points]:
    """Arcs side by side, as around a cloud, and the cusps between them."""
    half = math.radians(turn_degrees) / 2
    angles, chord = np.linspace(-half, half, 60), 2 * radius * math.sin(half)
    arcs = [
        np.column_stack([k * chord + radius * np.sin(angles), -radius * np.cos(angles)])[k > 0 :]
        for k in range(count)
    ]
    points = np.vstack(arcs) * width
    shift = CENTRE - (points.min(axis=0) + points.max(axis=0)) / 2
    cusps = [((k + 0.5) * chord, -radius * math.cos(half)) for k in range(count - 1)]
    return points + shift, np.array(cusps) * width + shift
