"""Decides what the guide says, before anything is drawn."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from wrapit.config import GuideConfig, WireConfig
from wrapit.decomposition.model import Solution, Traversal
from wrapit.drawing.model import Drawing
from wrapit.errors import Finding
from wrapit.geometry import BezierChain, FloatArray
from wrapit.instructions.binding_order import assembly_order, find_ties
from wrapit.instructions.model import Guide, Material, Step, Tie, WireSheet
from wrapit.instructions.wording import (
    BY_HAND,
    bend_at,
    caution,
    joint_phrase,
    listed,
    millimetres,
    shape_phrase,
    thickness,
)
from wrapit.jig.made import Handling
from wrapit.materials import METALS
from wrapit.wires.model import Bail, JumpRing, Wire

# Tighter bends spring back by less than a hand can tell: dead-soft copper of 1 mm by 0.8° at this radius.
LEAST_SPRINGY_RADIUS_MM = 5.0


def plan_guide(
    solution: Solution,
    wires: Sequence[Wire],
    guide_config: GuideConfig,
    wire_config: WireConfig,
    *,
    name: str,
    handling: Handling | None = None,
    findings: Sequence[Finding] = (),
    ring: JumpRing | None = None,
) -> Guide:
    """The guide for these wires, in their order; ties are lettered, wires numbered from 1."""
    drawing = solution.decomposition.drawing
    low, high = _bounds_mm(drawing, wires)
    turns = guide_config.binding_turns
    ties = find_ties(wires, guide_config.binding_gauge, turns)
    return Guide(
        name=name,
        size_mm=(
            float(high[0] - low[0]) + wire_config.gauge,
            float(high[1] - low[1]) + wire_config.gauge,
        ),
        metal=wire_config.metal,
        temper=wire_config.temper,
        materials=(*_materials(wires, ties, guide_config, wire_config), *_ring_material(ring, wire_config)),
        sheets=tuple(
            _sheet(
                number,
                wire,
                drawing,
                ties,
                wire_config,
                handling.jig_of.get(wire.name, "") if handling is not None else "",
                _form_of(wire, handling),
                overbent=handling is not None and handling.overbent,
                cautions=_cautions(wire, findings),
            )
            for number, wire in enumerate(wires, start=1)
        ),
        ties=ties,
        assembly=assembly_order(wires, ties),
        binding_turns=turns,
        ring=ring,
        seats=tuple(map(millimetres, handling.seats_mm)) if handling is not None else (),
    )


def _bounds_mm(drawing: Drawing, wires: Sequence[Wire]) -> tuple[FloatArray, FloatArray]:
    """Lower left and upper right corner of the centre lines, the bail's too."""
    low, high = drawing.bounds_mm
    for wire in wires:
        if wire.bail is not None:
            centre, radius = np.array(wire.bail.centre), (wire.bail.inner_diameter_mm + wire.diameter_mm) / 2
            low, high = np.minimum(low, centre - radius), np.maximum(high, centre + radius)
    return low, high


def _ring_material(ring: JumpRing | None, wire_config: WireConfig) -> tuple[Material, ...]:
    if ring is None:
        return ()
    mass_g = METALS[wire_config.metal].mass_g(ring.length_mm, ring.diameter_mm)
    inside = f"1 ring, {ring.inner_diameter_mm:g} mm inside; or bend one round a rod of that thickness"
    what = f"jump ring, {wire_config.metal}"
    return (Material(what, thickness(ring.diameter_mm), ring.length_mm, mass_g, inside),)


def _materials(
    wires: Sequence[Wire], ties: Sequence[Tie], guide: GuideConfig, wire_config: WireConfig
) -> tuple[Material, ...]:
    metal = METALS[wire_config.metal]
    materials = []
    for diameter_mm in sorted({wire.diameter_mm for wire in wires}, reverse=True):
        cut = [wire.cut_length_mm for wire in wires if wire.diameter_mm == diameter_mm]
        pieces = f"{len(cut)} piece{'s' if len(cut) > 1 else ''}: {listed([millimetres(c) for c in cut])}"
        materials.append(
            Material(
                f"frame wire, {wire_config.metal}, {wire_config.temper}",
                thickness(diameter_mm),
                sum(cut),
                metal.mass_g(sum(cut), diameter_mm),
                pieces,
            )
        )
    if ties:
        length_mm = sum(tie.binding_mm for tie in ties)
        materials.append(
            Material(
                f"binding wire, {wire_config.metal}, dead soft",
                thickness(guide.binding_gauge),
                length_mm,
                metal.mass_g(length_mm, guide.binding_gauge),
                f"{len(ties)} tie{'s' if len(ties) > 1 else ''} of {guide.binding_turns} turns",
            )
        )
    return tuple(materials)


def _sheet(
    number: int,
    wire: Wire,
    drawing: Drawing,
    ties: Sequence[Tie],
    wire_config: WireConfig,
    jig: str,
    form: tuple[int, bool] | None,
    overbent: bool,
    cautions: tuple[str, ...],
) -> WireSheet:
    by_junction = {tie.junction: tie for tie in ties}
    return WireSheet(
        number=number,
        wire=wire,
        thickness=thickness(wire.diameter_mm),
        tail_mm=(wire.cut_length_mm - wire.length_mm) / 2,
        jig=jig,
        same_as=_same_as(form),
        hole=number if form is None else form[0],
        overbend=_overbend(wire, wire_config, overbent),
        steps=_steps(number, wire, drawing, by_junction),
        cautions=cautions,
        ties=tuple((by_junction[binding.junction], binding.at_mm) for binding in wire.bindings),
    )


def _cautions(wire: Wire, findings: Sequence[Finding]) -> tuple[str, ...]:
    """What the hand must do along a wire that its jig doesn't do, in the order of the wire."""
    mine = [finding for finding in findings if finding.wire == wire.name and finding.code in BY_HAND]
    return tuple(map(caution, sorted(mine, key=lambda finding: finding.places_mm)))


def _form_of(wire: Wire, handling: Handling | None) -> tuple[int, bool] | None:
    """The number of the wire on whose form this one is made, and whether it is turned over then."""
    if handling is None or wire.name not in handling.same_as:
        return None
    like, mirrored = handling.same_as[wire.name]
    return int(like.rsplit("-", 1)[1]), mirrored


def _same_as(form: tuple[int, bool] | None) -> str:
    """Which form serves a wire that has the shape of another."""
    if form is None:
        return ""
    like, mirrored = form
    made = f"It has the shape of wire {like}: make it on the same form"
    return f"{made}, and turn it over when it is bent." if mirrored else f"{made}."


def _steps(number: int, wire: Wire, drawing: Drawing, ties: dict[int, Tie]) -> tuple[Step, ...]:
    steps: list[Step] = []
    before: BezierChain | None = None
    bail_first = wire.bail is not None and wire.bail.start_mm <= 0
    if wire.bail is not None and bail_first:
        steps.append(_bail_step(1, wire.bail))
    spans = zip(wire.traversals, wire.segment_spans_mm, strict=True)
    for index, (traversal, (start, end)) in enumerate(spans):
        curve = drawing.segments[traversal.segment].curve
        curve = curve.reversed() if traversal.reversed else curve
        shape = shape_phrase(curve)
        if before is None:
            action = f"From the neck of the loop, {shape}" if bail_first else f"From the start mark, {shape}"
        elif traversal.segment in {run.segment for run in wire.traversals[:index]}:
            turn = joint_phrase(bend_at(before.end_tangent, curve.start_tangent))
            action = f"{turn} and lay the wire back close along the stretch that it ran before"
        else:
            action = f"{joint_phrase(bend_at(before.end_tangent, curve.start_tangent))}, then {shape}"
        arrival = _arrival(
            number,
            _end(drawing, traversal),
            ties,
            last=index + 1 == len(wire.traversals) and (wire.bail is None or bail_first),
        )
        steps.append(Step(len(steps) + 1, start, end, action.rstrip(",") + ".", arrival))
        before = curve
    if wire.bail is not None and not bail_first:
        steps.append(_bail_step(len(steps) + 1, wire.bail))
    return tuple(steps)


def _bail_step(number: int, bail: Bail) -> Step:
    around = f"round a rod of {millimetres(bail.inner_diameter_mm)} or the post in the jig"
    wrap = "wrap it twice round the neck when the piece is together."
    if number == 1 and bail.start_mm <= 0:
        action = f"From the start mark, bend the loop to hang the piece from {around}, and then its neck."
        return Step(number, bail.start_mm, bail.end_mm, action, f"Leave the tail; {wrap}")
    action = f"Bend the neck, and the loop to hang the piece from {around}, until it touches the neck again."
    return Step(number, bail.start_mm, bail.end_mm, action, f"The wire ends here; leave the tail, and {wrap}")


def _end(drawing: Drawing, traversal: Traversal) -> int:
    segment = drawing.segments[traversal.segment]
    return segment.start if traversal.reversed else segment.end


def _arrival(number: int, junction: int, ties: dict[int, Tie], *, last: bool) -> str:
    tie = ties.get(junction)
    place = ""
    if tie is not None:
        others = [f"wire {other}" for other in tie.wires if other != number]
        place = f"This is point {tie.letter}, where it will be tied to {listed(others or ['itself'])}."
    return f"{place} The wire ends here; leave the tail.".strip() if last else place


def _overbend(wire: Wire, wire_config: WireConfig, overbent: bool) -> str:
    """How far to bend beyond the shape, because the metal springs back when it is let go."""
    if overbent:
        return (
            "The jig bends the wire a little further than the pictures show, by what the metal springs "
            "back: press it close to the walls, then lift it out and let it go."
        )
    curvature = max((turn.max_curvature_per_mm for turn in wire.turns), default=0.0)
    if curvature <= 0:
        return ""
    loss = METALS[wire_config.metal].springback_per_mm(wire.diameter_mm, wire_config.temper)
    # Tighter bends spring back less than a hand can tell.
    radius_mm = min(max(1 / curvature, LEAST_SPRINGY_RADIUS_MM), 50.0)
    degrees = round(math.degrees(math.pi / 2 * loss * radius_mm))
    if degrees < 1:
        return ""
    return (
        f"The metal springs back a little: bend a right angle with a radius of {radius_mm:.0f} mm "
        f"about {degrees}° further than you need."
    )
