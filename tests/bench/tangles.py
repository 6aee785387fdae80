"""Random smooth curves: how often a crossing is found with the right degree, by crossing angle."""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

import numpy as np
from PIL import Image
from scipy.optimize import linear_sum_assignment

from tests.bench.drawing import graph
from tests.drawing.generated import Crossing, crossings, random_curve, render, smallest_radius
from wrapit.config import TracingConfig
from wrapit.drawing.model import Drawing
from wrapit.drawing.stage import trace
from wrapit.errors import WrapItError

WIDTH_PX = 11.0
SIZE_PX = 800
BINS = ((8, 10), (10, 15), (15, 20), (20, 30), (30, 50), (50, 91))


def tangle(seed: int) -> tuple[np.ndarray, list[Crossing]] | None:
    """One or two random closed curves whose crossings are at least three stroke widths apart."""
    rng = np.random.default_rng(seed)
    for _ in range(300):
        curves = [random_curve(rng, SIZE_PX, int(rng.integers(3, 6))) for _ in range(int(rng.integers(1, 3)))]
        if min(smallest_radius(curve) for curve in curves) < 1.5 * WIDTH_PX:
            continue
        found = crossings(curves)
        if not 3 <= len(found) <= 25:
            continue
        places = np.array([crossing.at for crossing in found])
        apart = np.linalg.norm(places[:, None] - places[None], axis=2) + 1e9 * np.eye(len(found))
        if apart.min() > 3 * WIDTH_PX and min(crossing.angle_deg for crossing in found) > 8:
            return render(curves, WIDTH_PX, (SIZE_PX, SIZE_PX)), found
    return None


def acute(seed: int) -> tuple[np.ndarray, list[Crossing]] | None:
    """Two bent strokes that cross once, at 10 to 30 degrees."""
    rng = np.random.default_rng(seed)
    angle, base = np.radians(rng.uniform(10, 30)), rng.uniform(0, np.pi)
    centre = SIZE_PX / 2 + rng.uniform(-20, 20, 2)
    s = np.linspace(-330, 330, 200)
    curves = []
    for direction in (base - angle / 2, base + angle / 2):
        heading = direction + rng.uniform(-1, 1) / (12 * WIDTH_PX) * s
        points = np.cumsum(np.column_stack([np.cos(heading), np.sin(heading)]) * (s[1] - s[0]), axis=0)
        # Not at a sample, or the crossing would lie on a corner of both polylines.
        curves.append(points - (0.61 * points[100] + 0.39 * points[101]) + centre)
    found = crossings(curves)
    ends = [curve[k] for curve in curves for k in (0, -1)]
    apart = min(np.linalg.norm(ends[i] - ends[j]) for i in range(4) for j in range(i))
    inside = np.concatenate(curves).min() > 20 and np.concatenate(curves).max() < SIZE_PX - 20
    if len(found) != 1 or apart < 40 or not inside:
        return None
    return render(curves, WIDTH_PX, (SIZE_PX, SIZE_PX)), found


def main(count: int = 60) -> None:
    """Prints the share of crossings with the right degree for each range of angles."""
    for name, generate in (("random closed curves", tangle), ("two bent strokes", acute)):
        print(name)
        _measure([drawn for seed in range(count) if (drawn := generate(seed)) is not None])


def _measure(drawn: list[tuple[np.ndarray, list[Crossing]]]) -> None:
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
