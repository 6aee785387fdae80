"""Random SVG documents as a stranger's program writes them, each with the curves that it means.

A frame and lines across it hold each drawing together, so that no shape is left out as a piece apart. All
lines are black and nothing is filled: what is drawn is the ink and nothing else.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from hypothesis import strategies as st

from tests.drawing.svg.outlines import KINDS, Shape
from tests.drawing.svg.surroundings import SIDE, WRAPPERS, Matrix, Page, View, fitted, placed
from wrapit.geometry import FloatArray

HEAD = 'xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'
# Across the frame, away from its corners: three lines that cross in three places.
GRID = "M3 3H197V197H3ZM3 83L197 121M61 3L143 197M3 171L197 37"


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
