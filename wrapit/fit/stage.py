"""The verb of this stage: make a drawing fit for wire."""

from __future__ import annotations

from wrapit.config import Config
from wrapit.drawing.model import Drawing
from wrapit.errors import Finding
from wrapit.fit.beading.bead_places import in_segments, with_beads
from wrapit.fit.faces import faces_of
from wrapit.fit.limits import limits_of
from wrapit.fit.measuring import costs, measures, unchanged
from wrapit.fit.model import Bead, Fitted
from wrapit.fit.sketch import Sketch
from wrapit.fit.wishes import without_dropped


def make_fit(drawing: Drawing, config: Config) -> tuple[Fitted, tuple[Finding, ...]]:
    """The drawing as this config's wire can follow it, and what the maker should know about it.

    With `fit: off` only what `drop` names is left out. Raises ConfigError where `keep` or `drop` names no
    segment, or names one in both.
    """
    before = Sketch.of(drawing)
    limits = limits_of(config, "gentle" if config.fit == "off" else config.fit)
    first = faces_of(before)
    after = without_dropped(before, config)
    beads: tuple[Bead, ...] = ()
    said: tuple[Finding, ...] = ()
    if config.beads == "auto":
        after, beads, said = with_beads(after, drawing.dots, limits, config.keep)
    made, origins = (
        (drawing, tuple((segment.id,) for segment in drawing.segments))
        if unchanged(drawing, after)
        else after.drawing(drawing)
    )
    fitted = Fitted(
        drawing,
        made,
        origins,
        in_segments(beads, made),
        measures(before, limits, first),
        measures(after, limits),
        costs(before, after, first.outline, limits),
    )
    return fitted, said
