"""The style of an element: what its declarations say, and what it inherits (SVG 2, chapters 6 and 13)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

from wrapit.drawing.svg.reading.lengths import FONT_PX, Measure, is_length, length, number, numbers
from wrapit.drawing.svg.reading.matrices import transform
from wrapit.drawing.svg.reading.paints import BLACK, NOTHING, Colour, PaintValue, colour, paint_value

# CSS Fonts 4 (3.1): sizes by name, in px, and the step of `smaller` and `larger`.
_FONT_SIZES = {
    "xx-small": 9.0, "x-small": 10.0, "small": 13.0, "medium": 16.0, "large": 18.0, "x-large": 24.0,
    "xx-large": 32.0, "xxx-large": 48.0, "smaller": 5 / 6, "larger": 1.2,
}  # fmt: skip
_WIDE = ("inherit", "initial", "unset", "revert", "revert-layer")


@dataclass(frozen=True)
class Style:
    """What an element has, inherited or its own; lengths in its user units, opacities from 0 to 1."""

    font: float = FONT_PX
    colour: Colour = (0.0, 0.0, 0.0, 1.0)
    fill: PaintValue = BLACK
    stroke: PaintValue = NOTHING
    context: tuple[PaintValue, PaintValue] = (NOTHING, NOTHING)
    fill_opacity: float = 1.0
    stroke_opacity: float = 1.0
    stroke_width: float = 1.0
    fill_rule: str = "nonzero"
    clip_rule: str = "nonzero"
    cap: str = "butt"
    join: str = "miter"
    dashes: tuple[float, ...] = ()
    dash_offset: float = 0.0
    visible: bool = True
    markers: str = ""


def _is_number(text: str) -> bool:
    return number(text) is not None


def _words(*words: str) -> Callable[[str], bool]:
    return lambda text: text.strip().lower() in words


def _is_length_or_auto(text: str) -> bool:
    return is_length(text) or text.strip().lower() == "auto"


def _is_transform(text: str) -> bool:
    return transform(text, Measure(width=1.0, height=1.0)) is not None


# What a property may say; those that are not here are read where they are used.
_VALID: dict[str, Callable[[str], bool]] = {
    "color": lambda text: colour(text) is not None or text.strip().lower() == "currentcolor",
    "fill": lambda text: paint_value(text) is not None,
    "stroke": lambda text: paint_value(text) is not None,
    "fill-opacity": _is_number,
    "stroke-opacity": _is_number,
    "opacity": _is_number,
    "stroke-width": lambda text: is_length(text) and (number(text) or 0) >= 0,
    "fill-rule": _words("nonzero", "evenodd"),
    "clip-rule": _words("nonzero", "evenodd"),
    "stroke-linecap": _words("butt", "round", "square"),
    "stroke-linejoin": _words("miter", "round", "bevel", "arcs", "miter-clip"),
    "visibility": _words("visible", "hidden", "collapse"),
    "transform": _is_transform,
    **dict.fromkeys(("x", "y", "cx", "cy", "x1", "y1", "x2", "y2"), is_length),
    **dict.fromkeys(("width", "height", "r", "rx", "ry"), _is_length_or_auto),
}


def is_valid(name: str, value: str) -> bool:
    """Whether a property may have a value; where not, an earlier declaration holds."""
    check = _VALID.get(name)
    return check is None or (value.strip().lower() in _WIDE and not _is_geometry(name)) or check(value)


def _is_geometry(name: str) -> bool:
    return _VALID.get(name) in (is_length, _is_length_or_auto)


def derived(parent: Style, declared: dict[str, str], measure: Measure) -> Style:
    """The style of an element in one with a style; `measure` has the parent's font size."""
    own: dict[str, object] = {}
    initial = Style()
    size = declared.get("font-size")
    if size is not None:
        own["font"] = _font_size(size.strip().lower(), parent.font, measure)
    measure = replace(measure, font=own.get("font", parent.font))  # type: ignore[arg-type]
    for name, (field, read) in _FIELDS.items():
        text = declared.get(name)
        if text is None:
            continue
        word = text.strip().lower()
        if word in ("inherit", "unset", "revert", "revert-layer"):
            continue
        value = getattr(initial, field) if word == "initial" else read(text, measure)
        if value is not None:
            own[field] = value
    markers = [declared[name].strip() for name in _MARKERS if name in declared]
    if markers:
        own["markers"] = " ".join(text for text in markers if text.startswith("url("))
    return replace(parent, **own) if own else parent  # type: ignore[arg-type]


def _font_size(text: str, parent: float, measure: Measure) -> float:
    if text in ("smaller", "larger"):
        return parent * _FONT_SIZES[text]
    if text in _FONT_SIZES:
        return _FONT_SIZES[text]
    if text.endswith("%"):
        return parent * share if (share := number(text)) is not None and share >= 0 else parent
    size = length(text, measure, "both")
    return size if size is not None and size >= 0 else parent


def _colour(text: str, _: Measure) -> Colour | None:
    return colour(text)


def _paint(text: str, _: Measure) -> PaintValue | None:
    return paint_value(text)


def _share(text: str, _: Measure) -> float | None:
    found = number(text)
    return None if found is None else min(1.0, max(0.0, found))


def _length(text: str, measure: Measure) -> float | None:
    return length(text, measure, "both")


def _word(text: str, _: Measure) -> str:
    return text.strip().lower()


def _dashes(text: str, measure: Measure) -> tuple[float, ...]:
    """Dashes and gaps in turn; none for a whole line: without a gap, or with a length that is no length."""
    found = [measure.user_units(amount, unit, "both") for amount, unit in numbers(text) or ()]
    known = [each for each in found if each is not None and each >= 0]
    if len(known) < len(found):
        return ()
    if len(known) % 2:
        known *= 2
    return tuple(known) if any(gap > 0 for gap in known[1::2]) else ()


def _visible(text: str, _: Measure) -> bool:
    return text.strip().lower() == "visible"


# The field of each property that is inherited, and how it is read.
_FIELDS: dict[str, tuple[str, Callable[[str, Measure], object]]] = {
    "color": ("colour", _colour),
    "fill": ("fill", _paint),
    "stroke": ("stroke", _paint),
    "fill-opacity": ("fill_opacity", _share),
    "stroke-opacity": ("stroke_opacity", _share),
    "stroke-width": ("stroke_width", _length),
    "fill-rule": ("fill_rule", _word),
    "clip-rule": ("clip_rule", _word),
    "stroke-linecap": ("cap", _word),
    "stroke-linejoin": ("join", _word),
    "stroke-dasharray": ("dashes", _dashes),
    "stroke-dashoffset": ("dash_offset", _length),
    "visibility": ("visible", _visible),
}
_MARKERS = ("marker", "marker-start", "marker-mid", "marker-end")
