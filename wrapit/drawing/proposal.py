"""A first config for a drawing: size and wire proposed from what is drawn."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np

from wrapit.config import TracingConfig
from wrapit.config.naming import path_problem
from wrapit.drawing.model import Drawing
from wrapit.drawing.stage import trace
from wrapit.errors import DrawingError
from wrapit.units import awg_diameter_mm

# At what size is a bitmap looked at first? At any: nothing is dropped as too short, and lengths are taken as
# shares.
_TRIAL_MM = 50.0
# What sizes are proposed? The smallest that leaves room, but none too small for fingers to bend.
_LEAST_MM = 40.0
_SIZES_MM = (40, 45, 50, 55, 60, 70, 80, 90, 100, 120)
# And what wires? From fine to bold, as `_gauge` chooses.
_GAUGES = (20, 18, 16)
# Strokes of drawings are this much of their size when the wire is meant; bolder ones are for looks.
_BOLDEST = 0.03
# Neighbouring junctions need room for wires and bindings: this many wire diameters.
_ROOM = 6.0


def propose_config(path: Path, folder: Path | None = None) -> str:
    """The text of a commented config for a drawing, with size and gauge proposed.

    The config is to lie in `folder`, beside the drawing unless given, and names the drawing from there.

    The gauge follows the stroke's share of the drawing; the size leaves six wire diameters between
    neighbouring junctions. Raises DrawingError where the drawing can't be traced, or no config can name it.
    """
    named = _seen_from(folder if folder is not None else path.parent, path)
    tracing = TracingConfig.model_validate({"shortest_segment": "0 mm"})
    own_size = path.suffix.lower() == ".json"
    drawing, findings = trace(path, tracing, None if own_size else _TRIAL_MM)
    low, high = drawing.bounds_mm
    across_mm = float((high - low).max())
    gauge = _gauge(drawing, across_mm)
    size_mm = _size(drawing, across_mm, awg_diameter_mm(gauge))
    pieces = [
        f"# {len(drawing.segments)} segments, {len(drawing.junctions)} junctions "
        f"({drawing.odd_junctions} odd, so at least {max(1, drawing.odd_junctions // 2)} wires); "
        f"{drawing.length_mm * size_mm / across_mm / 10:.0f} cm of wire at this size.",
        *(f"# {finding.level}: {finding.where}: {finding.message}" for finding in findings),
        f"drawing: {_quoted(named)}",
        "",
        "# Longest side of the finished piece. Smaller pieces are harder to bend.",
        f"size: {size_mm} mm",
        "",
        "wire:",
        f"  gauge: {gauge} AWG           # {awg_diameter_mm(gauge):.2f} mm; also swg18 or 1.0 mm",
        "  metal: copper",
        "  temper: dead soft",
        "",
        "# How many wires, how smooth, how firmly tied: raise smoothness for gentler bends.",
        "decomposition:",
        "  weights: {smoothness: 0.1, robustness: 0.9}",
        "",
        "# `wrapit schema` describes every key; `wrapit check` says whether it can be made.",
    ]
    return "\n".join(pieces) + "\n"


def _gauge(drawing: Drawing, across_mm: float) -> int:
    """Bolder strokes mean thicker wire: 20 AWG for fine ones, 18 in between, 16 for bold ones."""
    if drawing.stroke_width_mm is None:
        return 18
    share = drawing.stroke_width_mm / across_mm
    return _GAUGES[0] if share < _BOLDEST / 3 else _GAUGES[1] if share < _BOLDEST else _GAUGES[2]


def _size(drawing: Drawing, across_mm: float, wire_mm: float) -> int:
    """The smallest size that leaves room between neighbouring junctions; few of them may be closer."""
    lengths = np.array(
        [segment.curve.length for segment in drawing.segments if segment.start != segment.end] or [across_mm]
    )
    needed = _ROOM * wire_mm * across_mm / float(np.percentile(lengths, 15))
    return next((size for size in _SIZES_MM if size >= max(needed, _LEAST_MM)), _SIZES_MM[-1])


def _seen_from(folder: Path, path: Path) -> str:
    """The drawing's path from a folder, with slashes; the whole path where they lie on two drives.

    Links are followed first, or `..` would lead elsewhere.
    """
    drawing = Path(os.path.realpath(path.parent), path.name)
    try:
        seen = Path(os.path.relpath(drawing, os.path.realpath(folder))).as_posix()
    except ValueError:  # no way leads from one drive to another
        seen = drawing.as_posix()
    if problem := path_problem(seen):
        raise DrawingError(problem.partition("; ")[0], str(path), "rename or move the drawing")
    return seen


def _quoted(name: str) -> str:
    """As YAML writes it.

    >>> _quoted("../bee.png"), _quoted("../a: b/bee #2.png")
    ('../bee.png', '"../a: b/bee #2.png"')
    """
    plain = all(letter.isalnum() or letter in "._-/" for letter in name) and name[0] != "-"
    return name if plain else '"' + name.replace("\\", "\\\\").replace('"', '\\"') + '"'
