"""The drawing as it was read beside the one that is fit for wire. Runs in the build's process."""

from __future__ import annotations

import json
from collections.abc import Set as AbstractSet
from dataclasses import asdict
from typing import Any, Final

import numpy as np

from wrapit.config import Config
from wrapit.drawing.json_file import drawing_json
from wrapit.drawing.model import Drawing, Removal
from wrapit.errors import WrapItError
from wrapit.fit.model import Fitted
from wrapit.fit.stage import make_fit
from wrapit.pipeline.work import Work
from wrapit.wires.model import Wire

BENDS: Final = frozenset({"tight-bend"})
"""Findings about what the metal can be."""
HOLDS: Final = frozenset({"unheld", "unheld-wire"})
"""Findings about what a jig holds."""
# A share that grows by less is no help that a maker would see.
_MORE_HELD: Final = 0.01
# How finely lines are sampled to find that of a place, which is one of their points: a line's width is more.
_STEP_MM: Final = 0.1


def fit_document(fitted: Fitted | None, config: Config) -> dict[str, Any] | None:
    """What a page shows of it: the drawing that was read, and what became of it and why.

    None where nothing was asked for, so that there is one drawing only.
    """
    if fitted is None or (config.fit == "off" and not fitted.left_out):
        return None
    done = fitted.drawing.removed[len(fitted.original.removed) :]
    return {
        "original": json.loads(drawing_json(fitted.original)),
        "origins": [list(origin) for origin in fitted.origins],
        "left_out": list(fitted.left_out),
        "before": asdict(fitted.before),
        "after": asdict(fitted.after),
        "costs": asdict(fitted.costs),
        "changes": [
            asdict(change) | {"at": list(change.at), "line": _line(change, fitted)} for change in done
        ],
        "beads": [{"at": bead.at.tolist(), "diameter_mm": bead.diameter_mm} for bead in fitted.beads],
    }


def _line(change: Removal, fitted: Fitted) -> int | None:
    """The line that was left out at the place of a change; None where that left none out."""
    if change.what != "dropped":
        return None
    lines = {number: fitted.original.segments[number].curve.sampled(_STEP_MM) for number in fitted.left_out}
    off_mm = {number: float(np.hypot(*(points - change.at).T).min()) for number, points in lines.items()}
    nearest = min(off_mm, key=off_mm.__getitem__, default=None)
    return nearest if nearest is not None and off_mm[nearest] <= _STEP_MM else None


def helped_by_fit(work: Work, codes: AbstractSet[str]) -> list[str]:
    """Those of some findings' codes against which `fit: gentle` was tried and helps; none where it is on."""
    asked = codes & (BENDS | HOLDS)
    if work.config.fit != "off" or work.drawing is None or not asked:
        return []
    original = work.drawing if work.fitted is None else work.fitted.original
    gentle = work.config.model_copy(update={"fit": "gentle"})
    try:
        now, then = make_fit(original, work.config)[0], make_fit(original, gentle)[0]
        helped = asked & BENDS if then.after.tight_bends < now.after.tight_bends else frozenset[str]()
        if asked & HOLDS and then.after != now.after and _is_held(then.drawing, work):
            helped |= asked & HOLDS
    except WrapItError:  # a drawing that can't be made fit isn't helped
        return []
    return sorted(helped)


def _is_held(drawing: Drawing, work: Work) -> bool:
    """Whether the first kind of jig would hold enough of a drawing's turns, and more than of the work's."""
    from wrapit.decomposition.stage import decompose
    from wrapit.wires.beside.side_by_side import room_of
    from wrapit.wires.stage import draw_wires

    solution, _ = decompose(drawing, work.config.decomposition, room_of(work.config))
    wires, _ = draw_wires(solution, work.config)
    then = _held(wires, work.config)
    return then >= max(work.config.jig.least_support, _held(work.wires, work.config) + _MORE_HELD)


def _held(wires: tuple[Wire, ...], config: Config) -> float:
    """The share of their turns that a jig would hold, bent further where it makes up for springback."""
    from wrapit.jig.kinds import JIGS
    from wrapit.jig.overbending import overbend_wires

    if config.jig.springback == "compensate":
        wires = tuple(bent.wire for bent in overbend_wires(wires, config)[0])
    return JIGS[config.jigs[0]].held(wires, config)
