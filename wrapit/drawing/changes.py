"""What reading a drawing changed, and what the maker should know of it: places in the file's own pixels."""

from __future__ import annotations

from dataclasses import dataclass

from wrapit.errors import Level


@dataclass(frozen=True)
class Change:
    """One thing that clean-up did: what, where (pixels), how long, and why."""

    what: str
    at_px: tuple[float, float]
    length_px: float
    reason: str


@dataclass(frozen=True)
class Notice:
    """Something to tell the maker, at a place in pixels."""

    level: Level
    code: str
    at_px: tuple[float, float]
    message: str
    remedy: str = ""
