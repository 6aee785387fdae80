"""A first config for a drawing: size and wire proposed from what is drawn."""

from __future__ import annotations

import os
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from wrapit.config import TracingConfig
from wrapit.config.naming import path_problem
from wrapit.config.texts.presets import MARK, preset_file
from wrapit.config.texts.reading import read_blocks
from wrapit.drawing.model import Drawing
from wrapit.drawing.stage import trace
from wrapit.errors import DrawingError, Finding
from wrapit.units import awg_diameter_mm, length_mm

# At what size is a bitmap looked at first? At any: nothing is dropped as too short, and lengths are taken as
# shares.
_TRIAL_MM = 50.0
# What sizes are proposed? The smallest that leaves room, but none too small for fingers to bend.
_LEAST_MM = 40.0
SIZES_MM = (25, 30, 35, 40, 45, 50, 55, 60, 70, 80, 90, 100, 120)
# And what wires? From fine to bold, as `_gauge` chooses.
_GAUGES = (20, 18, 16)
# Strokes of drawings are this much of their size when the wire is meant; bolder ones are for looks.
_BOLDEST = 0.03
# Neighbouring junctions need room for wires and bindings: this many wire diameters.
_ROOM = 6.0


@dataclass(frozen=True)
class Proposal:
    """What is proposed for a drawing, and what was found in it; `more` are lines of a preset.

    `least_mm` is the least size that fingers bend, or the preset's: for a drawing that is made fit.
    """

    named: str
    drawing: Drawing
    across_mm: float
    gauge: int
    size_mm: int
    least_mm: int
    findings: tuple[Finding, ...]
    more: tuple[str, ...] = ()
    fit: str = ""
    """The value of `fit`, if it is to be written; `about_fit` is a comment, above it or for itself."""

    about_fit: str = ""

    def at(self, size_mm: int) -> Proposal:
        """The same at another size."""
        return replace(self, size_mm=size_mm)

    def text(self) -> str:
        """The commented config."""
        drawing, across_mm = self.drawing, self.across_mm
        pieces = [
            f"# {len(drawing.segments)} segments, {len(drawing.junctions)} junctions "
            f"({drawing.odd_junctions} odd, so at least {max(1, drawing.odd_junctions // 2)} wires); "
            f"{drawing.length_mm * self.size_mm / across_mm / 10:.0f} cm of wire at this size.",
            *(f"# {finding.level}: {finding.where}: {finding.message}" for finding in self.findings),
            f"drawing: {_quoted(self.named)}",
            "",
            "# Longest side of the finished piece. Smaller pieces are harder to bend.",
            f"size: {self.size_mm} mm",
            "",
            *self._fit(),
            "wire:",
            f"  gauge: {self.gauge} AWG           # {awg_diameter_mm(self.gauge):.2f} mm; "
            "also swg18 or 1.0 mm",
            "  metal: copper",
            "  temper: dead soft",
            "",
            *([*self.more, ""] if self.more else []),
            "# How many wires, how smooth, how firmly tied: raise smoothness for gentler bends.",
            "decomposition:",
            "  weights: {smoothness: 0.1, robustness: 0.9}",
            "",
            "# `wrapit schema` describes every key; `wrapit check` says whether it can be made.",
        ]
        return "\n".join(pieces) + "\n"

    def _fit(self) -> list[str]:
        lines = [f"# {self.about_fit}"] if self.about_fit else []
        lines += [f"fit: {self.fit}"] if self.fit else []
        return [*lines, ""] if lines else []


def propose(path: Path, folder: Path | None = None, preset: str = "") -> Proposal:
    """A config for a drawing, with size and gauge proposed.

    The config is to lie in `folder`, beside the drawing unless given, and names the drawing from there.

    The gauge follows the stroke's share of the drawing, or is the preset's; the size leaves six wire
    diameters between neighbouring junctions, and isn't less than the preset's. Raises DrawingError where
    the drawing can't be traced, or no config can name it; ConfigError where there is no such preset.
    """
    least_mm, gauge, more = _of_preset(preset) if preset else (_LEAST_MM, None, ())
    named = _seen_from(folder if folder is not None else path.parent, path)
    tracing = TracingConfig.model_validate({"shortest_segment": "0 mm"})
    own_size = path.suffix.lower() == ".json"
    drawing, findings = trace(path, tracing, None if own_size else _TRIAL_MM)
    low, high = drawing.bounds_mm
    across_mm = float((high - low).max())
    gauge = gauge if gauge is not None else _gauge(drawing, across_mm)
    size_mm = _size(drawing, across_mm, awg_diameter_mm(gauge), least_mm)
    least = next(size for size in SIZES_MM if size >= least_mm)
    return Proposal(named, drawing, across_mm, gauge, size_mm, least, findings, more)


def _of_preset(name: str) -> tuple[float, int, tuple[str, ...]]:
    """A preset's size and gauge, and its other lines."""
    path = preset_file(Path(f"{MARK}{name.removeprefix(MARK)}"))
    blocks = read_blocks(path)
    others = path.read_text(encoding="utf-8").splitlines()
    more = tuple(line for line in others if not line.startswith(("size:", "wire:")))
    return length_mm(str(blocks["size"])), int(str(blocks["wire"]["gauge"]).split()[0]), more


def _gauge(drawing: Drawing, across_mm: float) -> int:
    """Bolder strokes mean thicker wire: 20 AWG for fine ones, 18 in between, 16 for bold ones."""
    if drawing.stroke_width_mm is None:
        return 18
    share = drawing.stroke_width_mm / across_mm
    return _GAUGES[0] if share < _BOLDEST / 3 else _GAUGES[1] if share < _BOLDEST else _GAUGES[2]


def _size(drawing: Drawing, across_mm: float, wire_mm: float, least_mm: float) -> int:
    """The smallest size that leaves room between neighbouring junctions; few of them may be closer."""
    lengths = np.array(
        [segment.curve.length for segment in drawing.segments if segment.start != segment.end] or [across_mm]
    )
    needed = _ROOM * wire_mm * across_mm / float(np.percentile(lengths, 15))
    return next((size for size in SIZES_MM if size >= max(needed, least_mm)), SIZES_MM[-1])


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
