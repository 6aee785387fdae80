"""Random drawings of the kinds that people bring: flowers, spirals, letters, trees, rings, scribbles …

Each family is a function of a random generator: lines (n, 2) in a square of 100, y down. Lines of the
families in `CORNERED` are straight between their points, others are smooth curves through them.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable
from typing import Final

import numpy as np
from PIL import Image

from tests.drawing.generated import Points, random_curve, render

Lines = list[Points]
Rng = np.random.Generator

# A drawing fills this square with this margin; a PNG has so many pixels a unit and strokes so wide.
SIDE, MARGIN = 100.0, 8.0
PX_PER_UNIT, STROKE_PX = 8, 9.0
_TURN = 2 * math.pi


def _polar(radius: Points | float, angle: Points, centre: tuple[float, float] = (0.0, 0.0)) -> Points:
    return np.column_stack([np.cos(angle), np.sin(angle)]) * np.reshape(radius, (-1, 1)) + centre


def _circle(x: float, y: float, radius: float) -> Points:
    return _polar(radius, np.linspace(0, _TURN, 49), (x, y))


def _blobs(rng: Rng) -> Lines:
    return [random_curve(rng, SIDE, int(rng.integers(2, 6)))[::8] for _ in range(int(rng.integers(1, 4)))]


def _concentric(rng: Rng) -> Lines:
    radii = np.arange(1, int(rng.integers(3, 6))) * 10.0
    spokes = [_polar(radii[[0, -1]], np.full(2, a)) for a in rng.uniform(0, _TURN, int(rng.integers(1, 4)))]
    return [*(_circle(0, 0, radius) for radius in radii), *spokes]


def _spiral(rng: Rng) -> Lines:
    angle = np.linspace(1.0, _TURN * rng.uniform(2, 4), 120)
    return [_polar(angle ** rng.uniform(0.7, 1.3), angle)]


def _double_spiral(rng: Rng) -> Lines:
    angle = np.linspace(0, _TURN * rng.uniform(1.5, 2.5), 80)
    arm = _polar(2 + angle, angle)
    return [np.concatenate([-arm[::-1], arm])]


def _flower(rng: Rng) -> Lines:
    petals, angle = int(rng.integers(4, 9)), np.linspace(0, _TURN, 241)
    return [
        _polar(30 + rng.uniform(5, 20) * np.cos(petals * angle), angle),
        _circle(0, 0, rng.uniform(6, 20)),
    ]


def _rose(rng: Rng) -> Lines:
    angle = np.linspace(0, _TURN, 301)
    return [_polar(40 * np.cos(int(rng.integers(2, 5)) * angle), angle)]


def _grid(rng: Rng) -> Lines:
    count, tilt = int(rng.integers(2, 5)), rng.uniform(-0.2, 0.2)
    at = np.arange(count) * 12.0
    end = np.array([-6.0, at[-1] + 6])
    across = [np.column_stack([end, y + tilt * end]) for y in at]
    return [*across, *(np.column_stack([x - tilt * end, end]) for x in at)]


def _hairpin(rng: Rng) -> Lines:
    pitch, height, count = rng.uniform(2, 8), rng.uniform(20, 50), int(rng.integers(3, 8))
    bends = [
        np.column_stack(
            [
                pitch * (k + 0.5 - 0.5 * np.cos(np.linspace(0, math.pi, 9))),
                (height if k % 2 else 0)
                + (1 if k % 2 else -1) * pitch / 2 * np.sin(np.linspace(0, math.pi, 9)),
            ]
        )
        for k in range(count)
    ]
    return [np.concatenate(bends)]


def _heart(rng: Rng) -> Lines:
    t = np.linspace(0, _TURN, 121)
    y = 13 * np.cos(t) - 5 * np.cos(2 * t) - 2 * np.cos(3 * t) - np.cos(4 * t)
    heart = np.column_stack([16 * np.sin(t) ** 3, -y])
    return [heart, heart * rng.uniform(0.4, 0.7), np.array([[0.0, -5.0], [0.0, 17.0]])]


def _leaf(rng: Rng) -> Lines:
    t, width = np.linspace(0, 1, 25), rng.uniform(8, 22)
    side = np.column_stack([60 * t, width * np.sin(math.pi * t)])
    veins = [
        np.array([[x, 0], [x + 8, 0.6 * sign * width * math.sin(math.pi * (x + 8) / 60)]])
        for x in np.arange(12, 50, rng.uniform(8, 14))
        for sign in (1, -1)
    ]
    return [side, side * [1, -1], np.array([[0.0, 0], [30, 0], [75, 0]]), *veins]


# Letters as strokes on a grid of 2 by 3: capitals that turn, fork and cross.
_LETTERS: Final = {
    "A": ["00 13 20", "01 21"], "E": ["20 00 03 23", "02 12"], "H": ["00 03", "20 23", "02 22"],
    "K": ["00 03", "23 01 20"], "M": ["00 03 11 23 20"], "N": ["00 03 20 23"], "W": ["03 00 12 20 23"],
    "X": ["00 23", "03 20"], "Z": ["03 23 00 20"],
}  # fmt: skip


def _letters(rng: Rng) -> Lines:
    lines = [np.array([[-4.0, 0.0], [60.0, 0.0]])]
    for index, letter in enumerate(rng.choice([*_LETTERS], int(rng.integers(2, 5)))):
        for stroke in _LETTERS[letter]:
            corners = np.array([[int(x), -int(y)] for x, y in stroke.split()], dtype=np.float64)
            lines.append(corners * [7, 8] + [index * 17, 0])
    return lines


def _lissajous(rng: Rng) -> Lines:
    a, b, t = int(rng.integers(1, 4)), int(rng.integers(2, 5)), np.linspace(0, _TURN, 241)
    return [np.column_stack([40 * np.sin(a * t + rng.uniform(0.2, 1.4)), 40 * np.sin(b * t)])]


def _loops(rng: Rng) -> Lines:
    count, t = int(rng.integers(3, 7)), np.linspace(0, _TURN, 301)
    return [_polar(25, t) + _polar(rng.uniform(8, 18), (count + 1) * t)]


def _parallel(rng: Rng) -> Lines:
    x, apart = np.linspace(0, 80, 17), rng.uniform(2.5, 8)
    wave = np.column_stack([x, rng.uniform(3, 12) * np.sin(x / rng.uniform(8, 16))])
    waves = [wave + np.array([0, k * apart]) for k in range(int(rng.integers(2, 5)))]
    return [*waves, np.array([[40.0, -20.0], [40.0, 50.0]])]


def _rings(rng: Rng) -> Lines:
    return [_circle(k * rng.uniform(14, 18), 0, 10) for k in range(int(rng.integers(2, 5)))]


def _scribble(rng: Rng) -> Lines:
    return [np.cumsum(rng.normal(0, 12, (int(rng.integers(8, 16)), 2)), axis=0)]


def _star(rng: Rng) -> Lines:
    points = int(rng.integers(5, 9))
    radius = np.where(np.arange(2 * points + 1) % 2, rng.uniform(15, 30), 45)
    return [_polar(radius, np.arange(2 * points + 1) * math.pi / points)]


def _tangent(rng: Rng) -> Lines:
    radii = rng.uniform(5, 20, int(rng.integers(2, 5)))
    at = np.concatenate([[0.0], np.cumsum(radii[:-1] + radii[1:])])
    return [_circle(x, 0, radius) for x, radius in zip(at, radii, strict=True)]


def _tees(rng: Rng) -> Lines:
    bar = np.array([[0.0, 0.0], [80.0, 0.0]])
    return [bar, *(np.array([[x, 0], [x + rng.uniform(-8, 8), 30]]) for x in np.arange(10, 80, 20.0))]


def _tree(rng: Rng) -> Lines:
    lines: Lines = []

    def grow(start: Points, angle: float, length: float, depth: int) -> None:
        end = start + length * np.array([math.sin(angle), -math.cos(angle)])
        lines.append(np.array([start, end]))
        for side in (-1, 1) if depth else ():
            grow(end, angle + side * rng.uniform(0.3, 0.7), length * rng.uniform(0.6, 0.8), depth - 1)

    grow(np.zeros(2), 0.0, 25.0, int(rng.integers(1, 4)))
    return lines


def _zigzag(rng: Rng) -> Lines:
    index = np.arange(int(rng.integers(5, 12)))
    return [np.column_stack([index * rng.uniform(4, 12), index % 2 * rng.uniform(10, 40)])]


FAMILIES: Final[dict[str, Callable[[Rng], Lines]]] = {
    "blobs": _blobs, "concentric": _concentric, "double-spiral": _double_spiral, "flower": _flower,
    "grid": _grid, "hairpin": _hairpin, "heart": _heart, "leaf": _leaf, "letters": _letters,
    "lissajous": _lissajous, "loops": _loops, "parallel": _parallel, "rings": _rings, "rose": _rose,
    "scribble": _scribble, "spiral": _spiral, "star": _star, "tangent": _tangent, "tees": _tees,
    "tree": _tree, "zigzag": _zigzag,
}  # fmt: skip
CORNERED: Final = frozenset({"grid", "letters", "star", "tees", "tree", "zigzag"})


def lines_of(family: str, rng: Rng) -> Lines:
    """A drawing of that family, fitted into the square."""
    lines = FAMILIES[family](rng)
    low = np.min([line.min(axis=0) for line in lines], axis=0)
    high = np.max([line.max(axis=0) for line in lines], axis=0)
    scale = (SIDE - 2 * MARGIN) / float((high - low).max())
    return [(line - low) * scale + MARGIN for line in lines]


def svg_of(family: str, lines: Lines) -> str:
    """The lines as an SVG's strokes."""
    paths = "".join(f'<path d="{_data(line, family in CORNERED)}"/>' for line in lines)
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {SIDE:g} {SIDE:g}" fill="none" stroke="black">'
        f"{paths}</svg>"
    )


def picture_of(family: str, lines: Lines) -> Image.Image:
    """The lines as grey ink on white."""
    inked = [line if family in CORNERED else _smooth(line) for line in lines]
    side = round(SIDE * PX_PER_UNIT)
    return Image.fromarray(render([line * PX_PER_UNIT for line in inked], STROKE_PX, (side, side)))


def _cubics(line: Points) -> list[Points]:
    """Cubics (4, 2) through the points, each tangent along the chord of its neighbours (Catmull and Rom)."""
    closed = bool(np.linalg.norm(line[0] - line[-1]) < 1e-9)
    before, after = (line[-2], line[1]) if closed else (line[0], line[-1])
    padded = np.concatenate([[before], line, [after]])
    tangent = (padded[2:] - padded[:-2]) / 6
    return [
        np.array([a, a + u, b - v, b])
        for (a, b), (u, v) in zip(itertools.pairwise(line), itertools.pairwise(tangent), strict=True)
    ]


def _smooth(line: Points) -> Points:
    t = np.linspace(0, 1, 9)[1:, None]
    weights = np.concatenate([(1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t**2 * (1 - t), t**3], axis=1)
    return np.concatenate([line[:1], *(weights @ cubic for cubic in _cubics(line))])


def _data(line: Points, cornered: bool) -> str:
    start = f"M{line[0][0]:.4f},{line[0][1]:.4f}"
    if cornered:
        return start + "".join(f"L{x:.4f},{y:.4f}" for x, y in line[1:])
    return start + "".join(
        "C" + " ".join(f"{x:.4f},{y:.4f}" for x, y in cubic[1:]) for cubic in _cubics(line)
    )
