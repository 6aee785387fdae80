"""`batch.json` and `index.html`: written whole as results come in, over nobody else's files."""

from __future__ import annotations

import hashlib
import json
import os
import shutil
import sys
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Final

from wrapit import __version__
from wrapit.batch.entries import entry_of, pending, totals
from wrapit.batch.index_page import index_page
from wrapit.batch.model import INDEX, LEDGER, Outcome, Piece
from wrapit.batch.pricing import Prices
from wrapit.errors import ConfigError
from wrapit.pipeline.output.guards import lock_on, unlock
from wrapit.pipeline.output.ownership import is_plain_file, is_unchanged
from wrapit.pipeline.textfile import write_whole

# What tells that a batch.json is wrapit's.
FORMAT: Final = "wrapit-batch/1"
# Writing a page of a thousand pieces takes a tenth of a second, and would do so a thousand times: it waits
# for so many times as long as the last time took. What a kill loses of it, --resume finds in pieces' reports.
_PATIENCE: Final = 10.0


class Ledger:
    """What is known of each piece so far, and the two files that tell it."""

    def __init__(self, folder: Path, pieces: Sequence[Piece], prices: Prices) -> None:
        self._folder, self._prices = folder, prices
        self._entries = [pending(piece) for piece in pieces]
        self._places = {piece.config_path: place for place, piece in enumerate(pieces)}
        self._index_digests = _index_digests(_earlier(folder))
        self._quiet_until_s = 0.0

    @property
    def document(self) -> dict[str, Any]:
        """`batch.json`, but for the files that it lists."""
        return {
            "format": FORMAT,
            "version": __version__,
            "pieces": self._entries,
            "totals": totals(self._entries, self._prices),
        }

    def record(self, outcome: Outcome) -> dict[str, Any]:
        """Notes how a piece ended, and returns what is noted; the files follow soon."""
        entry = entry_of(outcome, self._folder, self._prices)
        self._entries[self._places[outcome.piece.config_path]] = entry
        if time.monotonic() >= self._quiet_until_s:
            start_s = time.monotonic()
            self.write()
            self._quiet_until_s = time.monotonic() + _PATIENCE * (time.monotonic() - start_s)
        return entry

    def write(self) -> None:
        """Both files as of now.

        While the page is replaced, `batch.json` lists it as it was and as it will be: a kill at any moment
        leaves a page that is known to be ours.

        Raises ConfigError when somebody else wrote one of them meanwhile.
        """
        refuse_foreign(self._folder, self._index_digests)
        document = self.document
        page = index_page(document)
        digest = hashlib.sha256(page.encode()).hexdigest()
        if self._index_digests != [digest] or not (self._folder / INDEX).exists():
            self._list(document, [*self._index_digests, digest])
            write_whole(self._folder / INDEX, page)
        self._list(document, [digest])

    def _list(self, document: dict[str, Any], digests: list[str]) -> None:
        self._index_digests = list(dict.fromkeys(digests))
        artifacts = [{"path": INDEX, "sha256": digest} for digest in self._index_digests]
        text = json.dumps({**document, "artifacts": artifacts}, indent=1, ensure_ascii=False, allow_nan=False)
        write_whole(self._folder / LEDGER, f"{text}\n")


@contextmanager
def held(folder: Path) -> Iterator[None]:
    """The folder, made where there is none, for one batch at a time.

    Raises ConfigError when another batch runs in it, and when one of its two files is somebody else's.
    """
    folder.mkdir(parents=True, exist_ok=True)
    lock = lock_on(folder, wait=False)
    try:
        if lock is None and sys.platform != "win32":
            raise ConfigError("another batch is at work here", str(folder), "wait, or choose another with -o")
        refuse_foreign(folder, _index_digests(_earlier(folder)))
        _clear_leftovers(folder)
        yield
    finally:
        unlock(lock)


def refuse_foreign(folder: Path, index_digests: Sequence[str]) -> None:
    """Raises ConfigError where a file that the batch would write is somebody's, or changed by somebody."""
    for name, ours in (
        (LEDGER, _earlier(folder) is not None),
        (INDEX, is_unchanged(folder / INDEX, index_digests)),
    ):
        if os.path.lexists(folder / name) and not ours:
            problem = "wrapit didn't write this file, or somebody changed it"
            raise ConfigError(problem, str(folder / name), "move it away, or choose another folder with -o")


def _earlier(folder: Path) -> dict[str, Any] | None:
    """The `batch.json` of an earlier batch."""
    path = folder / LEDGER
    try:
        document = json.loads(path.read_text(encoding="utf-8")) if is_plain_file(path) else None
    except (OSError, ValueError, RecursionError):
        return None
    return document if isinstance(document, dict) and document.get("format") == FORMAT else None


def _index_digests(document: dict[str, Any] | None) -> list[str]:
    artifacts = (document or {}).get("artifacts")
    rows = artifacts if isinstance(artifacts, list) else []
    return [str(row.get("sha256")) for row in rows if isinstance(row, dict) and row.get("path") == INDEX]


def _clear_leftovers(folder: Path) -> None:
    """Takes away what `write_whole` left where a batch was killed amid writing."""
    for path in folder.glob(".wrapit-????????"):
        if path.is_dir() and not path.is_symlink() and {each.name for each in path.iterdir()} <= {"text"}:
            shutil.rmtree(path, ignore_errors=True)
