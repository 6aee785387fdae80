"""Cusps between arcs, as around a cloud, and short ends of bars beyond a post: how many are read as drawn.

Run as `python -m tests.bench cusps`; radii and lengths are in stroke widths.
"""

from __future__ import annotations

import math
import tempfile
from pathlib import Path

import numpy as np
from PIL import Image

from tests.drawing.bitmap.figures import CENTRE, in_pixels, line, scallops, turned
from tests.drawing.generated import Points, degrees, render
from wrapit.config import TracingConfig
from wrapit.drawing.stage import trace
from wrapit.errors import DrawingError

RADII = (1.2, 1.6, 2.0, 2.5, 3.0, 4.0)
TURNS_DEG = (68, 80, 95, 110)
BEYOND = (0.3, 0.45, 0.6, 0.8, 1.0, 1.3)
ANGLES_DEG = (60, 75, 90)
EACH = 12
NEAR = 0.3


def main() -> None:
    """Prints both tables: of how many, each turned and as thick as a seed says, all places are right."""
    rng = np.random.default_rng(1)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "strokes.png"
        print(f"three cusps, by the arcs' radius and by their turn (each of {EACH}):")
        for radius in RADII:
            print(
                f"  {radius:4}", *(f"{turn:4} deg {_cusps(path, radius, turn, rng):3}" for turn in TURNS_DEG)
            )
        print(f"short ends, by how far they stick out and by their angle to the post (each of {EACH}):")
        for out in BEYOND:
            told = [f"{angle:4} deg {_ends(path, out, angle, rng):3}" for angle in ANGLES_DEG]
            print(f"  {out:4}", *told)


def _cusps(path: Path, radius: float, turn_deg: float, rng: np.random.Generator) -> int:
    right = 0
    for _ in range(EACH):
        width = rng.uniform(5, 18)
        points, cusps = scallops(radius, turn_deg, 4, width)
        right += _read(path, [points], cusps, width, [1, 1, 2, 2, 2], rng)
    return right


def _ends(path: Path, out: float, angle_deg: float, rng: np.random.Generator) -> int:
    right = 0
    for _ in range(EACH):
        width, angle = rng.uniform(5, 18), math.radians(angle_deg)
        side, end = 9 * width, (CENTRE - out * width, CENTRE)
        bar = line(end, (CENTRE + side, CENTRE))
        post = line((CENTRE, CENTRE), (CENTRE + side * math.cos(angle), CENTRE + side * math.sin(angle)))
        places = line(end, (CENTRE, CENTRE))
        right += _read(path, [bar, post], places, width, [1, 1, 1, 3], rng)
    return right


def _read(
    path: Path, strokes: list[Points], places: Points, width: float, ends: list[int], rng: np.random.Generator
) -> bool:
    """Whether strokes, turned by chance, have these degrees of junctions, and one near each place."""
    angle = rng.uniform(0, 2 * math.pi)
    strokes, places = [turned(stroke, angle) for stroke in strokes], turned(places, angle)
    points = np.concatenate(strokes)
    shift = 3 * width - points.min(axis=0)
    wide, high = np.ceil(np.ptp(points, axis=0) + 6 * width).astype(int)
    Image.fromarray(render([stroke + shift for stroke in strokes], width, (high, wide))).save(path)
    try:
        drawing, _ = trace(path, TracingConfig(), 50.0)
    except DrawingError:
        return False
    found = np.array([in_pixels(drawing, junction.point) for junction in drawing.junctions])
    off = np.linalg.norm(found[:, None] - (places + shift), axis=2).min(axis=0)
    return degrees(drawing) == ends and bool(off.max() < NEAR * width)


if __name__ == "__main__":
    main()
