"""Single-line lettering, as a laser engraves it in one stroke."""

from __future__ import annotations

import itertools
from functools import cache
from typing import Any

import numpy as np

from wrapit.geometry import FloatArray, Line
from wrapit.geometry.polyline import steps
from wrapit.jig.contours import Contour, Layer

# Capitals of the Hershey font fill three quarters of its full height (the font's own measure).
_CAPITAL = 0.75


def text_size_mm(text: str, height_mm: float) -> tuple[float, float]:
    """Width and height of a text whose capitals are `height_mm` tall."""
    width, height = np.ptp(np.vstack(_strokes(text, height_mm)), axis=0)
    return float(width), float(height)


def engraved_text(
    text: str, centre: tuple[float, float], height_mm: float, layer: Layer = "ENGRAVE"
) -> tuple[Contour, ...]:
    """The text around its centre, as open polylines (Hershey's simplex letters)."""
    strokes = _strokes(text, height_mm)
    points = np.vstack(strokes)
    shift = np.array(centre) - (points.min(axis=0) + points.max(axis=0)) / 2
    return tuple(_polyline(stroke + shift, layer) for stroke in strokes)


def _strokes(text: str, height_mm: float) -> list[FloatArray]:
    strokes = [np.array(stroke) * height_mm for stroke in _unit_strokes(text)]
    if not strokes:
        raise ValueError(f"nothing to engrave in {text!r}")
    return strokes


@cache
def _unit_strokes(text: str) -> tuple[tuple[tuple[float, float], ...], ...]:
    """The letters' strokes with capitals one millimetre tall."""
    font = _font()
    strokes = [_distinct(np.array(stroke)) for stroke in font.strokes_for_text(text)]
    return tuple(tuple((float(x), float(y)) for x, y in s) for s in strokes if len(s) > 1)


@cache
def _font() -> Any:
    """Hershey's simplex letters; reading the package's archive takes longer than all the rest."""
    from HersheyFonts import HersheyFonts

    font = HersheyFonts()
    font.load_default_font("futural")
    font.normalize_rendering(1 / _CAPITAL)
    return font


def _distinct(stroke: FloatArray) -> FloatArray:
    keep = np.append(True, steps(stroke) > 1e-6)
    return stroke[keep]


def _polyline(points: FloatArray, layer: Layer) -> Contour:
    edges = tuple(
        Line((float(a[0]), float(a[1])), (float(b[0]), float(b[1]))) for a, b in itertools.pairwise(points)
    )
    return Contour(layer, edges)
