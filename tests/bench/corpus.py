"""Every clean drawing of the corpus as a piece: three sizes, two gauges, from drawing to checked jig.

One line per build: whether the jig is valid, its turn support, the smallest distance of wall and wire, and
warnings; or the reason why there is none. WRAPIT_BENCH_SIZES and WRAPIT_BENCH_GAUGES choose others.
"""

from __future__ import annotations

import os
import tempfile
from collections import Counter
from pathlib import Path

from tests.bench.drawing import CORPUS, pictures
from wrapit.errors import WrapItError
from wrapit.pipeline.build import check

SIZES = os.environ.get("WRAPIT_BENCH_SIZES", "40 mm,60 mm,100 mm").split(",")
GAUGES = os.environ.get("WRAPIT_BENCH_GAUGES", "18 AWG,22 AWG").split(",")
NAMES = os.environ.get("WRAPIT_BENCH_DRAWINGS", "").split()


def main() -> None:
    if not (CORPUS / "dev").is_dir():
        print("the corpus of drawings is not here; set WRAPIT_CORPUS")
        return
    ends: Counter[str] = Counter()
    supports: list[float] = []
    for kind, picture, _, _ in pictures():
        if kind != "clean" or (NAMES and picture.stem not in NAMES):
            continue
        for size in SIZES:
            for gauge in GAUGES:
                end, support = _built(picture, size, gauge)
                ends[end] += 1
                supports += [support] if support is not None else []
    print(
        dict(ends),
        f"turn support: lowest {min(supports):.3f},",
        f"below .9: {sum(s < 0.9 for s in supports)}",
    )


def _built(picture: Path, size: str, gauge: str) -> tuple[str, float | None]:
    with tempfile.TemporaryDirectory() as folder:
        config = Path(folder) / "piece.yaml"
        config.write_text(f"drawing: {picture}\nsize: {size}\nwire: {{gauge: {gauge}}}\n")
        label = f"{picture.stem:28s} {size:>6} {gauge}"
        try:
            built = check(config)
        except WrapItError as error:
            print(f"{label} exit {error.exit_code}: {error}", flush=True)
            return f"exit {error.exit_code}", None
    jig = built.report["jig"]
    codes = Counter(f["code"] for f in built.report["findings"] if f["level"] != "note")
    print(
        f"{label} {len(built.report['wires']):2d} wires {jig['jigs']} {jig['split']:8s}"
        f" valid {jig['valid']!s:5} support {jig['turn_support']:.3f}"
        f" least distance {jig['min_wall_to_wire_mm']:.4f}"
        f" {built.timings_s['jig']:5.1f} s {dict(codes)}",
        flush=True,
    )
    return ("valid" if jig["valid"] else "invalid"), jig["turn_support"]


if __name__ == "__main__":
    main()
