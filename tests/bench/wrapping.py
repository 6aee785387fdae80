"""Jigs as things to wrap on: walls by the paper's rule (`turns`) beside walls by need (`taut`).

Each piece twice: wall area, share of wire that is hemmed in, how far the taut wires lie off; the means at the
end. Our drawings as their configs say, those of the corpus at 50 mm with 18 AWG. WRAPIT_BENCH_SPLIT chooses
`jig.split`. With words (names of pieces), those alone, and the slicer's print times where it is installed.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import tempfile
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from tests.bench.drawing import CORPUS, pictures
from wrapit.config import Config, load_config
from wrapit.decomposition.stage import decompose
from wrapit.drawing.stage import trace
from wrapit.errors import WrapItError
from wrapit.jig.printed.planning import plan_jigs
from wrapit.pipeline.build import build
from wrapit.wires.stage import draw_wires

RULES = ("turns", "taut")
SPLIT = os.environ.get("WRAPIT_BENCH_SPLIT", "auto")
CONFIGS = Path(__file__).parents[2] / "configs"


def main(words: Sequence[str]) -> None:
    """A line for each piece and rule, and the means over the corpus."""
    sums: dict[str, list[tuple[float, ...]]] = {rule: [] for rule in RULES}
    for name, config in _pieces():
        if words and name not in words:
            continue
        for rule in RULES:
            found = _measured(name, config, rule)
            if found is not None and not name.endswith(".yaml"):
                sums[rule].append(found)
        if words:
            _printed(name, config)
    for rule, rows in sums.items():
        if rows:
            print(f"mean of {len(rows)} of the corpus, {rule:6s}{_words(tuple(np.mean(rows, axis=0)))}")


def _pieces() -> Iterator[tuple[str, Config]]:
    for path in sorted(CONFIGS.glob("*.yaml")):
        loaded = load_config(path)
        yield path.name, loaded.model_copy(update={"drawing": str(path.parent / loaded.drawing)})
    if not (CORPUS / "dev").is_dir():
        print("the corpus of drawings is not here; set WRAPIT_CORPUS")
        return
    for kind, picture, _, _ in pictures():
        if kind == "clean":
            settings = {"drawing": str(picture), "size": "50 mm", "wire": {"gauge": "18 AWG"}}
            yield picture.stem, Config.model_validate(settings)


def _measured(name: str, config: Config, rule: str) -> tuple[float, ...] | None:
    config = config.model_copy(
        update={"jig": config.jig.model_copy(update={"support": rule, "split": SPLIT})}
    )
    try:
        drawing, _ = trace(Path(config.drawing), config.tracing, config.size)
        solution, _ = decompose(drawing, config.decomposition)
        wires, _ = draw_wires(solution, config)
        planned, _ = plan_jigs(wires, config.jig)
    except WrapItError as error:
        print(f"{name:28s} {rule:6s} exit {error.exit_code}: {error}", flush=True)
        return None
    off_mm = np.concatenate([course.off_mm for jig in planned.jigs for course in jig.plan.laid])
    lengths = [sum(float(course.at_mm[-1]) for course in jig.plan.laid) for jig in planned.jigs]
    hemmed = float(np.average([jig.hemmed for jig in planned.jigs], weights=lengths))
    area = sum(wall.outline.area for jig in planned.jigs for wall in jig.plan.walls)
    row = (len(planned.jigs), hemmed, area, float(np.quantile(off_mm, 0.95)), float((off_mm > 0.5).mean()))
    print(f"{name:28s} {rule:6s}{_words(row)}", flush=True)
    return row


def _words(row: tuple[float, ...]) -> str:
    jigs, hemmed, area, p95, share = row
    held = f"hemmed {hemmed:.3f}  walls {area:5.0f} mm²  p95 {p95:.2f} mm  over .5: {share:.3f}"
    return f" jigs {jigs:4.1f}  {held}"


def _printed(name: str, config: Config) -> None:
    """The slicer's estimate for the printed jig of each rule, with its own defaults."""
    slicer = shutil.which("prusa-slicer")
    if slicer is None:
        print("no prusa-slicer here, so no print times")
        return
    for rule in RULES:
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "piece.yaml"
            path.write_text(
                f"drawing: {Path(config.drawing).resolve()}\nsize: {config.size} mm\n"
                f"wire: {{gauge: {config.wire.gauge} mm}}\njig: {{support: {rule}}}\noutputs: [stl]\n"
            )
            build(path, Path(folder) / "out")
            for stl in sorted((Path(folder) / "out").glob("*.stl")):
                gcode = stl.with_suffix(".gcode")
                subprocess.run([slicer, "-g", stl, "-o", gcode], check=True, capture_output=True)
                lines = gcode.read_text().splitlines()
                told = [
                    line
                    for line in lines
                    if line.startswith(("; estimated printing time (n", "; filament used [cm3"))
                ]
                print(f"{name:28s} {rule:6s} {stl.name}: {'; '.join(line[2:] for line in told)}", flush=True)
