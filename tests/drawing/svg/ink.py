"""The ink that another renderer (resvg) gives an SVG, and how traced curves lie in it.

Needs `resvg_py`. A traced drawing is scaled to its size and shifted to (0, 0); the renderer's own size of the
page gives the scale back, and the place where the curves lie deepest in the ink gives the shift.
"""

from __future__ import annotations

import io
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from scipy.ndimage import distance_transform_edt
from scipy.signal import fftconvolve

from wrapit.config import TracingConfig
from wrapit.drawing.model import Drawing
from wrapit.drawing.stage import trace
from wrapit.errors import Finding
from wrapit.geometry import FloatArray

Ink = NDArray[np.bool_]

# Paper of a rendering is 255; a pixel that ink covers by a twelfth is ink.
DARK = 235
# CSS: a pixel is a 96th of an inch.
MM_PER_PX = 25.4 / 96
# A curve this many pixels off the ink is off: rasters of curve and ink differ by one, rounding by half.
OFF_PX = 1.6
# Ink farther from a curve than this share of its half width there is missed: a square end or a right corner
# reaches √2 half widths, a mitre of 60° two.
REACH = 1.5
# Less than this share is the raster's own: mitres of sharp corners, ends between pixels.
HARMLESS = 0.01


@dataclass(frozen=True)
class Shares:
    """Share of the ink without a curve near, and share of the curves' length without ink."""

    missed: float
    extra: float

    @property
    def alike(self) -> bool:
        return max(self.missed, self.extra) < HARMLESS


@dataclass(frozen=True, eq=False)
class Verdict:
    """Shares of a traced file, what it says it left out or linked (in shares of the length), its findings."""

    shares: Shares
    left_out: float
    linked: float
    findings: tuple[Finding, ...]

    @property
    def true(self) -> bool:
        """No curve without ink beyond the links, no ink missed beyond what the reader says it left out.

        The share of ink that is left out is that of the length where all strokes are equally wide; a third
        more is let pass, as joints count once in the ink.
        """
        spared = HARMLESS + 1.33 * self.left_out
        return self.shares.extra < HARMLESS + self.linked and self.shares.missed < spared


def rendered(svg: str | bytes | Path, longest_px: int) -> tuple[NDArray[np.uint8], float]:
    """Grey values of the whole page, its longest side `longest_px`, and how many pixels a CSS pixel takes."""
    import resvg_py

    where = {"svg_path": str(svg)} if isinstance(svg, Path) else {"svg_string": _text(svg)}
    # Without `dpi` the renderer takes every mm for nothing.
    how = {"skip_system_fonts": True, "dpi": 96.0, "background": "white"}
    own = Image.open(io.BytesIO(bytes(resvg_py.svg_to_bytes(**where, **how))))
    zoom = longest_px / max(own.size)
    picture = resvg_py.svg_to_bytes(**where, **how, zoom=zoom)
    return np.asarray(Image.open(io.BytesIO(bytes(picture))).convert("L")), zoom


def _text(svg: str | bytes) -> str:
    return svg if isinstance(svg, str) else svg.decode("utf-8", errors="replace")


def ink_of(svg: str | bytes | Path, longest_px: int = 500) -> tuple[Ink, float]:
    """Where the page is dark (h, w), and how many pixels a CSS pixel takes."""
    grey, zoom = rendered(svg, longest_px)
    return grey < DARK, zoom


def sampled(cubics: FloatArray, step: float) -> FloatArray:
    """Points (n, 2) along cubics (m, 4, 2), at most about `step` apart."""
    reach = np.linalg.norm(np.diff(cubics, axis=1), axis=2).sum(axis=1)
    found = []
    for cubic, length in zip(cubics, reach, strict=True):
        t = np.linspace(0, 1, 2 + int(length / step))[:, None]
        s = 1 - t
        found.append(s**3 * cubic[0] + 3 * s * s * t * cubic[1] + 3 * s * t * t * cubic[2] + t**3 * cubic[3])
    return np.concatenate(found) if found else np.zeros((0, 2))


def shares(points: FloatArray, ink: Ink) -> Shares:
    """How points (n, 2) along curves, in the pixels of the ink and dense in them, and the ink agree."""
    at = np.floor(points).astype(int)
    inside = ((at >= 0) & (at < [ink.shape[1], ink.shape[0]])).all(axis=1)
    if not inside.any() or not ink.any():
        return Shares(float(ink.any()), float(len(points) > 0))
    line = np.zeros(ink.shape, dtype=bool)
    line[at[inside, 1], at[inside, 0]] = True
    off = distance_transform_edt(~ink)[at[inside, 1], at[inside, 0]] > OFF_PX
    extra = float((off.sum() + (~inside).sum()) / len(points))
    # Around each point of a curve, ink is its own as far as the ink is broad there.
    half = np.where(line, distance_transform_edt(np.pad(ink, 1))[1:-1, 1:-1], 0.0)
    covered = np.zeros(ink.shape, dtype=bool)
    for size in np.unique(np.ceil(half[line])):
        same = line & (np.ceil(half) == size)
        covered |= distance_transform_edt(~same) <= REACH * size + OFF_PX
    return Shares(float((ink & ~covered).sum() / ink.sum()), extra)


def against_ink(path: Path, tracing: TracingConfig | None = None, longest_px: int = 500) -> Verdict:
    """How a file's traced drawing and its rendering agree. Raises what tracing raises."""
    ink, zoom = ink_of(path, longest_px)
    drawing, findings = trace(path, tracing or TracingConfig(), None)
    told = {
        what: sum(removal.length_mm for removal in drawing.removed if removal.what == what)
        for what in ("piece", "link")
    }
    # The caps of what is left out are ink as well: half a width at each end.
    caps = (drawing.stroke_width_mm or 0.0) * sum(removal.what == "piece" for removal in drawing.removed)
    whole = max(told["piece"] + caps + drawing.length_mm, 1e-9)
    found = _placed(drawing, ink, zoom / MM_PER_PX)
    if not found.alike:
        # A file without a size has no mm: the ink's and the curves' boxes say how many.
        found = min(found, _placed(drawing, ink, _px_per_mm(drawing, ink)), key=lambda s: s.missed + s.extra)
    return Verdict(found, (told["piece"] + caps) / whole, told["link"] / whole, findings)


def _px_per_mm(drawing: Drawing, ink: Ink) -> float:
    low, high = drawing.bounds_mm
    rows, columns = np.nonzero(ink)
    spread = max(np.ptp(rows), np.ptp(columns)) + 1
    return float(spread / (max(high - low) + (drawing.stroke_width_mm or 0.0)))


def _placed(drawing: Drawing, ink: Ink, px_per_mm: float) -> Shares:
    """The shares at the shift that puts the curves deepest into the ink."""
    if not ink.any():
        return Shares(0.0, 1.0)
    low, high = drawing.bounds_mm
    strokes = [segment.curve.points for segment in drawing.segments if segment.kind == "stroke"]
    points = (np.concatenate(strokes) - [low[0], high[1]]) * [px_per_mm, -px_per_mm]
    if points.max() > 3 * max(ink.shape):
        return Shares(1.0, 1.0)
    along = sampled(points, 0.7)
    line = np.zeros(np.ceil(along.max(axis=0)).astype(int)[::-1] + 2, dtype=np.float64)
    np.add.at(line, tuple(np.maximum(np.floor(along).astype(int), 0)[:, ::-1].T), 1.0)
    line = np.minimum(line, 1.0)
    # Off the ink each pixel costs, so that a part of the drawing isn't hidden in a broad stroke.
    # A line is no deeper in ink than it is wide: the middle of a filled shape draws no outline to it.
    half = max(1.0, (drawing.stroke_width_mm or np.inf) * px_per_mm / 2)
    deep = np.minimum(distance_transform_edt(ink), half) - np.minimum(distance_transform_edt(~ink), 8.0)
    match = fftconvolve(deep, line[::-1, ::-1], mode="full")
    row, column = np.unravel_index(int(np.argmax(match)), match.shape)
    shift = np.array([column - line.shape[1] + 1, row - line.shape[0] + 1], dtype=np.float64)
    return shares(along + shift, ink)
