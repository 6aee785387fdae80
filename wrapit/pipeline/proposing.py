"""A first config that can be made: the proposed size, or the next one at which the jig holds the wires."""

from __future__ import annotations

import time
from pathlib import Path

from wrapit.config import Config
from wrapit.config.texts.reading import read_yaml
from wrapit.drawing.proposal import SIZES_MM, Proposal, propose
from wrapit.errors import WrapItError
from wrapit.pipeline.remedies import held_share

# Nobody waits longer for a proposal than for a build without solids. A size takes 0.5 to 3 s on our drawings.
_PATIENCE_S = 20.0


def propose_makeable(path: Path, folder: Path | None = None, preset: str = "") -> tuple[Proposal, bool]:
    """The proposal for a drawing, and whether its size was found to do.

    It is that of `propose`, at the first of the usual sizes from there on at which the jig holds enough and
    no wire bends more tightly than its metal takes; where none was found in time, at the first that is held.
    Works without the kernel. Raises what `propose` raises.
    """
    first = propose(path, folder, preset)
    until = time.monotonic() + _PATIENCE_S
    held: Proposal | None = None
    for size_mm in (each for each in SIZES_MM if each >= first.size_mm):
        proposal = first.at(size_mm)
        config = Config.model_validate(read_yaml(proposal.text(), str(path)))  # what will be built
        if held_share(config, path) >= config.jig.least_support:
            held = held if held is not None else proposal
            if not _bends_tightly(config, path):
                return proposal, True
        if time.monotonic() > until:
            break
    return (held, True) if held is not None else (first, False)


def _bends_tightly(config: Config, path: Path) -> bool:
    from wrapit.decomposition.stage import decompose
    from wrapit.drawing.stage import trace
    from wrapit.wires.stage import draw_wires

    try:
        drawing, _ = trace(path, config.tracing, config.size)
        _, findings = draw_wires(decompose(drawing, config.decomposition)[0], config)
    except WrapItError:
        return True  # what can't be drawn is no better
    return any(finding.code == "tight-bend" and finding.level != "note" for finding in findings)
