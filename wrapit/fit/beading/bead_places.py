"""All beads of a drawing: those that its lines are led through, and those beside them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

from wrapit.drawing.model import Dot, Drawing
from wrapit.errors import Finding
from wrapit.fit.beading.beads import beaded, passing
from wrapit.fit.beading.loose_beads import loose_beads
from wrapit.fit.model import Bead, Limits
from wrapit.fit.sketch import Sketch


def with_beads(
    sketch: Sketch, dots: Sequence[Dot], limits: Limits, kept: Iterable[int]
) -> tuple[Sketch, tuple[Bead, ...], tuple[Finding, ...]]:
    """The sketch with beads in place of small round loops, and those beads with others for `dots`."""
    sketch, threaded = beaded(sketch, limits, kept, [dot.at for dot in dots])
    loose, told, said = loose_beads(dots, sketch, threaded, limits)
    return sketch.changed(told=told), (*threaded, *loose), said


def in_segments(beads: Iterable[Bead], drawing: Drawing) -> tuple[Bead, ...]:
    """The beads with the segments that run through them, in place of a sketch's lines."""
    curves = {segment.id: segment.curve for segment in drawing.segments}
    return tuple(
        bead if bead.segment is None else replace(bead, segment=passing(bead.at, curves)) for bead in beads
    )
