"""What a batch is about: pieces, how the build of each ended, and what it is told."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Final, Literal

from wrapit.config import Config
from wrapit.errors import WrapItError

Status = Literal["ok", "failed", "pending"]
# The batch's own files in its folder.
LEDGER, INDEX = "batch.json", "index.html"
# In the order in which they are counted.
STATUSES: Final[tuple[Status, ...]] = ("ok", "failed", "pending")


@dataclass(frozen=True)
class Piece:
    """One config: its path as it was given, what it says, or why it can't be loaded."""

    name: str
    config_path: Path
    config: Config | None = None
    trouble: WrapItError | None = None


@dataclass(frozen=True)
class Ended:
    """How a build ended: its exit code, its error (code, problem, where, remedy) and the stages' seconds."""

    exit_code: int
    error: Mapping[str, str] | None = None
    timings_s: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True)
class Outcome:
    """A piece that was dealt with; `kept` says that what its folder holds was up to date already."""

    piece: Piece
    ended: Ended
    seconds: float = 0.0
    kept: bool = False


def failed(error: WrapItError) -> Ended:
    """What a build that ends with this error comes to."""
    told = {"code": error.code, "problem": error.problem, "where": error.where, "remedy": error.remedy}
    return Ended(error.exit_code, told)
