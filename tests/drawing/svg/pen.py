"""Random path data of all commands, as programs write it, with the curves that it means."""

from __future__ import annotations

import math

import numpy as np

from wrapit.geometry import FloatArray


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


def place(rng: np.random.Generator, view: tuple[float, float]) -> tuple[float, float, float]:
    """A middle in the inner part of the view, and a half size that fits a third of it."""
    width, height = view
    x, y = rng.uniform(0.35, 0.65, 2) * [width, height]
    return float(x), float(y), float(rng.uniform(0.15, 0.3) * min(width, height))


class Pen:
    """Writes path data command by command and keeps the curves that it means."""

    def __init__(self, rng: np.random.Generator, view: tuple[float, float]) -> None:
        self.rng, self.view = rng, view
        x, y, self.size = place(rng, view)
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
        self.lift()

    def move(self) -> None:
        to = self._somewhere()
        self._say("M", to)
        self.here = self.start = to
        self.kind = "m"
        self.lift()

    def lift(self) -> None:
        if self.current:
            self.curves.append(np.concatenate(self.current))
        self.current = []
