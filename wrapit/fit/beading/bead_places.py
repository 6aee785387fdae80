"""All beads of a drawing: those that its lines are led through, and those beside them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np

from wrapit.drawing.model import Dot, Drawing
from wrapit.errors import Finding
from wrapit.fit.beading.beads import passing
from wrapit.fit.beading.loose_beads import loose_beads
from wrapit.fit.model import Bead, Limits
from wrapit.fit.sketch import Sketch

_LOST = Finding(
    "note",
    "no-bead",
    "",
    "the line through this bead was left out, and the bead with it",
    "keep that line (`keep`), or make the piece larger",
)


def beads_of(
    sketch: Sketch, threaded: Iterable[Bead], dots: Sequence[Dot], limits: Limits
) -> tuple[Sketch, tuple[Bead, ...], tuple[Finding, ...]]:
    """The sketch as it is in the end, all beads on its lines and beside them, and what is told of the others.

    Lines have moved a little since beads were `threaded` on them: these move along. One whose line is gone
    is no bead.
    """
    import shapely

    curves = {number: line.curve for number, line in sketch.lines.items()}
    kept: list[Bead] = []
    lost: list[Finding] = []
    for bead in threaded:
        number = passing(bead.at, curves)
        line, middle = sketch.lines[number].shape, shapely.Point(bead.at)
        if line.distance(middle) < bead.diameter_mm / 2:
            near = line.interpolate(line.project(middle))
            kept.append(replace(bead, at=np.array(near.coords[0]), segment=number))
        else:
            lost.append(replace(_LOST, where=f"at ({bead.at[0]:.1f}, {bead.at[1]:.1f}) mm"))
    loose, told, said = loose_beads(dots, sketch, kept, limits)
    return sketch.changed(told=told), (*kept, *loose), (*lost, *said)


def in_segments(beads: Iterable[Bead], drawing: Drawing) -> tuple[Bead, ...]:
    """The beads with the segments that run through them, in place of a sketch's lines."""
    curves = {segment.id: segment.curve for segment in drawing.segments}
    return tuple(
        bead if bead.segment is None else replace(bead, segment=passing(bead.at, curves)) for bead in beads
    )
