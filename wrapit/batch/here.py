"""Builds the pieces on this machine, so many at once."""

from __future__ import annotations

import os
import time
from collections.abc import Generator, Sequence
from concurrent.futures import FIRST_COMPLETED, ThreadPoolExecutor, wait
from pathlib import Path
from typing import Final

from wrapit.batch.model import Outcome, Piece
from wrapit.batch.processes import Processes

# How often it is looked whether Ctrl-C came: Windows tells it only between two waits.
_LOOK_S: Final = 0.5


def usual_jobs() -> int:
    """Half the cores: beside each build the kernel works in a process of its own."""
    return max(1, (os.cpu_count() or 1) // 2)


def built_here(
    pieces: Sequence[Piece], folder: Path, overrides: Sequence[str], jobs: int
) -> Generator[Outcome, None, None]:
    """Each piece as it is done; closed earlier, all builds that run are stopped."""
    processes = Processes()

    def one(piece: Piece) -> Outcome:
        start_s = time.perf_counter()
        ended = processes.build(piece.config_path, folder / piece.name, overrides)
        return Outcome(piece, ended, time.perf_counter() - start_s)

    pool = ThreadPoolExecutor(jobs, thread_name_prefix="build")
    try:
        waiting = {pool.submit(one, piece) for piece in pieces}
        while waiting:
            done, waiting = wait(waiting, timeout=_LOOK_S, return_when=FIRST_COMPLETED)
            for future in done:
                yield future.result()
    finally:
        pool.shutdown(wait=False, cancel_futures=True)
        processes.stop()
        pool.shutdown(wait=True)
