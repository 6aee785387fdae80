"""What surrounds a shape in a stranger's SVG: groups, copies, views in views; each with its matrix."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from wrapit.geometry import FloatArray

Matrix = FloatArray
View = tuple[float, float]
SIDE = 200.0


@dataclass(eq=False)
class Page:
    """What the parts of a document share: rules of CSS, definitions, names given out."""

    rng: np.random.Generator
    rules: list[str] = field(default_factory=list)
    defs: list[str] = field(default_factory=list)
    names: int = 0

    def name(self) -> str:
        self.names += 1
        return f"n{self.names}"

    def one_of(self, *options: str) -> str:
        return options[self.rng.integers(len(options))]


def affine(a: float, b: float, c: float, d: float, e: float, f: float) -> Matrix:
    return np.array([[a, c, e], [b, d, f], [0, 0, 1.0]])


def moved(x: float, y: float) -> Matrix:
    return affine(1, 0, 0, 1, x, y)


def about(matrix: Matrix, x: float, y: float) -> Matrix:
    return moved(x, y) @ matrix @ moved(-x, -y)


def placed(matrix: Matrix, points: FloatArray) -> FloatArray:
    return points @ matrix[:2, :2].T + matrix[:2, 2]


def turning(degrees: float) -> Matrix:
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return affine(c, s, -s, c, 0, 0)


def _transforms(page: Page, css: bool, count: int) -> tuple[str, Matrix]:
    """A list of transforms and their product, mild enough to stay on the page."""
    rng, texts, matrix = page.rng, [], np.eye(3)
    px = "px" if css else ""
    for _ in range(count):
        x, y = rng.uniform(-12, 12, 2).round(3)
        angle, k, m = round(float(rng.uniform(-80, 80)), 2), *rng.uniform(0.8, 1.15, 2).round(3)
        deg = f"{angle}deg" if css else f"{angle}"
        turn = page.one_of(deg, f"{angle / 360}turn", f"{math.radians(angle)}rad") if css else deg
        lean = f"{angle / 4}deg" if css else f"{angle / 4}"
        slope = math.tan(math.radians(angle / 4))
        kinds: list[tuple[str, Matrix]] = [
            (f"translate({x}{px}, {y}{px})", moved(x, y)),
            (f"translate({x}{px})", moved(x, 0)),
            (f"rotate({turn})", turning(angle)),
            (f"scale({k})", affine(k, 0, 0, k, 0, 0)),
            (f"scale({k}, {m})", affine(k, 0, 0, m, 0, 0)),
            (f"skewX({lean})", affine(1, 0, slope, 1, 0, 0)),
            (f"skewY({lean})", affine(1, slope, 0, 1, 0, 0)),
            (f"matrix({k}, {slope}, 0.1, {m}, {x}, {y})", affine(k, slope, 0.1, m, x, y)),
        ]
        if css:
            kinds += [(f"scaleX({k})", affine(k, 0, 0, 1, 0, 0)), (f"translateY({y}px)", moved(0, y))]
        else:
            kinds += [(f"rotate({angle} {x + 90} {y + 90})", about(turning(angle), x + 90, y + 90))]
        text, step = kinds[rng.integers(len(kinds))]
        texts.append(text if css else text.replace(", ", page.one_of(" ", ",", " , ")))
        matrix = matrix @ step
    return page.one_of(" ", "  " if css else ",").join(texts), matrix


def fitted(view: tuple[float, ...], port: View, how: str) -> Matrix:
    """The matrix that `preserveAspectRatio` means (SVG 2, 8.2)."""
    x, y, w, h = view
    sx, sy = port[0] / w, port[1] / h
    if how == "none":
        return affine(sx, 0, 0, sy, -x * sx, -y * sy)
    name, _, meet = how.partition(" ")
    s = max(sx, sy) if meet == "slice" else min(sx, sy)
    share = {"Min": 0.0, "Mid": 0.5, "Max": 1.0}
    dx, dy = share[name[1:4]] * (port[0] - w * s), share[name[5:8]] * (port[1] - h * s)
    return affine(s, 0, 0, s, dx - x * s, dy - y * s)


def _aspect(page: Page) -> tuple[str, str]:
    how = page.one_of("none", "xMinYMid", "xMaxYMin", "xMidYMax slice", "xMidYMid", "")
    return (f' preserveAspectRatio="{how}"' if how else "", how or "xMidYMid")


# What surrounds a shape: text before and after, the matrix, the view inside, whether resvg knows it

Wrapped = tuple[Callable[[str], str], Matrix, View, bool]


def _group(page: Page, view: View) -> Wrapped:
    text, matrix = _transforms(page, False, int(page.rng.integers(1, 4)))
    return lambda inner: f'<g transform="{text}">{inner}</g>', matrix, view, True


def _origin_attribute(page: Page, view: View) -> Wrapped:
    text, matrix = _transforms(page, False, 1)
    x, y = page.rng.uniform(60, 140, 2).round(2)
    say = f'<g transform="{text}" transform-origin="{x} {y}">'
    return lambda inner: f"{say}{inner}</g>", about(matrix, x, y), view, True


def _css_transform(page: Page, view: View) -> Wrapped:
    text, matrix = _transforms(page, True, int(page.rng.integers(1, 3)))
    w, h = view
    origins = [
        ("", 0, 0), ("center", w / 2, h / 2), ("left bottom", 0, h), ("70px 30px", 70, 30),
        ("25% 75%", w / 4, 0.75 * h), ("top", w / 2, 0), ("40px", 40, h / 2), ("0 0", 0, 0),
    ]  # fmt: skip
    origin, x, y = origins[page.rng.integers(len(origins))]
    style = f"transform: {text}" + (f"; transform-origin: {origin}" if origin else "")
    if page.rng.integers(2):
        name = page.name()
        page.rules.append(f".{name} {{ {style} }}")
        say = f'<g class="{name}">'
    else:
        say = f'<g style="{style}">'
    return lambda inner: f"{say}{inner}</g>", about(matrix, float(x), float(y)), view, False


def _use(page: Page, view: View) -> Wrapped:
    name = page.name()
    text, matrix = _transforms(page, False, 1)
    x, y = page.rng.uniform(-10, 10, 2).round(3)
    link = page.one_of("href", "xlink:href")
    say = f'<use {link}="#{name}" x="{x}" y="{y}" transform="{text}"/>'

    def wrap(inner: str) -> str:
        page.defs.append(f'<g id="{name}">{inner}</g>')
        return say

    return wrap, matrix @ moved(x, y), view, True


def _port(page: Page, view: View) -> tuple[str, View, Matrix, View]:
    """Attributes of a nested view over most of the outer one, its place, the matrix, the view inside."""
    w, h = view
    x, y = page.rng.uniform(0.02, 0.1, 2).round(4) * [w, h]
    wide, high = page.rng.uniform(0.8, 0.9, 2).round(4) * [w, h]
    aspect, how = _aspect(page)
    inside = tuple(page.rng.uniform(150, 260, 2).round(2))
    low = page.rng.uniform(-20, 20, 2).round(2)
    place = [f"{x}", f"{y}", f"{wide}", f"{high}"]
    if page.rng.integers(2):
        place = [f"{100 * v / base}%" for v, base in zip((x, y, wide, high), (w, h, w, h), strict=True)]
    text = 'x="{}" y="{}" width="{}" height="{}"'.format(*place)
    box = f'viewBox="{low[0]} {low[1]} {inside[0]} {inside[1]}"{aspect} overflow="visible"'
    matrix = moved(float(x), float(y)) @ fitted((*low, *inside), (wide, high), how)
    return f"{text}|{box}", view, matrix @ moved(*low), (float(inside[0]), float(inside[1]))


def _nested(page: Page, view: View) -> Wrapped:
    text, _, matrix, inside = _port(page, view)
    place, box = text.split("|")
    # The view may start anywhere; what is inside is drawn from its corner.
    low = re.findall(r'viewBox="(\S+) (\S+)', box)[0]
    shift = f'<g transform="translate({low[0]} {low[1]})">'
    return lambda inner: f"<svg {place} {box}>{shift}{inner}</g></svg>", matrix, inside, True


def _symbol(page: Page, view: View) -> Wrapped:
    text, _, matrix, inside = _port(page, view)
    place, box = text.split("|")
    low = re.findall(r'viewBox="(\S+) (\S+)', box)[0]
    name, early = page.name(), bool(page.rng.integers(2))

    def wrap(inner: str) -> str:
        shift = f'<g transform="translate({low[0]} {low[1]})">{inner}</g>'
        symbol = f'<symbol id="{name}" {box}>{shift}</symbol>'
        if early:
            return f'{symbol}<use xlink:href="#{name}" {place}/>'
        page.defs.append(symbol)
        return f'<use href="#{name}" {place}/>'

    return wrap, matrix, inside, True


def _switch(_: Page, view: View) -> Wrapped:
    decoy = '<path systemLanguage="xx" d="M20 20L120 20"/>'
    decoy += '<path requiredExtensions="http://e.x/" d="M9 99H99"/>'
    rest = '<path d="M30 90L150 96"/>'
    return lambda inner: f"<switch>{decoy}<g>{inner}</g>{rest}</switch>", np.eye(3), view, True


def _shown_inside_hidden(_: Page, view: View) -> Wrapped:
    hidden = '<path d="M15 35L115 25"/>'
    return (
        lambda inner: f'<g visibility="hidden">{hidden}<g visibility="visible">{inner}</g></g>',
        np.eye(3),
        view,
        True,
    )


def _link(_: Page, view: View) -> Wrapped:
    return lambda inner: f'<a xlink:href="http://example.com/">{inner}</a>', np.eye(3), view, True


WRAPPERS: dict[str, Callable[[Page, View], Wrapped]] = {
    "group": _group, "origin-attribute": _origin_attribute, "css-transform": _css_transform, "use": _use,
    "nested-svg": _nested, "symbol": _symbol, "switch": _switch, "shown-in-hidden": _shown_inside_hidden,
    "link": _link,
}  # fmt: skip
