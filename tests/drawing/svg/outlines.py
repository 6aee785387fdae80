"""Random shapes as a stranger's SVG writes them, each with the curves it means.

The curves are worked out here from the rules of SVG 2, apart from what reads them, so that a slip of one
doesn't hide one of the other. Lengths come in all units; a shape knows the view it is measured by.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from tests.drawing.svg.pen import Pen, arc, number, place, ring, straight_through
from wrapit.geometry import FloatArray

# CSS: an inch is 96 pixels, a point a 72nd of one; `em` is 16 px where nobody sets a font.
UNITS = {
    "": 1.0,
    "px": 1.0,
    "mm": 96 / 25.4,
    "cm": 960 / 25.4,
    "in": 96.0,
    "pt": 4 / 3,
    "pc": 16.0,
    "em": 16.0,
}


@dataclass(frozen=True, eq=False)
class Shape:
    """An element's name and attributes, and its curves: arrays (n, 4, 2), one for each subpath."""

    tag: str
    attributes: dict[str, str]
    curves: list[FloatArray]


def length(rng: np.random.Generator, value: float, base: float) -> str:
    """A length in px (or a share of `base`) in a unit of its own."""
    kind = rng.integers(2 * len(UNITS) + 3)
    if kind < 3:
        return f"{100 * value / base:.8f}%"
    unit = [*UNITS][kind - 3] if kind - 3 < len(UNITS) else ""
    return f"{value / UNITS[unit]:.8f}{unit}"


def _line(rng: np.random.Generator, view: tuple[float, float]) -> Shape:
    x, y, size = place(rng, view)
    a = rng.uniform(0, 2 * math.pi)
    dx, dy = size * math.cos(a), size * math.sin(a)
    ends = {"x1": x - dx, "y1": y - dy, "x2": x + dx, "y2": y + dy}
    written = {key: length(rng, value, view[key[0] == "y"]) for key, value in ends.items()}
    return Shape(
        "line", written, [straight_through([np.array([x - dx, y - dy]), np.array([x + dx, y + dy])])]
    )


def _poly(rng: np.random.Generator, view: tuple[float, float]) -> Shape:
    x, y, size = place(rng, view)
    angles = rng.uniform(0, 2 * math.pi) + np.cumsum(rng.uniform(0.8, 1.9, rng.integers(3, 5)))
    points = [np.array([x + size * math.cos(a), y + size * math.sin(a)]).round(4) for a in angles]
    closed = bool(rng.integers(2))
    joint = [" ", ",", " , ", "\n"][rng.integers(4)]
    text = joint.join(f"{number(rng, p[0])}{[' ', ','][rng.integers(2)]}{number(rng, p[1])}" for p in points)
    if rng.integers(4) == 0:
        text += f" {number(rng, x)}"  # an odd coordinate is ignored
    tag = "polygon" if closed else "polyline"
    return Shape(tag, {"points": text}, [straight_through([*points, *points[: 1 * closed]])])


def _rect(rng: np.random.Generator, view: tuple[float, float]) -> Shape:
    cx, cy, size = place(rng, view)
    w, h = 2 * size, 2 * size * rng.uniform(0.5, 1)
    x, y = cx - w / 2, cy - h / 2
    written = {
        "x": length(rng, x, view[0]), "y": length(rng, y, view[1]),
        "width": length(rng, w, view[0]), "height": length(rng, h, view[1]),
    }  # fmt: skip
    rx, ry, kind = rng.uniform(0.2, 0.7) * w, rng.uniform(0.2, 0.7) * h, rng.integers(6)
    if kind == 0:
        written |= {"rx": length(rng, rx, view[0]), "ry": length(rng, ry, view[1])}
    elif kind == 1:
        # A share is one of the width, so the other radius follows the length, not the share.
        written |= {"rx": f"{rx:.6f}"} | ({"ry": "auto"} if rng.integers(2) else {})
        ry = rx
    elif kind == 2:
        written |= {"ry": f"{ry:.6f}"}
        rx = ry
    elif kind == 3:
        written |= {"rx": f"{rx:.6f}", "ry": "0"}
        ry = 0.0
    else:
        rx = ry = 0.0
    rx, ry = min(rx, w / 2), min(ry, h / 2)
    if rx == 0 or ry == 0:
        points = [np.array(p) for p in ((x, y), (x + w, y), (x + w, y + h), (x, y + h), (x, y))]
        return Shape("rect", written, [straight_through(points)])
    stops = [
        (x + rx, y), (x + w - rx, y), (x + w, y + ry), (x + w, y + h - ry),
        (x + w - rx, y + h), (x + rx, y + h), (x, y + h - ry), (x, y + ry), (x + rx, y),
    ]  # fmt: skip
    sides = []
    for k in range(8):
        p, q = np.array(stops[k]), np.array(stops[k + 1])
        if np.linalg.norm(q - p) > 1e-9:
            sides.append(arc(p, q, rx, ry, 0, False, True) if k % 2 else straight_through([p, q]))
    return Shape("rect", written, [np.concatenate(sides)])


def _round(rng: np.random.Generator, view: tuple[float, float]) -> Shape:
    cx, cy, rx = place(rng, view)
    written = {"cx": length(rng, cx, view[0]), "cy": length(rng, cy, view[1])}
    if rng.integers(2):
        diagonal = math.hypot(*view) / math.sqrt(2)
        return Shape("circle", written | {"r": length(rng, rx, diagonal)}, [ring(cx, cy, rx, rx)])
    ry, kind = rx * rng.uniform(0.4, 0.9), rng.integers(4)
    if kind == 0:
        written |= {"rx": f"{rx:.6f}"} | ({"ry": "auto"} if rng.integers(2) else {})
        ry = rx
    else:
        written |= {"rx": length(rng, rx, view[0]), "ry": length(rng, ry, view[1])}
    return Shape("ellipse", written, [ring(cx, cy, rx, ry)])


# What the reader has to stop at (SVG 2, 9.5.4: all before the command at fault is drawn).
TAILS = (" L 10", " C 1 2 3 4 5", " X 3 4", " L 10 ; 20", " A 10 10 0 2 0 50 50", " q", " L foo", " M")


def _path(rng: np.random.Generator, view: tuple[float, float]) -> Shape:
    pen = Pen(rng, view)
    moves: list[Callable[[], None]] = [
        pen.line, pen.along, pen.cubic, pen.smooth, pen.quadratic, pen.smooth_quadratic, pen.turn,
    ]  # fmt: skip
    for step in range(rng.integers(2, 5)):
        moves[rng.integers(len(moves))]()
        if step and rng.integers(6) == 0:
            (pen.close if rng.integers(2) else pen.move)()
    if pen.current and rng.integers(3) == 0:
        pen.close()
    pen.lift()
    if rng.integers(6) == 0:
        pen.text += TAILS[rng.integers(len(TAILS))]
    return Shape("path", {"d": pen.text}, pen.curves)


KINDS: dict[str, Callable[[np.random.Generator, tuple[float, float]], Shape]] = {
    "line": _line, "poly": _poly, "rect": _rect, "round": _round, "path": _path,
}  # fmt: skip
