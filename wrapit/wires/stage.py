"""The wires of a decomposition, ready to be bent."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from wrapit.config import Config
from wrapit.decomposition.json_file import wire_name
from wrapit.decomposition.model import Solution
from wrapit.errors import Finding
from wrapit.fit.limits import corner_radius_mm, least_radius_mm
from wrapit.fit.model import Bead
from wrapit.geometry import from_chain
from wrapit.geometry.arclength import ArcLength
from wrapit.materials import METALS
from wrapit.wires.bail import with_bail
from wrapit.wires.beside.double_runs import double_runs
from wrapit.wires.beside.pair_ties import with_pair_ties
from wrapit.wires.beside.stage import APART, lay_beside
from wrapit.wires.centreline import Joined
from wrapit.wires.model import Wire
from wrapit.wires.palette import wire_colour
from wrapit.wires.rounding import FOLD_RAD
from wrapit.wires.stacking import lay_wires, layers_of
from wrapit.wires.strung.threading import with_beads
from wrapit.wires.ties import find_bindings
from wrapit.wires.turns import find_turns

CURVATURE_STEP_MM = 0.02  # the tightest bends of our drawings are the same with 0.014 and 0.026
MIN_MARGIN_SHARE = 0.15  # of the length, for holding and bending


def draw_wires(
    solution: Solution, config: Config, beads: Sequence[Bead] = ()
) -> tuple[tuple[Wire, ...], tuple[Finding, ...]]:
    """Each trail as one exact cubic B-spline with turns, lengths, connections and heights.

    Corners tighter than the metal allows, or than a post of the jig, are rounded; findings name bends that
    can't be made. Two runs along the same lines lie side by side. With a bail, the end of one wire goes on
    into its loop. Beads are put on the wires.
    """
    drawing, wire = solution.decomposition.drawing, config.wire
    radius_mm, corner_mm = least_radius_mm(config), corner_radius_mm(config)
    beside = lay_beside(drawing, solution.trails, wire.gauge, corner_mm)
    joined, bails, said = with_bail(beside.joined, drawing, config)
    names = [wire_name(index) for index in range(len(joined))]
    splines = [from_chain(each.chain) for each in joined]
    bindings = find_bindings(drawing, solution.trails, names, [each.spans_mm for each in joined])
    doubles = double_runs(beside.stretches, splines, [each.spans_mm for each in joined], APART * wire.gauge)
    lifts = lay_wires(splines, wire.gauge, doubles)
    findings: list[Finding] = [*said, *beside.findings]
    wires = []
    for index, (name, trail, each, spline, moved_mm) in enumerate(
        zip(names, solution.trails, joined, splines, beside.moved_mm, strict=True)
    ):
        turns, slight = find_turns(name, spline, config.jig)
        lengths = ArcLength(spline)
        min_radius_mm, tight = _tightest(name, each, lengths, radius_mm, wire.gauge)
        findings += [*tight, *slight]
        length_mm = lengths.total_mm
        margin_mm = max(config.guide.margin, MIN_MARGIN_SHARE * length_mm)
        wires.append(
            Wire(
                number=index + 1,
                centreline=spline,
                diameter_mm=wire.gauge,
                length_mm=length_mm,
                cut_length_mm=length_mm + margin_mm,
                traversals=trail.traversals,
                segment_spans_mm=each.spans_mm,
                turns=turns,
                bindings=bindings[index],
                min_bend_radius_mm=min_radius_mm,
                max_deviation_from_drawing_mm=max([moved_mm, *(c.deviation_mm for c in each.corners)]),
                layers=layers_of(lifts[index], wire.gauge),
                mass_g=METALS[wire.metal].mass_g(length_mm, wire.gauge),
                closed=trail.closed,
                colour=wire_colour(index),
                lifts=lifts[index],
                bail=bails.get(index),
                doubles=doubles[index],
            )
        )
    tied = with_pair_ties(wires, len(drawing.junctions))
    return with_beads(tied, beads), tuple(findings)


def _tightest(
    name: str, joined: Joined, lengths: ArcLength, allowed_mm: float, diameter_mm: float
) -> tuple[float, tuple[Finding, ...]]:
    """Smallest bend radius of the centreline; a finding for each span that the metal doesn't take.

    Bent tighter than its own radius a wire would lie in itself: that is an error.
    """
    at_mm = lengths.stations(CURVATURE_STEP_MM)
    curvature = np.abs(lengths.spline.curvature(lengths.parameter((at_mm[:-1] + at_mm[1:]) / 2)))
    spans = np.flatnonzero(np.diff(np.r_[0, curvature > 1.01 / allowed_mm, 0])).reshape(-1, 2)
    findings = [
        Finding(
            "error" if bend_mm < diameter_mm / 2 else "warning",
            "tight-bend",
            f"{name} at {at_mm[(a + b) // 2]:.0f} mm",
            f"the drawing asks for a bend of radius {bend_mm:.2f} mm; "
            f"this wire takes {allowed_mm:.2f} mm without damage",
            "make the piece larger, or use thinner or softer wire",
            severity=allowed_mm / bend_mm,
        )
        for a, b in spans
        for bend_mm in [1 / float(curvature[a:b].max())]
    ]
    radius = 1 / max(float(curvature.max()), 1e-9)
    return min(radius, *(c.radius_mm for c in joined.corners if c.bend_rad < FOLD_RAD), 1e6), tuple(findings)
