"""Random SVG documents as a stranger's program writes them, each with the curves that it means.

A frame and lines across it hold each drawing together, so that no shape is left out as a piece apart. All
lines are black and nothing is filled: what is drawn is the ink and nothing else.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from hypothesis import strategies as st

from tests.drawing.svg.outlines import KINDS, Shape
from wrapit.geometry import FloatArray

Matrix = FloatArray
View = tuple[float, float]
SIDE = 200.0
HEAD = 'xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'
# Across the frame, away from its corners and from each other's middle: three lines that cross in three places.
GRID = "M3 3H197V197H3ZM3 83L197 121M61 3L143 197M3 171L197 37"


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


@dataclass(frozen=True, eq=False)
class Document:
    """The text, its curves in CSS pixels with the stroke width of each, and whether resvg knows all in it."""

    text: str
    curves: list[tuple[FloatArray, float]]
    size_px: View
    rendered_well: bool

    @property
    def plain(self) -> str:
        """The same lines as plain absolute paths."""
        paths = "".join(
            f'<path stroke-width="{width:.9g}" d="{_data(curve)}"/>' for curve, width in self.curves
        )
        w, h = self.size_px
        head = f'xmlns="http://www.w3.org/2000/svg" width="{w}" height="{h}" viewBox="0 0 {w} {h}"'
        return f'<svg {head} fill="none" stroke="black">{paths}</svg>'


def _data(curve: FloatArray) -> str:
    closed = np.linalg.norm(curve[-1, 3] - curve[0, 0]) < 1e-6
    pieces = "".join("C" + " ".join(f"{x:.9g} {y:.9g}" for x, y in cubic[1:]) for cubic in curve)
    return f"M{curve[0, 0, 0]:.9g} {curve[0, 0, 1]:.9g}{pieces}{'Z' if closed else ''}"


# --- matrices


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


# --- what surrounds a shape: text before and after, the matrix, the view inside, whether resvg knows it

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
        ("", 0, 0), ("center", w / 2, h / 2), ("left bottom", 0, h), ("70px 30px", 70, 30), ("25% 75%", w / 4, 0.75 * h),
        ("top", w / 2, 0), ("40px", 40, h / 2), ("0 0", 0, 0),
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


def _switch(page: Page, view: View) -> Wrapped:
    decoy = (
        '<path systemLanguage="xx" d="M20 20L120 20"/><path requiredExtensions="http://e.x/" d="M9 99H99"/>'
    )
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


# --- how a stroke is said

Styled = tuple[dict[str, str], Callable[[str], str]]


def _as_attributes(_: Page, width: str) -> Styled:
    return {"stroke": "black", "stroke-width": width, "fill": "none"}, lambda inner: inner


def _as_style(page: Page, width: str) -> Styled:
    style = f"fill:none;stroke:{page.one_of('#000', 'rgb(0,0,0)', 'BLACK')};stroke-width:{width}"
    return {"style": style, "stroke": "none", "stroke-width": "0"}, lambda inner: inner


def _as_class(page: Page, width: str) -> Styled:
    a, b = page.name(), page.name()
    page.rules += [f".{a},.other{{fill:none;stroke-width:{width}}}", f".{a}.{b}{{stroke:#000}}"]
    page.rules.append(f".{b}{{stroke:none}}")
    return {"class": f"{a}  {b}", "stroke-width": "40"}, lambda inner: inner


def _as_descendant(page: Page, width: str) -> Styled:
    a, b = page.name(), page.name()
    between = page.one_of(" ", " > ")
    page.rules.append(f"g.{a}{between}.{b} {{ fill: none; stroke: black; stroke-width: {width} }}")
    return {"class": b}, lambda inner: f'<g class="{a}">{inner}</g>'


def _as_important(page: Page, width: str) -> Styled:
    name = page.name()
    page.rules.append(f".{name} {{ stroke: black !important; stroke-width: {width} !important; fill: none }}")
    return {"class": name, "style": "stroke: none; stroke-width: 0"}, lambda inner: inner


def _as_id(page: Page, width: str) -> Styled:
    name = page.name()
    page.rules += [f"#{name}{{stroke:black;fill:none;stroke-width:{width}}}", "path{stroke-linecap:round}"]
    page.rules.append(f".{name}{{stroke:none}}")
    return {"id": name, "class": name}, lambda inner: inner


def _inherited(page: Page, width: str) -> Styled:
    say = f'<g stroke="{page.one_of("#000000", "black")}" stroke-width="{width}" fill="none">'
    return {"stroke": "inherit"} if page.rng.integers(2) else {}, lambda inner: f"{say}{inner}</g>"


def _current_colour(_: Page, width: str) -> Styled:
    own = {"stroke": "currentColor", "fill": "none", "stroke-width": width}
    return own, lambda inner: f'<g color="black">{inner}</g>'


STYLES: dict[str, Callable[[Page, str], Styled]] = {
    "attributes": _as_attributes, "style": _as_style, "class": _as_class, "descendant": _as_descendant,
    "important": _as_important, "id": _as_id, "inherited": _inherited, "current-colour": _current_colour,
}  # fmt: skip

# Ways not to be drawn: what stands around a shape, or its attributes.
HIDDEN = (
    '<g display="none">{}</g>', '<g visibility="hidden">{}</g>', "<defs>{}</defs>", "<symbol>{}</symbol>",
    '<marker id="m">{}</marker>', '<mask id="k">{}</mask>', '<clipPath id="c">{}</clipPath>',
    '<pattern id="p">{}</pattern>', '<g opacity="0">{}</g>', '<g style="opacity:0%">{}</g>',
    '<g style="display:none">{}</g>', '<foo xmlns="http://example.com/">{}</foo>', "<title>{}</title>",
    '<g systemLanguage="xx">{}</g>', '<g display="none"><g display="inline">{}</g></g>',
)  # fmt: skip
UNPAINTED = (
    {"stroke": "none"}, {"stroke-width": "0"}, {"stroke-opacity": "0"}, {"visibility": "collapse"},
    {"style": "visibility:hidden"}, {"stroke": "transparent"}, {"style": "stroke:none"}, {"opacity": "0"},
    {"display": "none"}, {"style": "stroke-width:0px"}, {"style": "stroke-opacity:0%"},
)  # fmt: skip


def _element(shape: Shape, more: dict[str, str]) -> str:
    said = "".join(f' {key}="{value}"' for key, value in (shape.attributes | more).items())
    return f"<{shape.tag}{said}/>"


def _unseen(page: Page) -> str:
    """A shape that isn't drawn, in one of many ways."""
    kind = [*KINDS][page.rng.integers(len(KINDS))]
    shape = KINDS[kind](page.rng, (SIDE, SIDE))
    stroke = {"stroke": "black", "fill": "none", "stroke-width": "2"}
    if page.rng.integers(2):
        return page.one_of(*HIDDEN).format(_element(shape, stroke))
    return _element(shape, stroke | UNPAINTED[page.rng.integers(len(UNPAINTED))])


@dataclass(frozen=True)
class Part:
    """One shape of a document: its kind, what surrounds it from outside in, how its stroke is said."""

    kind: str
    wrappers: tuple[str, ...]
    style: str
    unseen: bool
    seed: int


def document(parts: tuple[Part, ...], root: str = "plain", prefixed: bool = False) -> Document:
    """The document that the parts describe; the same parts give the same text."""
    curves: list[tuple[FloatArray, float]] = []
    bodies, well = [], True
    page = Page(np.random.default_rng(0))
    for part in parts:
        around, matrix, shape, known = _on_the_page(page, part)
        width = round(float(page.rng.uniform(1.5, 3.0)), 2)
        said = page.one_of(f"{width}", f"{width}px", f"{width * 25.4 / 96}mm")
        attributes, outer = STYLES[part.style](page, said)
        text = outer(_element(shape, attributes))
        for wrap in reversed(around):
            text = wrap(text)
        # Shares of a symbol's view are measured by the page in resvg, its own by its viewBox; SVG 2 has
        # them the other way round (5.6: what `use` sets stands on the symbol, which is a view of its own).
        shares = "symbol" in part.wrappers and "%" in f"{text}{page.defs}"
        well = well and known and not shares
        bodies.append(text + (_unseen(page) if part.unseen else ""))
        factor = math.sqrt(abs(np.linalg.det(matrix[:2, :2])))
        curves += [(placed(matrix, curve), width * factor) for curve in shape.curves]
    return _finished(page, bodies, curves, root, prefixed, well)


# How often a part is thrown anew until it lies on the page; fewer than one in a thousand needs as many.
_THROWS = 60


def _on_the_page(page: Page, part: Part) -> tuple[list[Callable[[str], str]], Matrix, Shape, bool]:
    """What surrounds a part, its matrix and its shape: what leaves the page is no ink, so none does."""
    rules, names = [*page.rules], page.names
    for throw in range(_THROWS):
        page.rng, page.rules, page.names = np.random.default_rng([part.seed, throw]), [*rules], names
        view, matrix, well = (SIDE, SIDE), np.eye(3), True
        around = []
        for name in part.wrappers:
            wrap, step, view, known = WRAPPERS[name](page, view)
            matrix, well = matrix @ step, well and known
            around.append(wrap)
        shape = KINDS[part.kind](page.rng, view)
        hull = placed(matrix, np.concatenate([curve.reshape(-1, 2) for curve in shape.curves] or [[]]))
        if hull.min() > 5 and hull.max() < SIDE - 5 and np.ptp(hull, axis=0).max() > SIDE / 10:
            break
    return around, matrix, shape, well


ROOTS: dict[str, tuple[str, View, str]] = {
    "plain": ('width="200" height="200"', (200, 200), ""),
    "mm": ('width="100mm" height="100mm"', (960 / 2.54, 960 / 2.54), "xMidYMid"),
    "uneven": ('width="400" height="300" preserveAspectRatio="none"', (400, 300), "none"),
    "letterbox": ('width="300px" height="4in" preserveAspectRatio="xMaxYMin"', (300, 384), "xMaxYMin"),
    "no-size": ("", (200, 200), "xMidYMid"),
}


def _finished(
    page: Page,
    bodies: list[str],
    curves: list[tuple[FloatArray, float]],
    root: str,
    prefixed: bool,
    well: bool,
) -> Document:
    size, port, how = ROOTS[root]
    box = (0.0, 0.0, SIDE, SIDE)
    matrix = fitted(box, port, how) if how else np.eye(3)
    view = f' viewBox="0 0 {SIDE:g} {SIDE:g}"' if how else ""
    style = f"<style>{' '.join(page.rules)}</style>" if page.rules else ""
    grid = f'<path d="{GRID}" fill="none" stroke="black" stroke-width="1.5"/>'
    parts = [f"<defs>{''.join(page.defs)}</defs>", *bodies, grid]
    parts.insert(len(parts) if len(page.rules) % 2 else 0, style)
    text = f"<svg {HEAD} {size}{view}>{''.join(parts)}</svg>"
    if prefixed:
        text = re.sub(r"<(/?)([a-zA-Z])", r"<\1v:\2", text).replace("xmlns=", "xmlns:v=", 1)
    frame = [np.array(points, dtype=float) for points in _grid()]
    lines = [*curves, *((straight, 1.5) for straight in map(_straight, frame))]
    factor = math.sqrt(abs(np.linalg.det(matrix[:2, :2])))
    return Document(text, [(placed(matrix, c), w * factor) for c, w in lines], port, well)


def _grid() -> list[list[tuple[float, float]]]:
    ring = [(3, 3), (197, 3), (197, 197), (3, 197), (3, 3)]
    return [ring, [(3, 83), (197, 121)], [(61, 3), (143, 197)], [(3, 171), (197, 37)]]


def _straight(points: FloatArray) -> FloatArray:
    a, b = points[:-1], points[1:]
    return np.stack([a, a + (b - a) / 3, b - (b - a) / 3, b], axis=1)


PARTS = st.builds(
    Part,
    kind=st.sampled_from(sorted(KINDS)),
    wrappers=st.lists(st.sampled_from(sorted(WRAPPERS)), max_size=3).map(tuple),
    style=st.sampled_from(sorted(STYLES)),
    unseen=st.booleans(),
    seed=st.integers(0, 2**32 - 1),
)
DOCUMENTS = st.builds(
    document,
    st.lists(PARTS, min_size=1, max_size=3).map(tuple),
    st.sampled_from(sorted(ROOTS)),
    st.booleans(),
)
