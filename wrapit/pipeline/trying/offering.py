"""Whether a drawing that is made fit would help against bends that are too tight: tried before it is told."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from wrapit.config import Config
from wrapit.errors import Finding, WrapItError
from wrapit.pipeline.cache.remembering import Outcome
from wrapit.pipeline.trying.tried import FitLevel, Traced, bolder, is_tight, tried, with_fit
from wrapit.pipeline.work import Work

# What a drawing of wider bends and fewer lines mends.
_ASKING: Final = {"tight-bend", "wire-without-solid"}
# Lines too near or too short for walls: one or two turns are bent by hand, several ask for another drawing.
_CROWDED: Final = {"small-wall", "turn-without-wall", "weak-turn"}
_SEVERAL: Final = 3
# Larger drawings aren't tried: that would take longer than the build. Nets of 300 segments take 10 to 20 s, a
# rose of 683, half a millimetre each, takes minutes.
_MOST_SEGMENTS: Final = 300
# A smaller share of the lines that is left out reads as none.
_NOTHING: Final = 0.005


@dataclass(frozen=True)
class Counts:
    """What counts of a piece as it was made or tried; fewer bends and wires are better."""

    tight_bends: int
    wires: int
    left_out: float


def with_offers(work: Work) -> list[Finding]:
    """The findings of a build, those that a fitted drawing would mend with what it would do.

    It is for who reads them now: no file says it.
    """
    asking = _asking(work.findings)
    if not asking or not bolder(work.config):
        return work.findings
    key = work.key("offer")

    def offered() -> Outcome:
        tight = [each for each in work.outcomes["wires"].findings if is_tight(each)]
        left_out = work.fitted.costs.left_out if work.fitted is not None else 0.0
        made = Counts(len(tight), len(work.wires), left_out)
        if _is_too_large(work):
            return Outcome(
                blocks={"said": f"try fit: {bolder(work.config)[-1]}, with so many lines it takes long"}
            )
        traced = Traced(work.outcomes["trace"].value, work.config.reading)
        return Outcome(blocks={"said": offer(work.config, work.drawing_path, made, traced)})

    said = work.remember(key, offered, None).blocks["said"]
    if not said:
        return work.findings
    return [
        dataclasses.replace(each, remedy=f"{each.remedy}; {said}" if each.remedy else said)
        if each in asking
        else each
        for each in work.findings
    ]


def _is_too_large(work: Work) -> bool:
    """Whether what would be made fit has more lines than are tried."""
    return len(work.outcomes["trace"].value.segments) > _MOST_SEGMENTS


def offer(config: Config, path: Path, before: Counts, traced: Traced | None = None) -> str:
    """What the gentlest `fit` does that leaves no bend too tight, or else the one that leaves the fewest.

    `before` is what the config makes. Empty where none leaves fewer bends, nor as many with fewer wires.

    >>> from wrapit.config import Config
    >>> offer(Config(drawing="x.svg", fit="bold"), Path("x.svg"), Counts(1, 2, 0.0))
    ''
    """
    best: tuple[FitLevel, Counts] | None = None
    for level in bolder(config):
        made = counted(with_fit(config, level), path, traced)
        if made is not None and _gain(made) < _gain(best[1] if best is not None else before):
            best = level, made
        if best is not None and best[1].tight_bends == 0:
            break
    return f"with fit: {best[0]}: {_told(before, best[1])}" if best is not None else ""


def gain_of(config: Config, path: Path, level: FitLevel) -> str:
    """What a level would do to a piece, in few words; empty where it has neither wires nor bends less."""
    before, made = counted(config, path), counted(with_fit(config, level), path)
    if before is None or made is None or _gain(made) >= _gain(before):
        return ""
    return _told(before, made)


def _asking(findings: Sequence[Finding]) -> set[Finding]:
    """Those that a fitted drawing may mend."""
    told = {each for each in findings if each.level != "note"}
    crowded = {each for each in told if each.code in _CROWDED}
    tight = {each for each in told if each.code in _ASKING}
    return tight | crowded if len(crowded) >= _SEVERAL else tight


def counted(config: Config, path: Path, traced: Traced | None = None) -> Counts | None:
    """What counts of a piece, tried; None where it can't be made: that is no remedy."""
    try:
        found = tried(config, path, traced)
    except WrapItError:
        return None
    left_out = found.fitted.costs.left_out if found.fitted is not None else 0.0
    return Counts(len(found.tight_bends), len(found.wires), left_out)


def _gain(made: Counts) -> tuple[int, int]:
    return made.tight_bends, made.wires


def _told(before: Counts, then: Counts) -> str:
    """In few words.

    >>> _told(Counts(3, 9, 0.0), Counts(0, 6, 0.081))
    'no tight bend, 6 wires instead of 9, 8% of the lines left out'
    >>> _told(Counts(3, 9, 0.0), Counts(1, 9, 0.0))
    '1 tight bend instead of 3'
    """
    parts = []
    if before.tight_bends:
        bends = f"{then.tight_bends} tight bend{'' if then.tight_bends == 1 else 's'}"
        parts.append(f"{bends} instead of {before.tight_bends}" if then.tight_bends else "no tight bend")
    if then.wires != before.wires:
        parts.append(f"{then.wires} wire{'' if then.wires == 1 else 's'} instead of {before.wires}")
    if then.left_out - before.left_out > _NOTHING:
        parts.append(f"{then.left_out:.0%} of the lines left out")
    return ", ".join(parts)
