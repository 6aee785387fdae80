"""Accuracy of tracing over the corpus of real drawings with known centre lines, and its speed.

Run as `python -m tests.bench.drawing [name …]`; the corpus is looked for in $WRAPIT_CORPUS and next to
the checkout.
"""

from __future__ import annotations

import importlib.util
import json
import os
import subprocess
import sys
import tempfile
import time
import warnings
from pathlib import Path
from typing import Any

import numpy as np

from tests.bench.peer import autotraced
from tests.drawing.generated import random_curve, render
from wrapit.config import TracingConfig
from wrapit.drawing.model import Drawing
from wrapit.drawing.stage import trace
from wrapit.errors import WrapItError

CORPUS = Path(os.environ.get("WRAPIT_CORPUS", Path(__file__).parents[3] / "shared" / "corpus"))
SIZE_MM = 60.0


def graph(drawing: Drawing, step_px: float = 0.5) -> dict[str, Any]:
    """The drawing in pixels again, as the corpus writes graphs."""
    frame = drawing.pixel_frame
    if frame is None:
        raise ValueError("the drawing was not traced from a bitmap")
    origin = np.array(frame.origin_mm)

    def pixels(points: np.ndarray[Any, Any]) -> list[list[float]]:
        return ((points - origin) / frame.mm_per_px * [1, -1]).tolist()

    return {
        "vertices": pixels(np.array([junction.point for junction in drawing.junctions])),
        "edges": [
            [segment.start, segment.end, pixels(segment.curve.sampled(step_px * frame.mm_per_px))]
            for segment in drawing.segments
        ],
    }


def evaluator(corpus: Path = CORPUS) -> Any:
    """The corpus's own `evaluate.py` as a module."""
    spec = importlib.util.spec_from_file_location("corpus_evaluate", corpus / "evaluate.py")
    if spec is None or spec.loader is None:
        raise FileNotFoundError(corpus / "evaluate.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def pictures(corpus: Path = CORPUS) -> list[tuple[str, Path, dict[str, Any], dict[str, Any]]]:
    """(kind, picture, truth, manifest entry) of each picture; kinds are clean, degraded, hard."""
    listed = json.loads((corpus / "dev" / "manifest.json").read_text())
    entries = listed if isinstance(listed, list) else listed.get("drawings", listed.get("items"))
    entries = (
        entries
        if isinstance(entries, list)
        else [e for v in listed.values() if isinstance(v, list) for e in v]
    )
    found = []
    for entry in sorted(entries, key=lambda entry: entry["name"]):
        name = entry["name"]
        truth = json.loads((corpus / "dev" / entry["truth"]).read_text())
        kind = "hard" if "hard" in entry["flags"] else "clean"
        found.append((kind, corpus / "dev" / entry["image"], truth, entry))
        for variant in sorted((corpus / "dev").glob(f"{name}@*")):
            found.append(("degraded", variant, truth, entry))
    return found


def skeleton_time_s(path: Path) -> float:
    """Seconds that thinning alone takes, the better of three."""
    from PIL import Image
    from skimage.morphology import skeletonize

    mask = np.asarray(Image.open(path).convert("L")) < 128
    times = []
    for _ in range(3):
        begin = time.process_time()
        skeletonize(mask)
        times.append(time.process_time() - begin)
    return min(times)


def measure(path: Path, truth: dict[str, Any], scorer: Any) -> dict[str, Any]:
    """Scores of one picture, with `beziers`, `time_ratio` and perhaps `refused`."""
    best, drawing = np.inf, None
    try:
        for _ in range(3):
            begin = time.process_time()
            drawing, _ = trace(path, TracingConfig(), SIZE_MM)
            best = min(best, time.process_time() - begin)
    except WrapItError as error:
        return {"refused": str(error)}
    assert drawing is not None
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)
        scores = scorer.evaluate(graph(drawing), truth)
    scores["beziers"] = sum(len(segment.curve) for segment in drawing.segments)
    scores["time_ratio"] = best / skeleton_time_s(path)
    scores["time_ms"] = best * 1e3
    return scores


COLUMNS = (
    ("exact", "topology_exact"), ("match", "topology_matched"), ("J", "junctions"), ("J*", "junctions_truth"),
    ("err sw", "junction_mean_error_sw"), ("deg", "junction_degree_correct"), ("mean", "mean_distance_sw"),
    ("haus", "hausdorff_sw"), ("tan50", "tangent_error_deg_median"), ("tan95", "tangent_error_deg_p95"),
    ("n", "beziers"), ("x", "time_ratio"), ("ms", "time_ms"),
)  # fmt: skip


def own_pictures() -> list[tuple[str, Path, dict[str, Any], dict[str, Any]]]:
    """Our own configs' bitmaps, with the SVG they were rendered from as truth."""
    from PIL import Image

    from wrapit.drawing.svg.planar import planar
    from wrapit.drawing.svg.strokes import read_strokes

    found = []
    for picture in sorted((Path(__file__).parents[2] / "configs").glob("*.png")):
        source = picture.with_suffix(".svg")
        if not source.exists():
            continue
        strokes = read_strokes(source, TracingConfig())
        width = strokes.width_px or 1.0
        drawn = planar(strokes.curves, width, TracingConfig().corner_angle)
        factor = Image.open(picture).width / _width_px(source)
        number = {node: index for index, node in enumerate(drawn.places)}
        truth = {
            "stroke_px": width * factor,
            "vertices": [(factor * point - 0.5).tolist() for point in drawn.places.values()],
            "edges": [
                [number[p.start], number[p.end], (factor * p.curve.sampled(0.5 / factor) - 0.5).tolist()]
                for p in drawn.pieces
            ],
        }
        found.append(("own", picture, truth, {"flags": []}))
    return found


def _width_px(source: Path) -> float:
    from svgelements import SVG

    return float(SVG.parse(str(source)).width)


def plain_beziers(path: Path) -> int:
    """Béziers of a plain Schneider fit through the smoothed skeleton, at the same tolerance."""
    from scipy.ndimage import gaussian_filter1d

    from wrapit.drawing.bitmap.picture import read_picture
    from wrapit.drawing.bitmap.skeleton import strand_graph_of
    from wrapit.geometry import unit
    from wrapit.geometry.fitting.fit import Stroke, fit_all

    skeleton = read_picture(path, TracingConfig()).skeleton
    net = strand_graph_of(skeleton.pixels, skeleton.pairs)
    strokes = []
    for strand in net.strands:
        points = net.path(strand)
        points = gaussian_filter1d(points, 0.35 * skeleton.width_px, axis=0, mode="nearest")
        reach = min(5, len(points) - 1)
        strokes.append(Stroke(points, unit(points[reach] - points[0]), unit(points[-1] - points[-1 - reach])))
    return sum(len(chain) for chain in fit_all(strokes, 0.04 * skeleton.width_px))


def peer_scores(path: Path, truth: dict[str, Any], scorer: Any) -> dict[str, Any] | None:
    """The same measures of `autotrace -centerline`; None where pyautotrace isn't installed."""
    begin = time.process_time()
    traced = autotraced(path, float(truth["stroke_px"]))
    if traced is None:
        return None
    taken_s = time.process_time() - begin
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)
        scores = dict(scorer.evaluate(traced[0], truth))
    return scores | {"beziers": traced[1], "time_ratio": taken_s / skeleton_time_s(path)}


# Linux keeps the peak of the parent in `ru_maxrss`; that of the process itself is in its status.
MEASURED = """
import re, sys
from pathlib import Path
from wrapit.config import TracingConfig
from wrapit.drawing.stage import trace
peaks = []
for picture in sys.argv[1:]:
    trace(Path(picture), TracingConfig(), 60.0)
    status = Path("/proc/self/status").read_text()
    peaks.append(int(re.search(r"VmHWM:\\s*(\\d+) kB", status)[1]))
print(1024 * (peaks[1] - peaks[0]))
"""


def print_memory(side_px: int = 5000) -> None:
    """Prints the peak memory that one large picture takes in a process of its own, per pixel."""
    if not Path("/proc/self/status").exists():
        print("peak memory is measured on Linux only")
        return
    from PIL import Image

    curve = random_curve(np.random.default_rng(3), 500)
    small = Image.fromarray(render([curve], 6.0, (500, 500)))
    large = small.resize((side_px, side_px), Image.Resampling.BICUBIC)
    shade = np.linspace(1.0, 0.5, side_px, dtype=np.float32)
    shaded = Image.fromarray((np.asarray(large) * shade).astype(np.uint8))
    kinds = {"grey": large, "shaded": shaded, "colour": large.convert("RGB"), "alpha": large.convert("RGBA")}
    with tempfile.TemporaryDirectory() as folder:
        small.save(Path(folder) / "small.png")
        for kind, picture in kinds.items():
            picture.save(Path(folder) / "large.png")
            command = [sys.executable, "-c", MEASURED, f"{folder}/small.png", f"{folder}/large.png"]
            done = subprocess.run(command, capture_output=True, text=True, check=True)
            print(f"peak memory, {kind:6} {int(done.stdout) / side_px**2:5.1f} bytes per pixel")


def lines_svg(count: int) -> str:
    """An SVG of thin lines from anywhere to anywhere, nearly a quarter of whose pairs cross."""
    ends = np.random.default_rng(1).uniform(0, 1000, (count, 4))
    drawn = "".join(f"M{a} {b}L{c} {d}" for a, b, c, d in ends)
    path = f'<path fill="none" stroke="black" stroke-width="0.2" d="{drawn}"/>'
    return f'<svg xmlns="http://www.w3.org/2000/svg" width="1000" height="1000">{path}</svg>'


def print_crossings(counts: tuple[int, ...] = (100, 200, 400, 800)) -> None:
    """Prints the time that SVGs of random lines take, whole and for each segment of the drawing."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "lines.svg"
        for count in counts:
            path.write_text(lines_svg(count))
            begin = time.process_time()
            drawing, _ = trace(path, TracingConfig(), SIZE_MM)
            taken_s = time.process_time() - begin
            print(
                f"SVG of {count:4} random lines: {len(drawing.segments):7,} segments in {taken_s:5.2f} s, "
                f"{1e6 * taken_s / len(drawing.segments):4.0f} µs each"
            )


def main(names: list[str] | None = None) -> None:
    """Prints one row per picture, a summary per kind, the memory of a large one, the time of crossings."""
    if not names:
        print_memory()
        print_crossings()
    if not (CORPUS / "evaluate.py").exists():
        print("the corpus of drawings is not here; set WRAPIT_CORPUS")
        return
    scorer = evaluator()
    print(f"{'':34}" + "".join(f"{title:>8}" for title, _ in COLUMNS))
    rows: dict[str, list[dict[str, Any]]] = {}
    peers: dict[str, list[dict[str, Any]]] = {}
    for kind, path, truth, entry in [*pictures(), *own_pictures()]:
        if names and not any(name in path.stem or name == kind for name in names):
            continue
        scores = measure(path, truth, scorer)
        scores["name"] = path.stem
        scores["sharp"] = any(flag.startswith("sharp") for flag in entry["flags"])
        rows.setdefault(kind, []).append(scores)
        if "refused" in scores:
            print(f"{path.stem:34} {scores['refused']}")
            continue
        print(f"{path.stem:34}" + "".join(f"{_cell(scores[key]):>8}" for _, key in COLUMNS))
        scores["plain"] = plain_beziers(path)
        if (peer := peer_scores(path, truth, scorer)) is not None:
            peers.setdefault(kind, []).append(peer | {key: scores[key] for key in ("sharp", "plain")})
    for kind, scores_of_kind in rows.items():
        print(_summary(kind, scores_of_kind))
    originals = {row["name"].split("@")[0] for row in rows.get("degraded", [])}
    same = [row for row in rows.get("clean", []) if row["name"] in originals]
    if same:
        print(_summary("originals", same) + " (the degraded ones before they were degraded)")
    print("\nthe peer, autotrace -centerline" if peers else "the peer is not here: pip install pyautotrace")
    for kind, scores_of_kind in peers.items():
        print(_summary(kind, scores_of_kind))


def _cell(value: Any) -> str:
    if value is None or isinstance(value, bool):
        return {None: "-", True: "yes", False: "NO"}[value]
    return f"{value:.3f}" if isinstance(value, float) and value < 10 else f"{value:.0f}"


def _summary(kind: str, rows: list[dict[str, Any]]) -> str:
    def column(key: str, sharp: bool = True) -> list[float]:
        return [float(row[key]) for row in rows if row.get(key) is not None and (sharp or not row["sharp"])]

    def share(key: str) -> float:
        return sum(column(key)) / len(rows)

    return (
        f"{kind:9} {len(rows):3}  exact {share('topology_exact'):.3f}  "
        f"matched {share('topology_matched'):.3f}  "
        f"junction median {np.median(column('junction_mean_error_sw')):.3f} sw  "
        f"mean {np.mean(column('mean_distance_sw')):.4f} sw  "
        f"Hausdorff {np.median(column('hausdorff_sw')):.3f} sw  "
        f"tangent {np.median(column('tangent_error_deg_median', False)):.2f}° "
        f"p95 {np.median(column('tangent_error_deg_p95', False)):.2f}°  "
        f"Béziers {sum(column('beziers')):.0f} of a plain fit's {sum(column('plain')):.0f}  "
        f"time {np.median(column('time_ratio')):.1f} × skeletonize"
    )


if __name__ == "__main__":
    main(sys.argv[1:])
