"""How many random drawings become a whole build: `python -m tests.bench built [how many] [first seed]`.

All families of `families`, as SVG and PNG, 16 to 26 AWG, 25 to 150 mm; each is built in a process of its own
with a time limit. What is built is read again: the solid's validity in the report, the triangles' edges
counted here, each STL sliced where there is a slicer, no finding that is an error but those of the drawing.
"""

from __future__ import annotations

import collections
import json
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

from tests.bench.families import FAMILIES, lines_of, picture_of, svg_of

GAUGES = (16, 18, 20, 22, 24, 26)
SIZES_MM = (25, 150)
LIMIT_S = 900
SLICER = shutil.which("prusa-slicer")
# Errors that a sound build may name: a further jig that would hold too little, and a bend that the drawing
# has (the blobs of seed 0 turn in 0.03 mm) and wire doesn't take.
OF_THE_DRAWING = {"jig-left-out", "tight-bend"}
# A whole build's triangles take 50 bytes each behind a head of 84 in a binary STL.
_STL_HEAD, _FACET = 84, np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


def main(words: list[str] | None = None) -> None:
    """Builds so many random drawings (one of each family unless said), and says what became of them."""
    count, first = (*map(int, words or ()), *(len(FAMILIES), 0)[len(words or ()) :])
    outcomes: collections.Counter[str] = collections.Counter()
    with tempfile.TemporaryDirectory() as folder:
        for seed in range(first, first + count):
            config, what = drawn(Path(folder), seed)
            outcome = built(config, Path(folder) / f"out-{seed}")
            outcomes[outcome] += 1
            print(f"  {seed:3}  {what:35s} {outcome}", flush=True)
    for outcome, times in outcomes.most_common():
        print(f"{times:4} of {count}: {outcome}")
    print("Each STL was sliced." if SLICER else "There is no slicer here: no STL was sliced.")


def built(config: Path, folder: Path) -> str:
    """What becomes of a config: "built", what is wrong with what was built, or exit code and words."""
    command = [sys.executable, "-m", "wrapit", "build", str(config), "-o", str(folder), "-q"]
    try:
        run = subprocess.run(command, capture_output=True, text=True, timeout=LIMIT_S, check=False)
    except subprocess.TimeoutExpired:
        return f"not done in {LIMIT_S} s"
    if run.returncode:
        said = run.stderr.strip().splitlines()[-1:] or ["nothing"]
        return f"exit {run.returncode}: {_kind(said[0], config)}"
    return "; ".join(faults(folder)) or "built"


def faults(folder: Path) -> list[str]:
    """What is wrong with a build: solids that aren't valid, open triangles, findings that are errors."""
    report = json.loads((folder / "report.json").read_text())
    found = [] if report["jig"]["valid"] else ["the jig is not valid"]
    for path in sorted(folder.glob("*.stl")):
        count = open_edges(path)
        found += [f"{path.name} has {count} open edges"] if count else []
        found += [f"{path.name} is not sliced: {said}" for said in refusals(path)]
    wrong = {finding["code"] for finding in report["findings"] if finding["level"] == "error"}
    return found + [f"error {code}" for code in sorted(wrong - OF_THE_DRAWING)]


def refusals(path: Path) -> list[str]:
    """What the slicer says where it makes nothing of an STL, or repairs it."""
    if SLICER is None:
        return []
    with tempfile.TemporaryDirectory() as folder:
        made = Path(folder) / "jig.gcode"
        # A printer's bed as large as the jigs: size is no fault of the mesh.
        bed = "0x0,400x0,400x400,0x400"
        command = [SLICER, "--export-gcode", "--bed-shape", bed, "--output", str(made), str(path)]
        run = subprocess.run(command, capture_output=True, text=True, timeout=LIMIT_S, check=False)
        said = f"{run.stdout}\n{run.stderr}".strip().splitlines()
        if run.returncode or not made.exists() or not made.stat().st_size:
            return [said[-1] if said else "nothing said"]
        return [line for line in said if re.search("repair|open edge|non-manifold", line, re.IGNORECASE)]


def open_edges(path: Path) -> int:
    """Edges of a binary STL that aren't run through once each way; corners are told by their coordinates."""
    corners = np.frombuffer(path.read_bytes()[_STL_HEAD:], _FACET)["corners"].reshape(-1, 3)
    names = np.unique(corners, axis=0, return_inverse=True)[1].reshape(-1, 3).astype(np.int64)
    # Two corners that are one in four bytes leave a triangle without area, whose edges cancel.
    names = names[(names != np.roll(names, 1, axis=1)).all(axis=1)]
    ends = np.concatenate([names[:, [0, 1]], names[:, [1, 2]], names[:, [2, 0]]])
    balance: collections.Counter[tuple[int, int]] = collections.Counter()
    for a, b in ends.tolist():
        balance[min(a, b), max(a, b)] += 1 if a < b else -1
    return sum(times != 0 for times in balance.values())


def drawn(folder: Path, seed: int) -> tuple[Path, str]:
    """A config of one drawing at a random size and gauge, and what it is; families take turns."""
    rng = np.random.default_rng(seed)
    family = [*FAMILIES][seed % len(FAMILIES)]
    lines = lines_of(family, rng)
    drawing = folder / f"{family}-{seed}.{rng.choice(['svg', 'png'])}"
    if drawing.suffix == ".svg":
        drawing.write_text(svg_of(family, lines), encoding="utf-8")
    else:
        picture_of(family, lines).save(drawing)
    size, gauge = float(np.exp(rng.uniform(*np.log(SIZES_MM)))), int(rng.choice(GAUGES))
    config = drawing.with_suffix(".yaml")
    config.write_text(
        f"drawing: {drawing.name}\nsize: {size:.1f} mm\nwire: {{gauge: {gauge} AWG}}\n", encoding="utf-8"
    )
    return config, f"{drawing.name} {size:.0f} mm {gauge} AWG"


def _kind(said: str, config: Path) -> str:
    """The words of an error without numbers and the piece's name: those of a kind count together."""
    return re.sub(r"-?\d+(\.\d+)?", "N", said.removeprefix("error: ").replace(config.stem, "PIECE"))


if __name__ == "__main__":
    main(sys.argv[1:])
