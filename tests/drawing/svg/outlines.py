"""Random shapes as a stranger's SVG writes them, each with the curves it means.

The curves are worked out here from the rules of SVG 2, apart from what reads them, so that a slip of one
doesn't hide one of the other. Lengths come in all units; a shape knows the view it is measured by.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

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


def straight_through(points: list[FloatArray]) -> FloatArray:
    """Cubics (n, 4, 2) of the polyline through points."""
    p = np.asarray(points, dtype=np.float64)
    a, b = p[:-1], p[1:]
    return np.stack([a, a + (b - a) / 3, b - (b - a) / 3, b], axis=1)


def ring(cx: float, cy: float, rx: float, ry: float) -> FloatArray:
    """An ellipse from its rightmost point, eight cubics (1e-7 of the radius off)."""
    return _turned_arc(np.array([cx, cy]), rx, ry, 0.0, 0.0, 2 * math.pi)


def _turned_arc(
    centre: FloatArray, rx: float, ry: float, tilt: float, start: float, sweep: float
) -> FloatArray:
    count = max(1, math.ceil(abs(sweep) / (math.pi / 4) - 1e-9))
    step = sweep / count
    handle = 4 / 3 * math.tan(step / 4)
    c, s = math.cos(tilt), math.sin(tilt)
    frame = np.array([[c * rx, -s * ry], [s * rx, c * ry]])
    cubics = []
    for k in range(count):
        a, b = start + k * step, start + (k + 1) * step
        pa, pb = np.array([math.cos(a), math.sin(a)]), np.array([math.cos(b), math.sin(b)])
        ta, tb = np.array([-pa[1], pa[0]]), np.array([-pb[1], pb[0]])
        cubics.append(np.stack([pa, pa + handle * ta, pb - handle * tb, pb]) @ frame.T + centre)
    return np.array(cubics)


def arc(
    p: FloatArray, q: FloatArray, rx: float, ry: float, tilt: float, large: bool, sweep: bool
) -> FloatArray:
    """The elliptical arc from p to q (SVG 2, appendix B.2.4): a line for radius 0, grown where too small."""
    rx, ry = abs(rx), abs(ry)
    if rx == 0 or ry == 0:
        return straight_through([p, q])
    c, s = math.cos(tilt), math.sin(tilt)
    x, y = np.array([[c, s], [-s, c]]) @ (p - q) / 2
    grown = (x / rx) ** 2 + (y / ry) ** 2
    if grown > 1:
        rx, ry = rx * math.sqrt(grown), ry * math.sqrt(grown)
    under = max(0.0, (rx * ry) ** 2 / ((rx * y) ** 2 + (ry * x) ** 2) - 1)
    root = math.sqrt(under) * (-1 if large == sweep else 1)
    inner = np.array([root * rx * y / ry, -root * ry * x / rx])
    centre = np.array([[c, -s], [s, c]]) @ inner + (p + q) / 2
    start = math.atan2((y - inner[1]) / ry, (x - inner[0]) / rx)
    end = math.atan2((-y - inner[1]) / ry, (-x - inner[0]) / rx)
    turn = (end - start) % (2 * math.pi)
    return _turned_arc(centre, rx, ry, tilt, start, turn if sweep else turn - 2 * math.pi)


def number(rng: np.random.Generator, value: float) -> str:
    """A number as programs write them: plain, with a sign, without its zero, with an exponent."""
    plain = f"{value:.6f}".rstrip("0").rstrip(".")
    forms = [plain, plain, f"+{plain}" if value > 0 else plain, f"{value:.8e}", plain.replace("0.", ".", 1)]
    return forms[rng.integers(len(forms))] if plain.startswith("0.") else forms[rng.integers(4)]


def length(rng: np.random.Generator, value: float, base: float) -> str:
    """A length in px (or a share of `base`) in a unit of its own."""
    kind = rng.integers(2 * len(UNITS) + 3)
    if kind < 3:
        return f"{100 * value / base:.8f}%"
    unit = [*UNITS][kind - 3] if kind - 3 < len(UNITS) else ""
    return f"{value / UNITS[unit]:.8f}{unit}"


def _place(rng: np.random.Generator, view: tuple[float, float]) -> tuple[float, float, float]:
    """A middle in the inner part of the view, and a half size that fits a third of it."""
    width, height = view
    x, y = rng.uniform(0.35, 0.65, 2) * [width, height]
    return float(x), float(y), float(rng.uniform(0.15, 0.3) * min(width, height))


def _line(rng: np.random.Generator, view: tuple[float, float]) -> Shape:
    x, y, size = _place(rng, view)
    a = rng.uniform(0, 2 * math.pi)
    dx, dy = size * math.cos(a), size * math.sin(a)
    ends = {"x1": x - dx, "y1": y - dy, "x2": x + dx, "y2": y + dy}
    written = {key: length(rng, value, view[key[0] == "y"]) for key, value in ends.items()}
    return Shape(
        "line", written, [straight_through([np.array([x - dx, y - dy]), np.array([x + dx, y + dy])])]
    )


def _poly(rng: np.random.Generator, view: tuple[float, float]) -> Shape:
    x, y, size = _place(rng, view)
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
    cx, cy, size = _place(rng, view)
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
    cx, cy, rx = _place(rng, view)
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


class Pen:
    """Writes path data command by command and keeps the curves that it means."""

    def __init__(self, rng: np.random.Generator, view: tuple[float, float]) -> None:
        self.rng, self.view = rng, view
        x, y, self.size = _place(rng, view)
        self.middle = np.array([x, y])
        self.here = self.start = self._somewhere()
        self.handle: FloatArray | None = None
        self.kind = "m"
        relative = bool(rng.integers(2))
        self.text = f"{'m' if relative else 'M'}{self._pair(self.here)}"
        self.curves: list[FloatArray] = []
        self.current: list[FloatArray] = []

    def _somewhere(self) -> FloatArray:
        return (self.middle + self.rng.uniform(-self.size, self.size, 2)).round(3)

    def _pair(self, point: FloatArray) -> str:
        between = [" ", ",", " ,  "][self.rng.integers(3)]
        return f"{number(self.rng, point[0])}{between}{number(self.rng, point[1])}"

    def _say(self, letter: str, *points: FloatArray, before: str = "") -> None:
        relative = bool(self.rng.integers(2))
        shown = [self._pair(p - self.here if relative else p) for p in points]
        self.text += [" ", "", "\n"][self.rng.integers(3)] + (letter.lower() if relative else letter)
        self.text += before + " ".join(shown)

    def _add(self, cubics: FloatArray, kind: str, handle: FloatArray | None = None) -> None:
        self.current.append(cubics)
        self.here, self.kind, self.handle = cubics[-1, 3], kind, handle

    def line(self) -> None:
        to = self._somewhere()
        self._say("L", to)
        self._add(straight_through([self.here, to]), "l")

    def along(self) -> None:
        axis = int(self.rng.integers(2))
        to = self.here.copy()
        to[axis] = self._somewhere()[axis]
        relative = bool(self.rng.integers(2))
        value = number(self.rng, to[axis] - (self.here[axis] if relative else 0))
        self.text += " " + ("hv" if relative else "HV")[axis] + value
        self._add(straight_through([self.here, to]), "l")

    def cubic(self) -> None:
        a, b, to = (self._somewhere() for _ in range(3))
        self._say("C", a, b, to)
        self._add(np.stack([self.here, a, b, to])[None], "c", b)

    def smooth(self) -> None:
        a = 2 * self.here - self.handle if self.kind == "c" and self.handle is not None else self.here
        b, to = self._somewhere(), self._somewhere()
        self._say("S", b, to)
        self._add(np.stack([self.here, a, b, to])[None], "c", b)

    def quadratic(self) -> None:
        self._bend(self._somewhere(), "Q")

    def smooth_quadratic(self) -> None:
        known = self.kind == "q" and self.handle is not None
        self._bend(2 * self.here - self.handle if known else self.here, "T")

    def _bend(self, a: FloatArray, letter: str) -> None:
        to = self._somewhere()
        self._say(letter, *([a, to] if letter == "Q" else [to]))
        self._add(
            np.stack([self.here, self.here + 2 / 3 * (a - self.here), to + 2 / 3 * (a - to), to])[None],
            "q",
            a,
        )

    def turn(self) -> None:
        to = self._somewhere()
        rx, ry = self.size * self.rng.uniform(0.1, 1.5, 2) * [1, [1, -1][self.rng.integers(2)]]
        if self.rng.integers(6) == 0:
            rx = 0.0
        tilt = float([0, 30, -400][self.rng.integers(3)])
        large, sweep = (bool(flag) for flag in self.rng.integers(2, size=2))
        flags = [f" {large:d} {sweep:d} ", f",{large:d},{sweep:d},", f" {large:d}{sweep:d}"][
            self.rng.integers(3)
        ]
        rx, ry = round(rx, 5), round(ry, 5)
        self._say("A", to, before=f"{rx} {ry} {tilt:g}{flags}")
        self._add(arc(self.here, to, rx, ry, math.radians(tilt), large, sweep), "a")

    def close(self) -> None:
        if self.current and np.linalg.norm(self.here - self.start) > 1e-9:
            self._add(straight_through([self.here, self.start]), "z")
        self.text += ["z", " Z "][self.rng.integers(2)]
        self.here, self.kind = self.start, "z"
        self._lift()

    def move(self) -> None:
        to = self._somewhere()
        self._say("M", to)
        self.here = self.start = to
        self.kind = "m"
        self._lift()

    def _lift(self) -> None:
        if self.current:
            self.curves.append(np.concatenate(self.current))
        self.current = []


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
    pen._lift()
    if rng.integers(6) == 0:
        pen.text += TAILS[rng.integers(len(TAILS))]
    return Shape("path", {"d": pen.text}, pen.curves)


KINDS: dict[str, Callable[[np.random.Generator, tuple[float, float]], Shape]] = {
    "line": _line, "poly": _poly, "rect": _rect, "round": _round, "path": _path,
}  # fmt: skip
