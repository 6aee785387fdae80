"""Walks through an SVG file as a browser does, and gives what it paints: groups, copies, viewports, clips.

Every shape becomes cubics in its own units first; one matrix then takes them to px. The work is bounded while
it is done: copies, parts and depth are counted as they come.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

from wrapit.drawing.svg.reading import paints
from wrapit.drawing.svg.reading.css import Cascade
from wrapit.drawing.svg.reading.document import DEEPEST, read_document
from wrapit.drawing.svg.reading.element import Element, chosen, met
from wrapit.drawing.svg.reading.lengths import Measure, lengths_of, number
from wrapit.drawing.svg.reading.links import Links
from wrapit.drawing.svg.reading.matrices import (
    IDENTITY,
    Matrix,
    about,
    determinant,
    inverse,
    moved_by,
    times,
    written_transform,
)
from wrapit.drawing.svg.reading.model import Clip, Missing, Omission, Page, Shape, box_within
from wrapit.drawing.svg.reading.outlines import OUTLINED, Outliner
from wrapit.drawing.svg.reading.styles import Style, derived, is_valid
from wrapit.drawing.svg.reading.viewport import fitted, page_size, view_box
from wrapit.errors import DrawingError

# All copies counted. Reading as many takes a few seconds, and no jewellery has so many.
MOST_SHAPES = 20_000

# What is drawn with all in it, what `use` can copy besides, and what is left out with a warning.
_GROUPS = ("g", "a", "switch")
_COPIED = (*_GROUPS, *OUTLINED, "use", "text", "image", "foreignObject")
_LEFT_OUT: dict[str, Missing] = {"text": "text", "image": "picture", "foreignObject": "foreign"}
# Boxes that `transform-box` may name; those with the stroke are taken for those without, as in Chrome.
_OWN_BOXES = ("fill-box", "content-box", "stroke-box", "border-box")


@dataclass(frozen=True)
class _Frame:
    """What an element finds around itself."""

    matrix: Matrix
    style: Style
    measure: Measure
    opacity: float = 1.0
    mask: str = ""
    depth: int = 0


def read_page(path: Path) -> Page:
    """All that an SVG file paints.

    Raises DrawingError where the file can't be read, is no SVG, or would take too long.
    """
    document = read_document(path)
    omissions = [Omission("style-sheet", line, text[:40]) for line, text in document.sheets]
    return replace(_Scene(document.root, path).page(omissions), program=document.program)


class _Scene:
    def __init__(self, root: Element, path: Path) -> None:
        self._root, self._path = root, path
        self._cascade = Cascade(root, path, is_valid)
        self._links = Links(root)
        self._outliner = Outliner(self._links, path)
        self._omissions: list[Omission] = []
        self._clipping: list[Element] = []
        self._count = 0

    def page(self, omissions: list[Omission]) -> Page:
        declared = self._cascade.declared(self._root)
        width, height = page_size(
            declared.get("width"), declared.get("height"), view_box(self._root.get("viewBox"))
        )
        measure = Measure(width=width, height=height, page=(width, height))
        style = derived(Style(), declared, measure)
        measure = replace(measure, root_font=style.font)
        shapes = self._element(self._root, _Frame(IDENTITY, Style(), measure), (width, height))
        frame = None
        if self._root.get("viewBox") or (declared.get("width") and declared.get("height")):
            frame = Clip((self._outliner.place(self._root, IDENTITY, width, height),))
        return Page(
            tuple(shape for shape in shapes if shape.fill or shape.stroke),
            (width, height),
            frame,
            (*omissions, *self._omissions, *self._outliner.omissions),
            paints.background(declared),
        )

    def _element(
        self, element: Element, around: _Frame, size: tuple[float | None, float | None] | None = None
    ) -> list[Shape]:
        """What an element paints; `size` is that of its viewport as whoever copies it wants."""
        name = element.name
        if not name:
            return []
        self._refuse_endless(element, around.depth)
        declared = self._cascade.declared(element)
        if declared.get("display", "").strip().lower() == "none" and name != "symbol":
            return []
        if not met(element):
            return []
        measure = replace(around.measure, font=around.style.font)
        style = derived(around.style, declared, measure)
        opacity = number(declared.get("opacity"))
        frame = replace(
            around,
            style=style,
            measure=replace(measure, font=style.font),
            opacity=around.opacity * (1.0 if opacity is None else min(1.0, max(0.0, opacity))),
            mask=around.mask or self._links.mask(declared),
            depth=around.depth + 1,
        )
        if frame.opacity <= 0:
            return []
        own, about_box = self._transform(element, declared)
        if not about_box:
            frame = replace(frame, matrix=times(around.matrix, own(0.0, 0.0, frame.measure)))
        if not determinant(frame.matrix):
            return []
        shapes = self._content(element, declared, frame, size)
        shapes = self._clipped(declared, frame, shapes)
        return _turned(shapes, frame, own) if about_box else shapes

    def _content(
        self,
        element: Element,
        declared: dict[str, str],
        frame: _Frame,
        size: tuple[float | None, float | None] | None,
    ) -> list[Shape]:
        name = element.name
        if name in OUTLINED:
            return [
                self._outliner.shape(
                    element, declared, frame.style, frame.matrix, frame.measure, frame.opacity, frame.mask
                )
            ]
        if name in _GROUPS:
            return self._children(chosen(element) if name == "switch" else element.inside, frame)
        if name == "use":
            return self._copy(element, declared, frame)
        if name == "svg" or (name == "symbol" and size is not None):
            return self._viewport(element, declared, frame, size)
        if name == "image" and element.link and not element.link.startswith("data:"):
            self._omissions.append(Omission("other-file", element.line, element.link[:60]))
        elif (
            name in _LEFT_OUT
            and frame.style.visible
            and (name != "text" or "".join(element.itertext()).strip())
        ):
            self._omissions.append(Omission(_LEFT_OUT[name], element.line))
        return []

    def _children(self, elements: list[Element], frame: _Frame) -> list[Shape]:
        return [shape for element in elements for shape in self._element(element, frame)]

    def _copy(self, element: Element, declared: dict[str, str], frame: _Frame) -> list[Shape]:
        link = element.link
        if link and not link.startswith("#"):
            self._omissions.append(Omission("other-file", element.line, link[:60]))
            return []
        target = self._links.target(link)
        if target is None:
            return []
        if self._links.is_endless(element):
            self._omissions.append(Omission("recursion", element.line, link[:60]))
            return []
        get = lengths_of(declared, frame.measure)
        place = moved_by(get("x", "width") or 0.0, get("y", "height") or 0.0)
        style = frame.style
        context = (
            self._outliner.in_context(style.fill, style),
            self._outliner.in_context(style.stroke, style),
        )
        frame = replace(frame, matrix=times(frame.matrix, place), style=replace(style, context=context))
        if target.name in ("svg", "symbol"):
            return self._element(target, frame, (get("width", "width"), get("height", "height")))
        return self._element(target, frame) if target.name in _COPIED else []

    def _viewport(
        self,
        element: Element,
        declared: dict[str, str],
        frame: _Frame,
        size: tuple[float | None, float | None] | None,
    ) -> list[Shape]:
        """What is in an `svg` or a `symbol`: fitted into its place, and clipped to it."""
        get, measure = lengths_of(declared, frame.measure), frame.measure
        outermost = element is self._root
        asked = size or (None, None)
        own = (get("width", "width"), get("height", "height")) if element.name == "svg" else (None, None)
        whole = (measure.width, measure.height)
        width, height = (
            next(each for each in choices if each is not None)
            for choices in zip(asked, own, whole, strict=True)
        )
        if width <= 0 or height <= 0:
            return []
        matrix = frame.matrix
        if element.name == "svg" and not outermost:
            matrix = times(matrix, moved_by(get("x", "width") or 0.0, get("y", "height") or 0.0))
        box = view_box(element.get("viewBox"))
        view = fitted(box, width, height, element.get("preserveAspectRatio")) if box else IDENTITY
        if view is None:
            return []
        inside = (box[2], box[3]) if box else (width, height)
        inner = replace(
            frame, matrix=times(matrix, view), measure=replace(measure, width=inside[0], height=inside[1])
        )
        shapes = self._children(element.inside, inner)
        overflow = declared.get("overflow", "hidden").strip().lower()
        if outermost or overflow in ("visible", "auto"):
            return shapes
        clip = Clip((self._outliner.place(element, matrix, width, height),))
        return [replace(shape, clips=(*shape.clips, clip)) for shape in shapes]

    def _transform(
        self, element: Element, declared: dict[str, str]
    ) -> tuple[Callable[[float, float, Measure], Matrix], bool]:
        """The matrix about a box, by its corner and a measure of its size; whether it is the own box."""
        if "transform" in element.attrib and not is_valid("transform", element.attrib["transform"]):
            self._omissions.append(Omission("transform", element.line, element.attrib["transform"][:40]))
        own_box = declared.get("transform-box", "").strip().lower() in _OWN_BOXES
        written = written_transform(declared)

        def matrix(x: float, y: float, measure: Measure) -> Matrix:
            return about(written, declared.get("transform-origin", "0 0"), x, y, measure)

        return matrix, own_box and bool(written)

    def _clipped(self, declared: dict[str, str], frame: _Frame, shapes: list[Shape]) -> list[Shape]:
        target = self._links.named_in(declared.get("clip-path", ""))
        if target is None or target.name != "clipPath" or not shapes or target in self._clipping:
            return shapes
        self._clipping.append(target)
        clip = self._clip(target, frame, shapes)
        self._clipping.pop()
        return [replace(shape, clips=(*shape.clips, clip)) for shape in shapes]

    def _clip(self, element: Element, frame: _Frame, shapes: list[Shape]) -> Clip:
        """What a `clipPath` leaves to be seen of shapes."""
        declared = self._cascade.declared(element)
        matrix = frame.matrix
        if element.get("clipPathUnits") == "objectBoundingBox":
            found = box_within(shapes, matrix)
            if found is None:
                return Clip(())
            x, y, width, height = found
            matrix = times(matrix, (width, 0.0, 0.0, height, x, y))
        measure = replace(frame.measure, font=frame.style.font)
        style = derived(Style(), declared, measure)
        inner = _Frame(matrix, style, measure, depth=frame.depth + 1)
        own, _ = self._transform(element, declared)
        inner = replace(inner, matrix=times(matrix, own(0.0, 0.0, measure)))
        drawn = self._children([e for e in element.inside if e.name in (*OUTLINED, "use")], inner)
        drawn = [replace(shape, fill_rule=shape.clip_rule) for shape in drawn if shape.shown]
        return Clip(tuple(self._clipped(declared, replace(inner, matrix=frame.matrix), drawn)))

    def _refuse_endless(self, element: Element, depth: int) -> None:
        self._count += 1
        if self._count > MOST_SHAPES:
            raise DrawingError(
                f"the drawing has more than {MOST_SHAPES} shapes and groups, copies counted",
                str(self._path),
                "simplify it, or copy less with <use>",
            )
        if depth > DEEPEST:
            raise DrawingError(
                f"groups and copies are nested more than {DEEPEST} deep",
                f"{self._path}:{element.line}",
                "ungroup them, or copy less with <use>",
            )


def _turned(
    shapes: list[Shape], frame: _Frame, own: Callable[[float, float, Measure], Matrix]
) -> list[Shape]:
    """Shapes under a transform about their own box."""
    found, back = box_within(shapes, frame.matrix), inverse(frame.matrix)
    if found is None or back is None:
        return shapes
    x, y, width, height = found
    matrix = own(x, y, replace(frame.measure, width=width, height=height))
    if not determinant(matrix):
        return []
    matrix = times(frame.matrix, times(matrix, back))
    return [shape.moved(matrix) for shape in shapes]
