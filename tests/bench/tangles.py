"""Random smooth curves: how often a crossing is found with the right degree, by crossing angle.

Three sets with exactly known graphs: closed curves as they come; closed curves chosen for a crossing at
10 to 20 degrees, until both halves of that range hold enough; two bent strokes that cross at an angle
that is set, clean and as a poor scan.
"""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from PIL import Image
from scipy.ndimage import gaussian_filter
from scipy.optimize import linear_sum_assignment

from tests.bench.drawing import graph
from tests.drawing.generated import Crossing, Points, crossings, random_curve, render, smallest_radius
from wrapit.config import TracingConfig
from wrapit.drawing.model import Drawing
from wrapit.drawing.stage import trace
from wrapit.errors import WrapItError

WIDTH_PX = 11.0
SIZE_PX = 800
BINS = ((8, 10), (10, 15), (15, 20), (20, 30), (30, 50), (50, 91))
SHALLOW = ((10, 15), (15, 20))
Drawn = tuple[np.ndarray, list[Crossing]]


def tangles(shallow: bool) -> Iterator[Drawn]:
    """Random closed curves whose crossings are at least three stroke widths apart, over 8 degrees.

    `shallow` chooses those with a crossing at 10 to 20 degrees.
    """
    rng = np.random.default_rng(20)
    while True:
        curves = [_round_curve(rng) for _ in range(int(rng.integers(1, 3)))]
        if shallow and not _hardly_turned(crossings([curve[::8] for curve in curves])):
            continue
        found = crossings(curves)
        if not 3 <= len(found) <= 25 or min(crossing.angle_deg for crossing in found) < 8:
            continue
        if shallow and not any(10 <= crossing.angle_deg < 20 for crossing in found):
            continue
        if _nearest([crossing.at for crossing in found]) > 3 * WIDTH_PX:
            yield render(curves, WIDTH_PX, (SIZE_PX, SIZE_PX)), found


def _round_curve(rng: np.random.Generator) -> Points:
    while True:
        curve = random_curve(rng, SIZE_PX, int(rng.integers(3, 6)))
        if smallest_radius(curve[::4]) > 1.4 * WIDTH_PX and smallest_radius(curve) > 1.5 * WIDTH_PX:
            return curve


def _hardly_turned(rough: list[Crossing]) -> bool:
    return 3 <= len(rough) <= 25 and 5 < min(crossing.angle_deg for crossing in rough) < 24


def bent_strokes(rng: np.random.Generator, angle_rad: float) -> Drawn:
    """Two bent strokes that cross at an angle in the middle, and perhaps once more beside it."""
    s = np.linspace(-330, 330, 400)
    while True:
        base, centre = rng.uniform(0, np.pi), SIZE_PX / 2 + rng.uniform(-20, 20, 2)
        curves = [_bent(rng, s, base + half) + centre for half in (-angle_rad / 2, angle_rad / 2)]
        found, points = crossings(curves), np.concatenate(curves)
        if not 1 <= len(found) <= 2 or points.min() < 20 or points.max() > SIZE_PX - 20:
            continue
        tips = [(curves[1 - k], curves[k][end]) for k in (0, 1) for end in (0, -1)]
        if min(np.linalg.norm(other - tip, axis=1).min() for other, tip in tips) < 3 * WIDTH_PX:
            continue
        if min(c.angle_deg for c in found) > 8 and _nearest([c.at for c in found]) > 3 * WIDTH_PX:
            return render(curves, WIDTH_PX, (SIZE_PX, SIZE_PX)), found


def _bent(rng: np.random.Generator, s: Points, direction: float) -> Points:
    """A stroke around the origin whose curvature is a random constant and a random wave."""
    wave = np.cos(s / rng.uniform(60, 140) + rng.uniform(0, 2 * np.pi))
    curvature = rng.uniform(-1, 1) / (20 * WIDTH_PX) + rng.uniform(-1, 1) / (30 * WIDTH_PX) * wave
    heading = np.cumsum(curvature) * (s[1] - s[0])
    heading += direction - heading[200]
    points = np.cumsum(np.column_stack([np.cos(heading), np.sin(heading)]) * (s[1] - s[0]), axis=0)
    # Not at a sample, or the crossing would lie on a corner of both polylines.
    return points - (0.61 * points[200] + 0.39 * points[201])


def _nearest(places: list[Points]) -> float:
    points = np.array(places)
    apart = np.linalg.norm(points[:, None] - points[None], axis=2) + 1e9 * np.eye(len(points))
    return float(apart.min())


def scanned(rng: np.random.Generator, grey: np.ndarray) -> np.ndarray:
    """The picture out of focus and with noise."""
    soft = gaussian_filter(grey.astype(np.float64), 1.5) + rng.normal(scale=12, size=grey.shape)
    return np.clip(soft, 0, 255).astype(np.uint8)


def main(words: list[str] | None = None) -> None:
    """Prints the share of crossings with the right degree by angle; of 40 drawings, or as many as asked."""
    count = int(words[0]) if words else 40
    print("random closed curves")
    usual = tangles(shallow=False)
    _measure([next(usual) for _ in range(count)])
    print(f"random closed curves with a shallow crossing, {count} or more of each")
    _measure(_enough(tangles(shallow=True), count))
    rng = np.random.default_rng(7)
    bent = [
        bent_strokes(rng, np.radians(rng.uniform(*angles)))
        for angles in (*SHALLOW, (20, 30))
        for _ in range(count)
    ]
    print("two bent strokes")
    _measure(bent)
    print("two bent strokes, blurred and noisy")
    _measure([(scanned(rng, grey), truth) for grey, truth in bent])


def _enough(drawn: Iterator[Drawn], count: int) -> list[Drawn]:
    kept: list[Drawn] = []
    while True:
        angles = [crossing.angle_deg for _, truth in kept for crossing in truth]
        if all(sum(low <= angle < high for angle in angles) >= count for low, high in SHALLOW):
            return kept
        kept.append(next(drawn))


def _measure(drawn: list[Drawn]) -> None:
    right: dict[tuple[int, int], list[bool]] = {bin_: [] for bin_ in BINS}
    errors, exact, extra, total = [], [], 0, 0
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "drawing.png"
        for grey, truth in drawn:
            Image.fromarray(grey).save(path)
            try:
                drawing, _ = trace(path, TracingConfig(), 60.0)
            except WrapItError as error:
                print(error)
                exact.append(False)
                continue
            good, places = _found(drawing, truth, errors)
            for crossing, hit in zip(truth, good, strict=True):
                for low, high in BINS:
                    if low <= crossing.angle_deg < high:
                        right[low, high].append(hit)
            extra += max(0, places - len(truth))
            total += places
            exact.append(places == len(truth) and all(good))
    for bin_, results in right.items():
        if results:
            print(f"  {bin_[0]:3}–{bin_[1]}°: degree right for {np.mean(results):.3f} of {len(results)}")
    print(
        f"  exact drawings {np.mean(exact):.3f} of {len(exact)}, junctions too many {extra} of {total}, ",
        end="",
    )
    print(f"error median {np.median(errors):.3f} p95 {np.percentile(errors, 95):.3f} sw")


def _found(drawing: Drawing, truth: list[Crossing], errors: list[float]) -> tuple[list[bool], int]:
    degree = np.array([len(ends) for ends in drawing.half_edges()])
    places = np.array(graph(drawing)["vertices"])[degree > 2].reshape(-1, 2)
    degree = degree[degree > 2]
    wanted = np.array([crossing.at for crossing in truth])
    apart = np.linalg.norm(wanted[:, None] - places[None], axis=2)
    rows, columns = linear_sum_assignment(np.minimum(apart, 1e3))
    good = [False] * len(truth)
    for r, c in zip(rows.tolist(), columns.tolist(), strict=True):
        if apart[r, c] < 1.5 * WIDTH_PX and degree[c] == 4:
            good[r] = True
            errors.append(float(apart[r, c]) / WIDTH_PX)
    return good, len(places)


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
