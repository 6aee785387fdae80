"""A first config that can be made: the proposed size, or the next one at which the jig holds the wires."""

from __future__ import annotations

import math
import time
from pathlib import Path
from typing import Literal

from wrapit.config import Config
from wrapit.config.texts.reading import read_yaml
from wrapit.drawing.proposal import SIZES_MM, Proposal, propose
from wrapit.errors import WrapItError
from wrapit.pipeline.remedies import held_share

# Nobody waits longer for a proposal than for a build without solids. A size takes 0.5 to 3 s on our drawings.
_PATIENCE_S = 20.0
# Traced anew at another size, bends come out a little wider or tighter: so much smaller a piece may do too.
_NEARLY = 0.9


Fit = Literal["sound", "tight", "unheld"]
"""Of a proposed size: the jig holds it and bends are wide enough; some aren't; the jig holds too little."""


def propose_makeable(path: Path, folder: Path | None = None, preset: str = "") -> tuple[Proposal, Fit]:
    """The proposal for a drawing, and what was found of its size.

    It is that of `propose`, at the first of the usual sizes from there on at which the jig holds enough and
    no wire bends more tightly than its metal takes; where none was found in time, at the first that is held.
    Works without the kernel. Raises what `propose` raises.
    """
    first = propose(path, folder, preset)
    until = time.monotonic() + _PATIENCE_S
    held: Proposal | None = None
    least_mm = float(first.size_mm)
    for size_mm in SIZES_MM:
        if size_mm < least_mm:
            continue
        proposal = first.at(size_mm)
        config = Config.model_validate(read_yaml(proposal.text(), str(path)))  # what will be built
        too_tight = _too_tight(config, path)
        if held_share(config, path) >= config.jig.least_support:
            held = held if held is not None else proposal
            if too_tight <= 1:
                return proposal, "sound"
            least_mm = _NEARLY * size_mm * too_tight  # bends widen as the piece grows
        if time.monotonic() > until:
            break
    return (held, "tight") if held is not None else (first, "unheld")


def _too_tight(config: Config, path: Path) -> float:
    """How many times wider the tightest bend would have to be; 1 where all are wide enough."""
    from wrapit.decomposition.stage import decompose
    from wrapit.drawing.stage import trace
    from wrapit.wires.stage import draw_wires

    try:
        drawing, _ = trace(path, config.tracing, config.size)
        _, findings = draw_wires(decompose(drawing, config.decomposition)[0], config)
    except WrapItError:
        return math.inf  # what can't be drawn is no better
    tight = (each for each in findings if each.code == "tight-bend" and each.level != "note")
    return max((each.severity for each in tight), default=1.0)
