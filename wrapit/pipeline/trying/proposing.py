"""A first config that can be made: the proposed size, or the next one at which the jig holds the wires."""

from __future__ import annotations

import math
import time
from dataclasses import replace
from pathlib import Path
from typing import Final, Literal

from wrapit.config import Config
from wrapit.config.texts.reading import read_yaml
from wrapit.drawing.proposal import SIZES_MM, Proposal, propose
from wrapit.errors import WrapItError
from wrapit.pipeline.trying.offering import gain_of
from wrapit.pipeline.trying.remedies import held_share
from wrapit.pipeline.trying.tried import LEVELS, FitLevel, tried

# Nobody waits longer for a proposal than for a build without solids. A size takes 0.5 to 3 s on our drawings.
_PATIENCE_S = 20.0
# And half as long for each way to make it fit: who waits for these has a drawing that needs one.
_FIT_PATIENCE_S = 10.0
# A piece made fit that is at most this much of the size is told: less isn't worth any line.
_MUCH_SMALLER = 0.7
# Traced anew at another size, bends come out a little wider or tighter: so much smaller a piece may do too.
_NEARLY = 0.9


Held = Literal["sound", "tight", "unheld"]
"""Of a proposed size: the jig holds it and bends are wide enough; some aren't; the jig holds too little."""
# What is better comes first.
_ORDER: Final[tuple[Held, ...]] = ("sound", "tight", "unheld")
# Why `fit` is written.
_WHY: Final[dict[Held, str]] = {
    "sound": "",
    "tight": "as it is drawn, some bends are too tight for this wire at every usual size",
    "unheld": "as it is drawn, no jig holds it at any usual size",
}


def propose_makeable(path: Path, folder: Path | None = None, preset: str = "") -> tuple[Proposal, Held]:
    """The proposal for a drawing, and what was found of its size.

    It is that of `propose`, at the first of the usual sizes from there on at which the jig holds enough and
    no wire bends more tightly than its metal takes; where none was found in time, it is made fit, as gently
    as does and as small; else it is at the first size that is held. What `fit` would do is a comment, if it
    does anything. Works without the kernel. Raises what `propose` raises.
    """
    first = propose(path, folder, preset)
    best, found = _at_a_size(first, path, _PATIENCE_S)
    if found == "sound":
        about_fit = _offered(best, path)
        return (replace(best, about_fit=about_fit) if about_fit else best), found
    why = f"Made fit for wire: {_WHY[found]}; `fit: off` leaves it so."
    for level in LEVELS:
        made, then = _at_a_size(_fitted(first, level, why), path, _FIT_PATIENCE_S)
        if _ORDER.index(then) < _ORDER.index(found):
            best, found = made, then
        if found == "sound":
            break
    return best, found


def _offered(best: Proposal, path: Path) -> str:
    """What `fit: gentle` would do to a proposal that can be made without: less work, or a smaller piece."""
    gain = gain_of(_config(best, path), path, "gentle")
    if not gain and best.least_mm <= _MUCH_SMALLER * best.size_mm:
        small, found = _at_a_size(_fitted(best, "gentle"), path, _FIT_PATIENCE_S)
        if found == "sound" and small.size_mm <= _MUCH_SMALLER * best.size_mm:
            gain = f"with it, size: {small.size_mm} mm can be made too"
    return f"fit: gentle   # {gain}" if gain else ""


def _fitted(proposal: Proposal, level: FitLevel, why: str = "") -> Proposal:
    """A proposal that is made fit, at the least size: junctions that are too near are no matter then."""
    return replace(proposal, size_mm=proposal.least_mm, fit=level, about_fit=why)


def _at_a_size(first: Proposal, path: Path, patience_s: float) -> tuple[Proposal, Held]:
    """A proposal at the first of the usual sizes, from its own on, that can be made; `first` if none can."""
    until = time.monotonic() + patience_s
    held: Proposal | None = None
    least_mm = float(first.size_mm)
    for size_mm in SIZES_MM:
        if size_mm < least_mm:
            continue
        proposal = first.at(size_mm)
        config = _config(proposal, path)
        too_tight = _too_tight(config, path)
        if held_share(config, path) >= config.jig.least_support:
            held = held if held is not None else proposal
            if too_tight <= 1:
                return proposal, "sound"
            least_mm = _NEARLY * size_mm * too_tight  # bends widen as the piece grows
        if time.monotonic() > until:
            break
    return (held, "tight") if held is not None else (first, "unheld")


def _config(proposal: Proposal, path: Path) -> Config:
    """What will be built."""
    return Config.model_validate(read_yaml(proposal.text(), str(path)))


def _too_tight(config: Config, path: Path) -> float:
    """How many times wider the tightest bend would have to be; 1 where all are wide enough."""
    try:
        tight = tried(config, path).tight_bends
    except WrapItError:
        return math.inf  # what can't be drawn is no better
    return max((each.severity for each in tight), default=1.0)
