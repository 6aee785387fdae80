"""Builds the pieces on the workers of a Dask scheduler; this machine sends bytes and puts files in place."""

from __future__ import annotations

import logging
import re
import warnings
from collections.abc import Callable, Generator, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Final

from wrapit.batch.model import Ended, Outcome, Piece, failed
from wrapit.batch.parcels import arrived, build_parcel, packed, put_here
from wrapit.errors import ConfigError, WrapItError
from wrapit.units import printable, shortened

# How long a scheduler may take to answer: one on the other side of the world needs a second or two.
_ANSWER_S: Final = 10.0
# Pieces on their way at once, so that the drawings of a large catalogue aren't all in the scheduler's memory:
# some for each thread, so that none waits; at least so many where no worker is known yet.
_AHEAD, _LEAST_AHEAD = 3, 32
# Dask's ways to reach a scheduler over a network; it hangs 20 s at its end over what looks otherwise.
_ADDRESS: Final = re.compile(r"(tcp|tls|ws|wss)://([\w.-]+|\[[0-9A-Fa-f:.%]+\]):\d{1,5}/?")
# What helps where no scheduler is.
_START: Final = "start one with `dask scheduler`; it prints its address, such as tcp://192.168.0.5:8786"


def built_by(
    client: Any, pieces: Sequence[Piece], folder: Path, overrides: Sequence[str], say: Callable[[str], None]
) -> Generator[Outcome, None, None]:
    """Each piece as it comes back; a worker's death costs only time, for Dask sends its pieces again."""
    workers = client.scheduler_info(n_workers=-1)["workers"]
    if not workers:
        address = client.scheduler.address
        say(f"{address} has no workers yet; start some with: dask worker {address}")
    threads = sum(worker["nthreads"] for worker in workers.values())
    yield from _streamed(client, pieces, folder, overrides, max(_LEAST_AHEAD, _AHEAD * threads))


def _streamed(
    client: Any, pieces: Sequence[Piece], folder: Path, overrides: Sequence[str], ahead: int
) -> Generator[Outcome, None, None]:
    waiting, under_way, arriving = iter(pieces), {}, _dask().as_completed(loop=client.loop)
    while True:
        for piece in waiting:
            try:
                future = _sent(client, piece, folder, overrides)
            except WrapItError as error:
                yield Outcome(piece, failed(error))
                continue
            under_way[future] = piece
            arriving.add(future)
            if len(under_way) >= ahead:
                break
        if not under_way:
            return
        future = next(arriving)
        yield _received(future, under_way.pop(future), folder)
        future.release()


def _sent(client: Any, piece: Piece, folder: Path, overrides: Sequence[str]) -> Any:
    from wrapit.pipeline.output.folder import followed, prepare

    prepare(followed(folder / piece.name))  # what can't be put in place isn't built
    return client.submit(
        _on_worker, packed(piece, overrides), pure=False, key=f"wrapit-{id(client)}-{piece.name}"
    )


def _on_worker(parcel: dict[str, Any]) -> dict[str, Any]:
    """In the worker's own scratch folder, which Dask clears away after one that was killed."""
    worker = _dask().get_worker()
    return build_parcel(parcel, worker.address, worker.local_directory)


def _received(future: Any, piece: Piece, folder: Path) -> Outcome:
    from concurrent.futures import CancelledError

    from wrapit.pipeline.output.folder import followed

    try:
        answer = future.result()
        ended = arrived(answer, piece)
        if ended.error is None:
            put_here(answer["files"], followed(folder / piece.name))
        return Outcome(piece, ended, answer.get("seconds", 0.0))
    except WrapItError as error:
        return Outcome(piece, failed(error))
    except _dask().KilledWorker:
        problem = "workers ended amid this piece, again and again"
        return _lost(
            piece, problem, "give the workers more memory (or fewer threads), and go on with --resume"
        )
    except CancelledError:
        return _lost(
            piece, "the scheduler ended before this piece was done", "start it, and go on with --resume"
        )
    except Exception as error:  # noqa: BLE001  whatever a worker's Python raises concerns this piece alone
        problem = " ".join(f"the worker failed ({type(error).__name__}: {error})".split())[:300]
        return _lost(piece, problem, "see that the workers have the same wrapit and Python, and use --resume")


def _lost(piece: Piece, problem: str, remedy: str) -> Outcome:
    told = {"code": "cluster", "problem": problem, "where": str(piece.config_path), "remedy": remedy}
    return Outcome(piece, Ended(1, told))


@contextmanager
def connected(address: str) -> Iterator[Any]:
    """A scheduler's client.

    Raises ConfigError where Dask isn't installed or no scheduler answers.
    """
    option = f"--scheduler {shortened(printable(address), 80)}"
    if _ADDRESS.fullmatch(address) is None:
        raise ConfigError("not an address", option, _START)
    try:
        dask = _dask()
    except ImportError:
        remedy = 'install it: pip install "wrapit[cluster]"'
        raise ConfigError("Dask is not installed", option, remedy) from None
    logging.getLogger("distributed").setLevel(logging.CRITICAL)  # what goes wrong is told in a piece's line
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of other versions beside: only functions and bytes are sent
        try:
            client = dask.Client(address, timeout=_ANSWER_S, set_as_default=False)
        except (OSError, ValueError, TypeError) as error:
            reason = " ".join(str(error).split())[:120] or type(error).__name__
            raise ConfigError(f"no scheduler answers ({reason})", option, _START) from None
    try:
        yield client
    finally:
        client.close()


def _dask() -> Any:
    """Dask's own annotations are half done; raises ImportError where it isn't installed."""
    import distributed

    return distributed
