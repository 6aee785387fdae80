"""What a step of a build made, kept under a key and recalled by it."""

from __future__ import annotations

import dataclasses
import pickle
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from wrapit.errors import Finding
from wrapit.pipeline.cache.sealed import Entry
from wrapit.pipeline.cache.store import Store


class UnreadableEntry(Exception):  # noqa: N818  nothing is wrong: the build is done again without the entry
    """A value whose bytes are as they were written, and which can't be had from them all the same."""


class Outcome:
    """What a step made: its blocks of the report, findings, the names of its files, and a value.

    A recalled value is unpickled when it is first asked for, with all that has to be imported for it.
    """

    def __init__(
        self,
        value: Any = None,
        blocks: dict[str, Any] | None = None,
        findings: Sequence[Finding] = (),
        files: Sequence[str] = (),
    ) -> None:
        self.blocks, self.findings, self.files = blocks or {}, tuple(findings), tuple(files)
        self._value = value

    @property
    def value(self) -> Any:
        """Raises UnreadableEntry."""
        if isinstance(self._value, _Pickled):
            self._value = self._value.loaded()
        return self._value


@dataclass(frozen=True)
class _Pickled:
    data: bytes

    def loaded(self) -> Any:
        try:
            return pickle.loads(self.data)
        except Exception as error:  # whatever foreign bytes raise
            raise UnreadableEntry from error


def keep(store: Store, key: str, outcome: Outcome, folder: Path | None) -> None:
    """Keeps an outcome with its files, which are in `folder`."""
    if store.folder is None or store.trouble:
        return
    files = {name: (folder / name).read_bytes() for name in outcome.files} if folder is not None else {}
    findings = [dataclasses.asdict(finding) for finding in outcome.findings]
    head = {"blocks": outcome.blocks, "findings": findings}
    store.put(key, Entry(head, files, pickle.dumps(outcome.value, protocol=5)))


def recall(store: Store, key: str, folder: Path | None) -> Outcome | None:
    """What was kept under a key, its files written to `folder`; None where there is nothing.

    Raises OSError where they can't be written.
    """
    entry = store.get(key)
    if entry is None:
        return None
    if folder is not None:
        for name, data in entry.files.items():
            (folder / name).write_bytes(data)
    findings = [Finding(**{**said, "places_mm": tuple(said["places_mm"])}) for said in entry.head["findings"]]
    return Outcome(_Pickled(entry.value), entry.head["blocks"], findings, tuple(entry.files))
