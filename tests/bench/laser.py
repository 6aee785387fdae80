"""The laser-cut jig on hard pieces: how many parts, how near the cuts, how long it takes."""

from __future__ import annotations

import tempfile
import time
from collections import Counter
from pathlib import Path

from tests.exports.pieces_for_tests import eye, hairpin, spiral, woven
from wrapit.config import JigConfig, PlateConfig, load_config
from wrapit.exports.flat_files import write_flat_files
from wrapit.jig.sheet.drawings import sheet_drawings
from wrapit.jig.sheet.stage import build_laser_jig
from wrapit.wires.model import Wire

CONFIGS = Path(__file__).parents[2] / "configs"
SETTINGS = ({}, {"kerf": 0.1, "sheet": 2.0}, {"kerf": 0.4, "sheet": 6.0, "wall_sheet": 10.0})
COLUMNS = "{:<12} {:>5} {:>5} {:>6} {:>5} {:>6} {:>7} {:>6} {:>6} {:>7} {:>6}  {}"


def main() -> None:
    """Print one line for each piece and setting."""
    heads = ("piece", "wires", "kerf", "sheet", "parts", "sheets", "closed", "near", "web", "cut", "s")
    print(COLUMNS.format(*heads, "findings"))
    pieces = {
        "eye": eye()[1],
        "hairpin": hairpin(),
        "spiral": spiral(),
        "woven": woven(4),
        "sixteen": woven(8),
        **{path.stem: _traced(path) for path in sorted(CONFIGS.glob("*.yaml"))},
    }
    for name, wires in pieces.items():
        for setting in SETTINGS:
            _line(name, wires, PlateConfig.model_construct(**{**PlateConfig().__dict__, **setting}))


def _traced(path: Path) -> tuple[Wire, ...]:
    from wrapit.decomposition.stage import decompose
    from wrapit.drawing.stage import trace
    from wrapit.wires.stage import draw_wires

    config = load_config(path)
    drawing, _ = trace(path.parent / config.drawing, config.tracing, config.size)
    return draw_wires(decompose(drawing, config.decomposition)[0], config)[0]


def _line(name: str, wires: tuple[Wire, ...], config: PlateConfig) -> None:
    start = time.perf_counter()
    laser, findings = build_laser_jig(tuple(wires), JigConfig(), config)
    with tempfile.TemporaryDirectory() as folder:
        for drawing in sheet_drawings(laser):
            write_flat_files(Path(folder), drawing, config, ("dxf", "svg"))
    seconds = time.perf_counter() - start
    checks = laser.checks
    codes = Counter(finding.code for finding in findings)
    print(
        COLUMNS.format(
            name,
            len(wires),
            config.kerf,
            config.sheet,
            len(laser.parts),
            len(laser.sheets),
            checks.closed_contours,
            f"{checks.min_cut_distance_mm:.2f}" if checks.min_cut_distance_mm else "-",
            f"{checks.min_web_mm:.2f}" if checks.min_web_mm else "-",
            f"{checks.cut_length_mm:.0f}",
            f"{seconds:.1f}",
            ", ".join(f"{code} × {count}" for code, count in sorted(codes.items())),
        ),
        flush=True,
    )


if __name__ == "__main__":
    main()
