"""How long making a drawing fit takes, by its number of segments.

Run as `python -m tests.bench fit_speed [numbers]`: two crayfish side by side (130 segments, 75 mm), generated
nets (150, 200 and 300 segments, or those named) at 60 and 150 mm with 18 AWG and `fit: bold`, and public
clipart (a folder named in $WRAPIT_CLIPART) at 40 and 50 mm. The first runs twice: what is loaded late counts
at first. CPU time of all threads, of `make_fit` alone.
"""

from __future__ import annotations

import os
import time
from collections.abc import Iterator, Sequence
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory

from tests.bench.large_drawings import drawing_text
from wrapit.config import Config
from wrapit.drawing.stage import trace
from wrapit.errors import WrapItError
from wrapit.fit.stage import make_fit

# Kinds of nets, and sizes: at the smaller nearly everything is too near to something.
NETS = ("cells", "triangles", "grid", "spiral")
NET_SIZES_MM, CLIPART_SIZES_MM = (60, 150), (40, 50)
NUMBERS = ("150", "200", "300")
CONFIGS = Path(__file__).parents[2] / "configs"
# Clipart is grouped by so many segments.
GROUP = 20


def main(words: Sequence[str]) -> None:
    """A line for each drawing, and a table of medians and the slowest."""
    seconds: dict[str, list[float]] = {}
    with TemporaryDirectory() as folder:
        crayfish = _two_crayfish(Path(folder))
        rows = (crayfish, crayfish, *_clipart(), *_nets(Path(folder), words or NUMBERS))
        for group, config in rows:
            try:
                drawing, _ = trace(Path(config.drawing), config.tracing, config.size)
            except WrapItError as error:
                print(f"{Path(config.drawing).name} {config.size:.0f} mm: {error}", flush=True)
                continue
            began = time.process_time()
            fitted, _ = make_fit(drawing, config)
            took = time.process_time() - began
            count = len(drawing.segments)
            name = group or f"clipart of {count // GROUP * GROUP:3d} to {count // GROUP * GROUP + GROUP - 1}"
            seconds.setdefault(name, []).append(took)
            print(
                f"{Path(config.drawing).stem:20s} {config.size:4.0f} mm  segments {count:3d} →"
                f" {fitted.after.segments:3d} {took:7.2f} s",
                flush=True,
            )
    print(f"\n{'':32s}    n  median  slowest")
    for name, each in sorted(seconds.items()):
        print(f"{name:32s} {len(each):4d} {median(each):7.2f} {max(each):8.2f} s")


def _two_crayfish(folder: Path) -> tuple[str, Config]:
    """The crayfish twice, 100 of its 120 mm apart: claws cross, so that it is one piece."""
    drawing = (CONFIGS / "crayfish.svg").read_text()
    strokes = drawing[drawing.index("<g ") : drawing.index("</svg>")]
    path = folder / "two-crayfish.svg"
    path.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" width="220mm" height="164mm" viewBox="0 0 220 164">'
        f'{strokes}<g transform="translate(100 0)">{strokes}</g></svg>'
    )
    return "two crayfish", _config(path, 75, {})


def _clipart() -> Iterator[tuple[str, Config]]:
    if "WRAPIT_CLIPART" not in os.environ:
        print("no clipart here; set WRAPIT_CLIPART")
        return
    for path in sorted(Path(os.environ["WRAPIT_CLIPART"]).glob("*.svg")):
        for size_mm in CLIPART_SIZES_MM:
            yield "", _config(path, size_mm, {"components": "join"})


def _nets(folder: Path, numbers: Sequence[str]) -> Iterator[tuple[str, Config]]:
    for number in numbers:
        for size_mm in NET_SIZES_MM:
            for kind in NETS:
                path = folder / f"{kind}-{number}.json"
                path.write_text(drawing_text(kind, int(number), size_mm))
                yield f"nets of {number} at {size_mm} mm", _config(path, size_mm, {})


def _config(path: Path, size_mm: float, tracing: dict[str, str]) -> Config:
    return Config.model_validate(
        {
            "drawing": str(path),
            "size": f"{size_mm} mm",
            "wire": {"gauge": "18 AWG"},
            "fit": "bold",
            "tracing": tracing,
        }
    )
