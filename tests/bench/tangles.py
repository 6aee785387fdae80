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
from wrapit.drawing.stage import trace
from wrapit.errors import WrapItError

WIDTH_PX = 11.0
SIZE_PX = 800
BINS = ((10, 15), (15, 20), (20, 30), (30, 50), (50, 91))


def picture(seed: int) -> tuple[np.ndarray, list[Crossing]]:
    """A drawing of one or two random curves whose crossings are at least three stroke widths apart."""
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
    raise ValueError(f"no drawing for seed {seed}")


def main(count: int = 40) -> None:
    """Prints the share of crossings with the right degree for each range of angles."""
    right: dict[tuple[int, int], list[bool]] = {bin_: [] for bin_ in BINS}
    errors, exact, extra, total = [], [], 0, 0
    with tempfile.TemporaryDirectory() as folder:
        for seed in range(count):
            grey, truth = picture(seed)
            path = Path(folder) / f"{seed}.png"
            Image.fromarray(grey).save(path)
            try:
                drawing, _ = trace(path, TracingConfig(), 60.0)
            except WrapItError as error:
                print(seed, error)
                continue
            degree = np.array([len(ends) for ends in drawing.half_edges()])
            places = np.array(graph(drawing)["vertices"])[degree > 2]
            degree = degree[degree > 2]
            wanted = np.array([crossing.at for crossing in truth])
            apart = np.linalg.norm(wanted[:, None] - places[None], axis=2)
            rows, columns = linear_sum_assignment(np.minimum(apart, 1e3))
            hit = {int(r): int(c) for r, c in zip(rows, columns, strict=True) if apart[r, c] < 1.5 * WIDTH_PX}
            bad = []
            for k, crossing in enumerate(truth):
                good = k in hit and degree[hit[k]] == 4
                if good:
                    errors.append(apart[k, hit[k]] / WIDTH_PX)
                else:
                    bad.append(f"({crossing.at[0]:.0f},{crossing.at[1]:.0f}) {crossing.angle_deg:.0f}°")
                for bin_ in BINS:
                    if bin_[0] <= crossing.angle_deg < bin_[1]:
                        right[bin_].append(good)
            extra += len(places) - len(hit)
            total += len(places)
            exact.append(len(places) == len(truth) and not bad)
            if bad or len(places) != len(truth):
                print(f"{seed:3} {len(truth)} crossings, {len(places)} junctions; wrong: {', '.join(bad)}")
    for bin_, results in right.items():
        print(f"{bin_[0]:3}–{bin_[1]}°: {np.mean(results) if results else 0:.3f} of {len(results)}")
    print(f"exact drawings {np.mean(exact):.3f}, junctions too many {extra} of {total}, ", end="")
    print(f"error median {np.median(errors):.3f} p95 {np.percentile(errors, 95):.3f} sw")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
