"""Beads that no wire runs through: dots of the drawing, rings that touch nothing; sewn to a wire nearby."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from wrapit.drawing.model import Dot, Removal
from wrapit.errors import Finding
from wrapit.fit.beads import SMALLEST_MM, STEP_OF_SIZES_MM, size_of
from wrapit.fit.faces import STEP_MM
from wrapit.fit.model import Bead, Limits
from wrapit.fit.sketch import Sketch

# Between bead and wire at most, so that binding wire holds the one to the other and doesn't bridge a gap.
REACH_MM = 1.0
# Between bead and wire at least: the jig's seat is wider than the bead by its clearance, 0.2 mm as a rule.
_BESIDE_MM = 0.25
# A bead that is a millimetre smaller than it was drawn still is where it was drawn; a smaller one is another.
_SMALLER_MM = 1.0


def loose_beads(
    dots: Iterable[Dot], sketch: Sketch, beads: Sequence[Bead], limits: Limits
) -> tuple[tuple[Bead, ...], tuple[Removal, ...], tuple[Finding, ...]]:
    """Beads for dots that have a bead's size and a line near enough, what is told of them, and of the others.

    A dot with too little room for its bead gets a smaller one. They keep clear of the `beads` that there are.
    """
    import shapely

    lines = shapely.union_all(
        [shapely.LineString(line.curve.sampled(STEP_MM)) for line in sketch.lines.values()]
    )
    # Eyes that are left out as two pieces, an iris with its pupil, are one bead: the larger.
    found: list[Bead] = []
    told, said = [], []
    for dot in sorted(dots, key=lambda dot: (-round(dot.diameter_mm, 2), dot.at[1], abs(dot.at[0]), dot.at)):
        bead = _bead(dot, lines, [*beads, *found], limits)
        if isinstance(bead, Bead):
            found.append(bead)
            drawn = f"becomes a bead of {bead.diameter_mm:g} mm; drawn {dot.diameter_mm:.2f} mm"
            told.append(Removal("bead", dot.at, np.pi * dot.diameter_mm, drawn))
        elif bead:
            place = f"at ({dot.at[0]:.1f}, {dot.at[1]:.1f}) mm"
            said.append(Finding("note", "no-bead", place, f"this dot becomes no bead: {bead}", _REMEDY))
    return tuple(found), tuple(told), tuple(said)


_REMEDY = "draw it larger and up to half a millimetre beside a line, or as a ring on the line"


def _bead(dot: Dot, lines: Any, others: Sequence[Bead], limits: Limits) -> Bead | str:
    """The bead for a dot, or why there is none; an empty reason where nobody asks for one."""
    import shapely

    size_mm, at = size_of(dot.diameter_mm), np.array(dot.at)
    if size_mm is None:
        return ""
    room_mm = 2 * (float(lines.distance(shapely.Point(at))) - limits.diameter_mm / 2 - _BESIDE_MM)
    fits_mm = STEP_OF_SIZES_MM * np.floor(room_mm / STEP_OF_SIZES_MM + 1e-6)
    if fits_mm < max(SMALLEST_MM, size_mm - _SMALLER_MM):
        return f"between the lines there is room for {max(room_mm, 0.0):.1f} mm"
    fitting_mm = float(min(size_mm, fits_mm))
    if room_mm - fitting_mm > 2 * (REACH_MM - _BESIDE_MM):
        return f"there is no wire within {REACH_MM:g} mm of it that it could be sewn to"
    for other in others:
        apart_mm = float(np.linalg.norm(other.at - at)) - (other.diameter_mm + fitting_mm) / 2
        if apart_mm < 2 * _BESIDE_MM:
            return "" if apart_mm < -fitting_mm / 2 else "another bead is in its place"
    return Bead(at, fitting_mm)
