"""Builds many pieces into one folder, each in a folder of its own, with a catalogue of them."""

from __future__ import annotations

from collections.abc import Callable, Generator, Iterator, Sequence
from contextlib import closing, contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from wrapit.batch.choosing import choose
from wrapit.batch.here import built_here, usual_jobs
from wrapit.batch.ledger import Ledger, held
from wrapit.batch.model import Ended, Outcome, Piece, failed
from wrapit.batch.pricing import Prices
from wrapit.batch.resuming import is_up_to_date

Build = Callable[[Sequence[Piece]], Generator[Outcome, None, None]]
"""Builds pieces, and yields each as it is done; closed earlier, it stops what runs."""

Told = Callable[[Outcome, dict[str, Any]], None]
"""Told of each piece that is done, with what `batch.json` says of it."""


@dataclass(frozen=True)
class Batch:
    """What `batch.json` says, and by name the seconds of each piece that was built (`total`, and stages)."""

    document: dict[str, Any]
    timings_s: dict[str, dict[str, float]]

    @property
    def any_failed(self) -> bool:
        return self.document["totals"]["failed"] > 0


def run_batch(
    arguments: Sequence[Path],
    target: Path,
    *,
    jobs: int | None = None,
    scheduler: str | None = None,
    resume: bool = False,
    overrides: Sequence[str] = (),
    prices: Prices | None = None,
    begun: Callable[[int], None] = lambda pieces: None,
    told: Told = lambda outcome, entry: None,
    say: Callable[[str], None] = lambda line: None,
) -> Batch:
    """Builds the pieces that the arguments stand for into `target/<name>/`, each on its own.

    With a `scheduler` on Dask's workers, else in `jobs` processes here. With `resume` what is up to date
    isn't even started. A piece that fails says why in its entry; whatever ends the batch, what is done stays.

    Raises ConfigError for what can't be begun: no such configs, two of one name, a folder or file of
    somebody else's, no scheduler. OSError where the folder can't be written.
    """
    from wrapit.pipeline.output.folder import followed

    pieces = choose(arguments, overrides)
    folder, timings_s = followed(target), {}
    with held(folder), _workshop(folder, overrides, jobs, scheduler, say) as build:
        ledger = Ledger(folder, pieces, prices or Prices())
        begun(len(pieces))
        try:
            ledger.write()
            with closing(_outcomes(pieces, folder, resume or scheduler is not None, build)) as outcomes:
                for outcome in outcomes:
                    if outcome.seconds:
                        stages = {"total": round(outcome.seconds, 4), **outcome.ended.timings_s}
                        timings_s[outcome.piece.name] = stages
                    told(outcome, ledger.record(outcome))
        finally:
            ledger.write()
    return Batch(ledger.document, timings_s)


@contextmanager
def _workshop(
    folder: Path,
    overrides: Sequence[str],
    jobs: int | None,
    scheduler: str | None,
    say: Callable[[str], None],
) -> Iterator[Build]:
    """Where pieces are built: here, or by a cluster that is connected to before anything is written."""
    if scheduler is None:
        yield lambda pieces: built_here(pieces, folder, overrides, jobs or usual_jobs())
        return
    from wrapit.batch.cluster import built_by, connected

    with connected(scheduler) as client:
        yield lambda pieces: built_by(client, pieces, folder, overrides, say)


def _outcomes(
    pieces: Sequence[Piece], folder: Path, look: bool, build: Build
) -> Generator[Outcome, None, None]:
    """What needs no build comes first; unless we `look`, a build finds out itself that it is up to date."""
    to_build = []
    for piece in pieces:
        if piece.trouble is not None:
            yield Outcome(piece, failed(piece.trouble))
        elif look and is_up_to_date(piece, folder / piece.name):
            yield Outcome(piece, Ended(0), kept=True)
        else:
            to_build.append(piece)
    if to_build:
        with closing(build(to_build)) as outcomes:
            yield from outcomes
