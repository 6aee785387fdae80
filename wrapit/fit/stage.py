"""The verb of this stage: make a drawing fit for wire."""

from __future__ import annotations

from typing import Final

from wrapit.config import Config
from wrapit.drawing.model import Drawing
from wrapit.errors import Finding
from wrapit.fit.beading.bead_places import beads_of, in_segments
from wrapit.fit.beading.beads import beaded
from wrapit.fit.clearing import cleared
from wrapit.fit.limits import limits_of
from wrapit.fit.measuring import costs, measures
from wrapit.fit.mirroring.posing import posed, unposed
from wrapit.fit.model import Bead, Fitted, Level, Limits
from wrapit.fit.sketch import Sketch
from wrapit.fit.smoothing import smoothed
from wrapit.fit.unmet import unmet
from wrapit.fit.wishes import without_dropped

# Wider bends may make a face smaller, or a line shorter: then it starts again. The corpus takes one turn or
# two.
_TURNS: Final = 4


def make_fit(drawing: Drawing, config: Config) -> tuple[Fitted, tuple[Finding, ...]]:
    """The drawing as this config's wire can follow it, and what the maker should know about it.

    A drawing that is fit already is returned itself. With `fit: off` only what `drop` names is left out.
    Raises ConfigError where `keep` or `drop` names no segment, or names one in both.
    """
    before = Sketch.of(drawing)
    limits = limits_of(config, "gentle" if config.fit == "off" else config.fit)
    after = without_dropped(before, config)
    beads: tuple[Bead, ...] = ()
    findings: tuple[Finding, ...] = ()
    if config.beads == "auto":
        after, beads = beaded(after, limits, config.keep, [dot.at for dot in drawing.dots])
    if config.fit != "off":
        after = _fit(after, limits, config.fit, frozenset(config.keep))
        findings = unmet(after, before, limits, config)
    if config.beads == "auto":
        after, beads, said = beads_of(after, beads, drawing.dots, limits)
        findings = (*findings, *said)
    made, origins = (
        after.drawing(drawing)
        if after.removed
        else (drawing, tuple((segment.id,) for segment in drawing.segments))
    )
    fitted = Fitted(
        drawing,
        made,
        origins,
        in_segments(beads, made),
        measures(before, limits),
        measures(after, limits),
        costs(before, after, before.faces.outline, limits),
    )
    return fitted, findings


def _fit(sketch: Sketch, limits: Limits, level: Level, keep: frozenset[int]) -> Sketch:
    """The sketch made fit, in its pose; itself if nothing is to be done."""
    done, pose = posed(sketch)
    for _ in range(_TURNS):
        told = len(done.removed)
        done = smoothed(cleared(done, limits, level, keep), limits)
        if len(done.removed) == told:
            break
    return sketch if len(done.removed) == len(sketch.removed) else unposed(done, pose)
