"""Small pictures: the corpus rendered 100 to 400 px wide, against its reading at the full size.

Run as `python -m tests.bench thin [name …]`. Printed for each width: how many graphs are those of the full
size, how often the curves turn and how many Béziers they take in multiples of those, and how far the lines
are off the true ones, in pixels of the small picture.
"""

from __future__ import annotations

import tempfile
from pathlib import Path

import numpy as np
from PIL import Image
from scipy.spatial import cKDTree

from tests.bench.drawing import CORPUS, pictures
from tests.bench.hard_edges import beziers, degrees, points_px, traced, true_points_px, turning_deg
from wrapit.drawing.model import Drawing
from wrapit.errors import DrawingError

WIDTHS_PX = (100, 150, 200, 300, 400)
# Drawings that hardly turn have no multiple worth printing.
LEAST_TURNING_DEG = 30.0


def main(names: list[str] | None = None) -> None:
    """Prints one row a width."""
    try:
        import resvg_py as _  # noqa: F401
    except ImportError:
        print("no small pictures: pip install resvg_py")
        return
    drawn = [
        (path, traced(path), truth)
        for kind, path, truth, _ in (pictures() if (CORPUS / "evaluate.py").exists() else [])
        if kind == "clean" and (not names or path.stem in names)
    ]
    if not drawn:
        print("no corpus here: set WRAPIT_CORPUS")
        return
    for width_px in WIDTHS_PX:
        print(f"{width_px:4d} px  " + _row(width_px, drawn), flush=True)


def _row(width_px: int, drawn: list[tuple[Path, Drawing, dict[str, object]]]) -> str:
    from tests.drawing.svg.ink import rendered

    graphs, refused, multiples, off_px = 0, 0, [], []
    with tempfile.TemporaryDirectory() as folder:
        for path, full, truth in drawn:
            grey = rendered(CORPUS / "dev" / f"{path.stem}.svg", width_px)[0]
            Image.fromarray(grey).save(small := Path(folder) / "small.png")
            try:
                found = traced(small)
            except DrawingError:
                refused += 1
                continue
            graphs += degrees(found) == degrees(full)
            if turning_deg(full) > LEAST_TURNING_DEG:
                multiples.append((turning_deg(found) / turning_deg(full), beziers(found) / beziers(full)))
            # The centre of the first pixel is (0, 0), whatever its size.
            scale = grey.shape[1] / Image.open(path).width
            true = (true_points_px(truth) + 0.5) * scale - 0.5
            off_px.append(cKDTree(true).query(points_px(found))[0].mean())
    turning, pieces = np.array(multiples).T
    return (
        f"graph {graphs} of {len(drawn)}, {refused} refused  turning median {np.median(turning):.2f}"
        f" p90 {np.percentile(turning, 90):.2f} worst {turning.max():.2f}  beziers median"
        f" {np.median(pieces):.2f} worst {pieces.max():.2f}  off median {np.median(off_px):.2f} px"
    )
