"""Renders the SVG strokes in configs/ as ink on paper: uneven width, soft edges, like a scanned pen drawing.

Run it after editing one of the SVG sources: `python examples/ink.py [folder]`.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw
from svgelements import SVG
from svgelements import Path as SvgPath

CONFIGS = Path(__file__).parent.parent / "configs"
PIXELS_PER_UNIT = 10
OVERSAMPLING = 4
UNEVENNESS = 0.12  # share of the stroke width


def ink(svg: Path) -> Image.Image:
    """The strokes of an SVG as a grey image; the same file gives the same pixels."""
    document = SVG.parse(str(svg), ppi=25.4)
    scale = PIXELS_PER_UNIT * OVERSAMPLING
    paper = Image.new("L", (round(document.width * scale), round(document.height * scale)), 250)
    pen = ImageDraw.Draw(paper)
    rng = np.random.default_rng(sum(svg.stem.encode()))
    for element in document.elements():
        if isinstance(element, SvgPath):
            draw_stroke(pen, element, scale, rng)
    return paper.resize((paper.width // OVERSAMPLING, paper.height // OVERSAMPLING), Image.Resampling.BOX)


def draw_stroke(pen: ImageDraw.ImageDraw, path: SvgPath, scale: float, rng: np.random.Generator) -> None:
    """A chain of round dots whose width swells and thins slowly."""
    positions = np.linspace(0, 1, 1 + round(path.length(error=1e-3) * PIXELS_PER_UNIT * 2))
    points = np.array([[p.x, p.y] for p in map(path.point, positions)]) * scale
    waves = [np.sin(2 * np.pi * (k * positions + rng.random())) / k for k in range(1, 6)]
    widths = path.stroke_width * scale * (1 + UNEVENNESS * np.sum(waves, axis=0) / 2)
    for (x, y), width in zip(points, widths, strict=True):
        pen.ellipse([x - width / 2, y - width / 2, x + width / 2, y + width / 2], fill=30)


if __name__ == "__main__":
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else CONFIGS
    for source in sorted(CONFIGS.glob("*.svg")):
        target = folder / f"{source.stem}.png"
        ink(source).save(target, optimize=True)
        print(target)
