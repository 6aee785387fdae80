"""Shapes under random nested transforms are their own points moved, one by one."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from wrapit.drawing.svg.reading.lengths import Measure
from wrapit.drawing.svg.reading.matrices import IDENTITY, applied, inverse, origin, times, transform
from wrapit.drawing.svg.reading.scene import read_page

MEASURE = Measure(width=200.0, height=100.0)
NUMBER = st.integers(-50, 50).map(lambda value: value / 4)
FACTOR = st.sampled_from((-2.0, -0.5, 0.25, 1.5, 3.0))


def _rotation(angle: float, x: float = 0.0, y: float = 0.0) -> np.ndarray:
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    return np.array([[c, -s, x - c * x + s * y], [s, c, y - s * x - c * y], [0, 0, 1]])


# As written, and the matrix by the book.
STEPS = st.one_of(
    st.tuples(NUMBER, NUMBER).map(
        lambda v: (f"translate({v[0]} {v[1]})", np.array([[1, 0, v[0]], [0, 1, v[1]], [0, 0, 1]]))
    ),
    st.tuples(FACTOR, FACTOR).map(lambda v: (f"scale({v[0]},{v[1]})", np.diag([*v, 1.0]))),
    st.tuples(NUMBER, NUMBER, NUMBER).map(lambda v: (f"rotate({v[0]}, {v[1]} {v[2]})", _rotation(*v))),
    NUMBER.map(
        lambda v: (f"skewX({v})", np.array([[1, math.tan(math.radians(v)), 0], [0, 1, 0], [0, 0, 1.0]]))
    ),
    NUMBER.map(
        lambda v: (f"skewY({v})", np.array([[1, 0, 0], [math.tan(math.radians(v)), 1, 0], [0, 0, 1.0]]))
    ),
)
# As written, and points on it (n, 2): every point has to lie on one of the shape's cubics.
TURN = np.linspace(0, 2 * math.pi, 25)
COS, SIN, SHARE = np.cos(TURN), np.sin(TURN), np.linspace(0, 1, 25)
SHAPES = (
    ('<ellipse cx="5" cy="6" rx="20" ry="8"/>', np.column_stack([5 + 20 * COS, 6 + 8 * SIN])),
    ('<circle cx="1" cy="2" r="7"/>', np.column_stack([1 + 7 * COS, 2 + 7 * SIN])),
    ('<line x1="1" y1="2" x2="31" y2="12"/>', np.column_stack([1 + 30 * SHARE, 2 + 10 * SHARE])),
    ('<path d="M10 0A10 10 0 0 1 0 10"/>', 10 * np.column_stack([np.cos(TURN / 4), np.sin(TURN / 4)])),
    ('<path d="M0 0Q10 20 20 0"/>', np.column_stack([20 * SHARE, 40 * SHARE * (1 - SHARE)])),
)


@settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    shape=st.sampled_from(SHAPES),
    steps=st.lists(st.tuples(st.sampled_from(("group", "use", "own", "symbol")), STEPS), max_size=4),
)
def test_a_shape_under_transforms_is_its_points_moved(tmp_path, shape, steps):
    text, points = shape
    matrix, defs = np.eye(3), ""
    for index, (how, (written, step)) in enumerate(steps):
        matrix = step @ matrix
        if how == "own":
            text = f'<g style="transform:{_css(written)}">{text}</g>'
        elif how == "group":
            text = f'<g transform="{written}">{text}</g>'
        elif how == "use":
            defs += f'<g id="c{index}">{text}</g>'
            text = f'<use href="#c{index}" transform="{written}"/>'
        else:
            # Half as large, from -100: its viewBox fits into 60 x 60 in the middle.
            defs += f'<symbol id="c{index}" viewBox="-60 -60 120 120" overflow="visible">{text}</symbol>'
            text = f'<use href="#c{index}" x="-30" y="-30" width="60" height="60" transform="{written}"/>'
            matrix = step @ np.diag([0.5, 0.5, 1.0]) @ np.linalg.inv(step) @ matrix
    path = tmp_path / "a.svg"
    path.write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" stroke="red"><defs>{defs}</defs>{text}</svg>',
        encoding="utf-8",
    )
    (found,) = read_page(path).shapes
    expected = points @ matrix[:2, :2].T + matrix[:2, 2]
    t = np.linspace(0, 1, 400)[:, None, None]
    cubics = np.concatenate([curve.cubics for curve in found.curves])
    a, b, c, d = np.moveaxis(cubics, 1, 0)
    on = ((1 - t) ** 3 * a + 3 * (1 - t) ** 2 * t * b + 3 * (1 - t) * t * t * c + t**3 * d).reshape(-1, 2)
    size = np.abs(expected).max() + 1.0
    off = np.linalg.norm(on[:, None] - expected[None], axis=2).min(axis=0)
    # Half a step between two of the samples, along the curve.
    assert off.max() < 5e-3 * size


def _css(written: str) -> str:
    """The same as a property: angles and lengths have units."""
    name, _, inside = written.rstrip(")").partition("(")
    values = inside.replace(",", " ").split()
    if name == "rotate":
        angle, x, y = values
        return f"translate({x}px,{y}px) rotate({angle}deg) translate({-float(x)}px,{-float(y)}px)"
    unit = {"translate": "px", "scale": "", "skewX": "deg", "skewY": "deg"}[name]
    return f"{name}({', '.join(value + unit for value in values)})"


@given(st.lists(STEPS, min_size=1, max_size=5))
def test_lists_are_products_and_inverses_undo_them(steps):
    found = transform(" , ".join(text for text, _ in steps), MEASURE)
    book = np.linalg.multi_dot([np.eye(3), np.eye(3), *(matrix for _, matrix in steps)])
    assert found is not None
    assert np.allclose(np.array(found).reshape(3, 2).T, book[:2], rtol=1e-9, atol=1e-9)
    back = inverse(found)
    assert back is not None
    assert np.allclose(times(back, found), IDENTITY, atol=1e-6)


@pytest.mark.parametrize(
    ("text", "point"),
    [
        ("rotate(.25turn)", (0, 1)),
        ("rotate(100grad)", (0, 1)),
        ("translate(50%, 10%)", (101, 10)),
        ("translateX(1in) scale(200%)", (98, 0)),
        ("matrix3d(2,0,0,0,0,2,0,0,0,0,1,0,5,6,0,1)", (7, 6)),
        ("none", (1, 0)),
    ],
)
def test_units_of_css(text, point):
    found = transform(text, MEASURE)
    assert found is not None
    assert applied(found, np.array([1.0, 0.0])) == pytest.approx(point, abs=1e-9)


@pytest.mark.parametrize(
    "text", ["matrix(1 2)", "rotate(", "turn(3)", "rotate(1 2)", "scale(1) x", "skewX(1px)"]
)
def test_what_is_not_in_order_is_none(text):
    assert transform(text, MEASURE) is None


@pytest.mark.parametrize(
    ("text", "place"),
    [
        ("left", (0, 50)), ("top", (100, 0)), ("bottom right", (200, 100)), ("center left", (0, 50)),
        ("25% 10px", (50, 10)), ("10 20", (10, 20)), ("1in", (96, 50)), ("top foo", None),
    ],
)  # fmt: skip
def test_origins(text, place):
    assert origin(text, MEASURE) == place
