"""How many random drawings become a whole build: `python -m tests.bench built 20`."""

from __future__ import annotations

import collections
import tempfile
import time
from pathlib import Path

import numpy as np

from tests.drawing.generated import random_curve
from wrapit.errors import UnheldError, WrapItError

GAUGES = (16, 18, 20, 22, 24, 26)
SIZES_MM = (25, 150)


def main(words: list[str] | None = None) -> None:
    """Builds so many random drawings (10 unless said), and says what stopped those that failed."""
    from wrapit import build

    count = int(words[0]) if words else 10
    outcomes: collections.Counter[str] = collections.Counter()
    with tempfile.TemporaryDirectory() as folder:
        for seed in range(count):
            config, started = drawn(Path(folder), seed), time.process_time()
            try:
                build(config, Path(folder) / f"out-{seed}")
                outcome = "built"
            except UnheldError:
                outcome = "holds too little"
            except WrapItError as error:
                outcome = error.problem
            outcomes[outcome] += 1
            print(f"  {seed:3}  {time.process_time() - started:5.1f} s  {outcome}", flush=True)
    for outcome, times in outcomes.most_common():
        print(f"{times:4} of {count}: {outcome}")


def drawn(folder: Path, seed: int) -> Path:
    """The config of one to three smooth closed curves, at a random size and gauge."""
    rng = np.random.default_rng(seed)
    curves = [random_curve(rng, 100, int(rng.integers(2, 6))) for _ in range(int(rng.integers(1, 4)))]
    paths = "".join(
        f'<path d="M {" L ".join(f"{x:.3f} {y:.3f}" for x, y in curve[::4])} Z" fill="none" stroke="black"/>'
        for curve in curves
    )
    size = float(np.exp(rng.uniform(*np.log(SIZES_MM))))
    (folder / f"{seed}.svg").write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">{paths}</svg>', encoding="utf-8"
    )
    config = folder / f"{seed}.yaml"
    config.write_text(
        f"drawing: {seed}.svg\nsize: {size:.1f} mm\nwire: {{gauge: {rng.choice(GAUGES)} AWG}}\n",
        encoding="utf-8",
    )
    return config


if __name__ == "__main__":
    main()
