"""How time and memory grow with a drawing: nets of 12 to 5000 segments, stage by stage.

Run as `python -m tests.bench.scale [most segments of a whole build]`; 200 unless told. Each drawing has a
process of its own, so that its peak of memory is its own. Seconds are of the processor, all processes
together: they hold on a busy machine too.
"""

from __future__ import annotations

import json
import math
import os
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

from tests.bench.large_drawings import drawing_text
from wrapit.config import load_config
from wrapit.errors import WrapItError
from wrapit.jig.printed.planning import plan_jigs
from wrapit.pipeline.stages import run_stages
from wrapit.pipeline.work import Work

SEGMENTS = (12, 50, 200, 1000, 5000)
WHOLE_UP_TO = 200
# The piece that the goals speak of: as large as a print bed takes, of thin wire.
SIZE_MM, GAUGE = 150, "24 AWG"
FLAT_STAGES = ("drawing", "decomposition", "wires")
STAGES = (*FLAT_STAGES, "jig plan", "jig", "exports")
IMPORTS = "import build123d, cadquery"

Row = dict[str, tuple[float, float]]


def measured(segments: int, *, whole: bool) -> tuple[Row, str]:
    """Seconds and peak memory (MB) of each stage in this process, and what stopped it, if anything did."""
    row: Row = {}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "net.json").write_text(drawing_text("cells", segments, SIZE_MM))
        config = folder / "net.yaml"
        config.write_text(f"drawing: net.json\nsize: {SIZE_MM} mm\nwire: {{gauge: {GAUGE}}}\n")
        clock = _Clock(row)
        work = Work(
            load_config(config, ()), folder / "net.json", "exports" if whole else "wires", clock.starts, 0
        )
        (folder / "out").mkdir()
        try:
            run_stages(work, folder / "out")
            if whole:
                clock.starts("jig plan")
                plan_jigs(work.wires, work.config.jig)
        except WrapItError as error:
            return row, f"stopped at {clock.stage}: {error.problem}"
        finally:
            clock.starts("")
    return row, ""


class _Clock:
    """What each stage takes, told when the next one starts."""

    def __init__(self, row: Row) -> None:
        self.row, self.stage, self.since_s = row, "", _processor_s()

    def starts(self, stage: str) -> None:
        now_s = _processor_s()
        if self.stage:
            self.row[self.stage] = (now_s - self.since_s, _peak_mb())
        self.stage, self.since_s = stage, now_s


def _processor_s() -> float:
    used = os.times()
    return used.user + used.system + used.children_user + used.children_system


def _peak_mb() -> float:
    kinds = (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)
    return max(resource.getrusage(kind).ru_maxrss for kind in kinds) / 1024


def exponent(seconds: dict[int, float]) -> float:
    """Slope of log time over log segments from 200 on, past what loading takes; nan of fewer than two."""
    counts = [count for count in seconds if count >= 200]
    if len(counts) < 2:
        return math.nan
    return float(np.polyfit(np.log(counts), np.log([max(seconds[count], 1e-3) for count in counts]), 1)[0])


def _row(segments: int, *, whole: bool) -> tuple[Row, str]:
    command = [sys.executable, "-m", "tests.bench.scale", "--row", str(segments), str(int(whole))]
    row, stopped = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
    return row, stopped


def main(arguments: list[str] | None = None) -> None:
    """Prints a row for each number of segments, then how each stage grows."""
    whole_up_to = int(arguments[0]) if arguments else WHOLE_UP_TO
    before = _processor_s()
    subprocess.run([sys.executable, "-c", IMPORTS], check=True)
    loading_s = _processor_s() - before
    print(f"{IMPORTS}: {loading_s:.1f} s; each cell is seconds / peak MB so far")
    print(f"{'segments':>8s}" + "".join(f"{stage:>15s}" for stage in STAGES) + f"{'× imports':>11s}")
    by_stage: dict[str, dict[int, float]] = {stage: {} for stage in STAGES}
    for segments in SEGMENTS:
        row, stopped = _row(segments, whole=segments <= whole_up_to)
        cells = [f"{row[stage][0]:.2f} / {row[stage][1]:.0f}" if stage in row else "-" for stage in STAGES]
        total_s = sum(seconds for stage, (seconds, _) in row.items() if stage != "jig plan")
        shares = "".join(f"{cell:>15s}" for cell in cells)
        print(f"{segments:8d}{shares}{total_s / loading_s:11.1f} {stopped}", flush=True)
        for stage, (seconds, _) in row.items():
            by_stage[stage][segments] = seconds
    print(f"{'exponent':>8s}" + "".join(f"{exponent(by_stage[stage]):15.2f}" for stage in STAGES))


if __name__ == "__main__":
    if sys.argv[1:2] == ["--row"]:
        print(json.dumps(measured(int(sys.argv[2]), whole=sys.argv[3] == "1")))
    else:
        main(sys.argv[1:])
