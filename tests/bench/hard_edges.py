"""Pictures with hard edges against their smooth twins: turning, Béziers and how far the lines lie apart.

Run as `python -m tests.bench hard_edges [name …]`. Twins are the cases' own pairs, the corpus thresholded
at half grey, and a few of its drawings rendered anew at 100 to 4000 px.

The smooth picture's lines are no truth: where an arc runs into another stroke they may be off by pixels, on
either side. So the corpus' own centre lines are asked too. A drawing is good if its graph is the twin's, its
turning and its Béziers are within the goals, and its worst point is either within the goal of the twin's
lines, or no farther from the true ones than the twin's worst point and the goal. Those within half a pixel of
the twin are counted beside.

The goal is half a pixel, or the fitting tolerance where that is more: 0.04 stroke widths, which are some
pixels in pictures from 2000 px on, where either twin's curves may leave its own points by as much.

Nor is the twin's graph the truth: where a true corner turns by hardly less than the config's corner angle,
the twin may have a node there. The graph of the true lines, with their corners, is as good.
"""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from tests.bench.cases import CASES
from tests.bench.drawing import CORPUS, SIZE_MM, pictures
from wrapit.config import TracingConfig
from wrapit.drawing.model import Drawing
from wrapit.drawing.stage import trace
from wrapit.errors import WrapItError

# At most so many times the smooth twin's turning and Béziers, and so many pixels off its lines, or the
# fitting tolerance if that is more.
GOALS = {"turning": 1.2, "beziers": 1.5, "off_px": 0.5}
WIDTHS_PX = (100, 200, 400, 1000, 2000, 4000)
# Rendered at every width: straight and round, a face, a plant, fine lines; more take minutes each.
AT_WIDTHS = ("lucide_gem", "openmoji_heart", "openmoji_fox", "tabler_cat")
Grey = NDArray[np.uint8]


def _png(grey: Grey, path: Path) -> Path:
    Image.fromarray(grey).save(path.with_suffix(".png"))
    return path.with_suffix(".png")


def _one_bit(grey: Grey, path: Path) -> Path:
    Image.fromarray(grey).convert("1", dither=Image.Dither.NONE).save(path.with_suffix(".png"))
    return path.with_suffix(".png")


def _jpeg(grey: Grey, path: Path) -> Path:
    Image.fromarray(grey).save(path.with_suffix(".jpg"), quality=85)
    return path.with_suffix(".jpg")


# Eight bits of two greys give the same drawing as one bit, in the whole corpus: one of them will do.
WRITERS: dict[str, Callable[[Grey, Path], Path]] = {"1-bit": _one_bit, "jpeg": _jpeg}


@dataclass(frozen=True)
class Twin:
    """How a hard-edged picture's drawing compares to the smooth one's."""

    name: str
    kind: str
    turning: float
    beziers: float
    off_px: float
    same_graph: bool
    # Half a pixel, or what fitting may leave out.
    goal_px: float
    # The worst points' distances to the true lines, of the hard picture and the smooth one, where known.
    true_px: tuple[float, float] | None = None

    @property
    def strict(self) -> bool:
        """Within half a pixel of the twin, whatever the fitting tolerance is."""
        return self.calm and self.off_px <= GOALS["off_px"]

    @property
    def good(self) -> bool:
        """Near to the twin, or hardly farther from the truth than that."""
        true = self.true_px is not None and self.true_px[0] <= self.true_px[1] + self.goal_px
        return self.calm and (self.off_px <= self.goal_px or true)

    @property
    def calm(self) -> bool:
        """The twin's graph, or the true one, without more waves and pieces than the goals allow."""
        return self.same_graph and all(getattr(self, key) <= GOALS[key] for key in ("turning", "beziers"))


def turning_deg(drawing: Drawing) -> float:
    """Sum of the absolute turning along all segments."""
    t = np.linspace(0, 1, 33)[:, None]
    whole = 0.0
    for segment in drawing.segments:
        d = np.diff(segment.curve.points, axis=1)
        along = (1 - t) ** 2 * d[:, None, 0] + 2 * t * (1 - t) * d[:, None, 1] + t * t * d[:, None, 2]
        along = along.reshape(-1, 2)
        along = along[np.linalg.norm(along, axis=1) > 1e-9]
        a, b = along[:-1], along[1:]
        cross, dot = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0], (a * b).sum(axis=1)
        whole += float(np.abs(np.degrees(np.arctan2(cross, dot))).sum())
    return whole


def points_px(drawing: Drawing) -> NDArray[Any]:
    """Points along all segments, in the pixels of the picture, a fifth of one apart."""
    frame = drawing.pixel_frame
    if frame is None:
        raise ValueError("the drawing was not traced from a bitmap")
    points = np.concatenate([segment.curve.sampled(0.2 * frame.mm_per_px) for segment in drawing.segments])
    return (points - frame.origin_mm) / frame.mm_per_px * [1, -1]


def degrees(drawing: Drawing) -> list[int]:
    """How many ends meet at each node, in order."""
    return sorted(len(ends) for ends in drawing.half_edges())


def beziers(drawing: Drawing) -> int:
    """How many Béziers its segments take."""
    return sum(len(segment.curve) for segment in drawing.segments)


def true_points_px(truth: dict[str, Any]) -> NDArray[Any]:
    """Points along the corpus' centre lines, a fifth of a pixel apart."""
    found = []
    for _, _, points in truth["edges"]:
        for a, b in pairwise(np.array(points, dtype=np.float64)):
            steps = np.linspace(0, 1, max(2, int(np.hypot(*(b - a)) / 0.2) + 2))
            found.append(a + steps[:, None] * (b - a))
    return np.concatenate(found)


def apart_px(a: NDArray[Any], b: NDArray[Any]) -> float:
    """Hausdorff distance of two sets of points (n, 2)."""
    from scipy.spatial import cKDTree

    return float(max(cKDTree(b).query(a)[0].max(), cKDTree(a).query(b)[0].max()))


def true_degrees(truth: dict[str, Any]) -> list[int]:
    """The degrees of the corpus' graph, with a node at each true corner that the config calls one."""
    count: dict[int, int] = {}
    corners = 0
    for start, end, points in truth["edges"]:
        for node in (start, end):
            count[node] = count.get(node, 0) + 1
        steps = np.diff(np.array(points, dtype=np.float64), axis=0)
        steps = steps[np.linalg.norm(steps, axis=1) > 1e-9]
        a, b = steps[:-1], steps[1:]
        turned = np.arctan2(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0], (a * b).sum(axis=1))
        corners += int(np.count_nonzero(np.abs(turned) > TracingConfig().corner_angle))
    return sorted([*count.values(), *[2] * corners])


def goal_px(drawing: Drawing) -> float:
    """How far off a drawing's curves may be: half a pixel, or the fitting tolerance where that is more."""
    frame, width_mm = drawing.pixel_frame, drawing.stroke_width_mm
    if frame is None or width_mm is None:
        raise ValueError("the drawing was not traced from a bitmap")
    return max(GOALS["off_px"], TracingConfig().tolerance * width_mm / frame.mm_per_px)


def compared(
    name: str, kind: str, hard: Drawing, smooth: Drawing, true: dict[str, Any] | None = None
) -> Twin:
    a, b = points_px(hard), points_px(smooth)
    truth = None if true is None else true_points_px(true)
    graphs = [degrees(smooth)] + ([] if true is None else [true_degrees(true)])
    return Twin(
        name,
        kind,
        turning_deg(hard) / max(turning_deg(smooth), 1.0),
        beziers(hard) / beziers(smooth),
        apart_px(a, b),
        degrees(hard) in graphs,
        goal_px(smooth),
        None if truth is None else (apart_px(a, truth), apart_px(b, truth)),
    )


def traced(path: Path) -> Drawing:
    """The drawing as a config without settings has it traced."""
    return trace(path, TracingConfig(), SIZE_MM)[0]


def grey_pictures(names: list[str]) -> Iterator[tuple[str, str, Grey, dict[str, Any] | None]]:
    """(name, kind, smooth picture, true graph) of the corpus, and of a few drawings at all widths."""
    for kind, path, truth, _ in pictures() if (CORPUS / "evaluate.py").exists() else []:
        if kind == "clean" and (not names or path.stem in names):
            yield path.stem, "corpus", np.asarray(Image.open(path).convert("L")), truth
    try:
        import resvg_py as _  # noqa: F401

        from tests.drawing.svg.ink import rendered
    except ImportError:
        print("no pictures at other widths: pip install resvg_py")
        return
    for name in names or AT_WIDTHS:
        source = CORPUS / "dev" / f"{name}.svg"
        for width in WIDTHS_PX if source.exists() else ():
            yield name, f"{width} px", rendered(source, width)[0], None


def twins(names: list[str]) -> Iterator[Twin | str]:
    """Each pair of pictures compared, or why it can't be."""
    for hard in sorted((CASES / "photo").glob("hard-edged-*.png")):
        smooth = hard.with_name(f"smooth-{hard.stem.removeprefix('hard-edged-').removesuffix('bw')}aa.png")
        if smooth.exists() and not names:
            yield compared(hard.stem, "cases", traced(hard), traced(smooth))
    with tempfile.TemporaryDirectory() as folder:
        for name, kind, grey, truth in grey_pictures(names):
            try:
                smooth_drawing = traced(_png(grey, Path(folder) / "smooth"))
            except WrapItError as error:
                yield f"{name:28} {kind:16} smooth refused: {error.problem}"
                continue
            edged = np.where(grey < 128, 0, 255).astype(np.uint8)
            for said, write in WRITERS.items():
                try:
                    hard_drawing = traced(write(edged, Path(folder) / said))
                    yield compared(name, f"{kind}, {said}", hard_drawing, smooth_drawing, truth)
                except WrapItError as error:
                    yield f"{name:28} {kind + ', ' + said:16} refused: {error.problem}"


def main(names: list[str] | None = None) -> None:
    """Prints one row a pair and a summary a kind, with the goals beside."""
    if not CORPUS.exists() and not CASES.exists():
        print("neither the corpus of drawings nor the cases are here; set WRAPIT_CORPUS and WRAPIT_CASES")
        return
    print(f"{'':28} {'':16} {'turning':>8} {'Béziers':>8} {'off px':>8} {'true px':>8} {'smooth':>8}  graph")
    rows: dict[str, list[Twin]] = {}
    refused = 0
    for twin in twins(names or []):
        if isinstance(twin, str):
            refused += 1
            print(twin)
            continue
        rows.setdefault(twin.kind, []).append(twin)
        true = " ".join(f"{px:8.2f}" for px in twin.true_px) if twin.true_px else f"{'-':>8} {'-':>8}"
        figures = f"{twin.turning:8.2f} {twin.beziers:8.2f} {twin.off_px:8.2f} {true}"
        told = f"{'same' if twin.same_graph else 'OTHER'}{'  good' if twin.good else ''}"
        print(f"{twin.name:28} {twin.kind:16} {figures}  {told}", flush=True)
    for kind, found in rows.items():
        middles = "  ".join(
            f"{key} median {np.median([getattr(t, key) for t in found]):.2f} "
            f"worst {max(getattr(t, key) for t in found):.2f} (goal {goal})"
            for key, goal in GOALS.items()
        )
        strict = f"({sum(t.strict for t in found)} near the twin)"
        print(f"{kind:16} {sum(t.good for t in found)} of {len(found)} good {strict}  {middles}")
    print(f"refused: {refused}")


if __name__ == "__main__":
    main(sys.argv[1:])
