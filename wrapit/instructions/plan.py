"""Decides what the guide says and shows, before it has a language or a medium."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from wrapit.config import GuideConfig, WireConfig
from wrapit.errors import Finding
from wrapit.geometry.bspline import chain_of
from wrapit.instructions.materials_page import effort_of, materials_of, materials_page
from wrapit.instructions.model import Chapter, Guide, Page
from wrapit.instructions.order.binding_order import find_ties
from wrapit.instructions.order.guide_work import Work
from wrapit.instructions.order.laying import chapters_of
from wrapit.instructions.order.ruler_strips import strips_of
from wrapit.instructions.pictures import Scene, cover_figure, true_size_picture
from wrapit.jig.bench.model import Handling
from wrapit.jig.made import GuidePage
from wrapit.pages.model import Length, Paragraph, text
from wrapit.wires.mirror import mirrored, mirrored_ring
from wrapit.wires.model import JumpRing, Wire

# What the anchors of the other one of a pair begin with.
OTHER: Final = "other-"


@dataclass(frozen=True, eq=False)
class Held:
    """The jigs that hold wires in the guide's steps, and what was found of them."""

    handling: Handling | None = None
    findings: tuple[Finding, ...] = ()


def plan_guide(
    wires: Sequence[Wire],
    guide_config: GuideConfig,
    wire_config: WireConfig,
    *,
    name: str,
    held: Held,
    other: Held | None = None,
    pages: Sequence[GuidePage] = (),
    ring: JumpRing | None = None,
    bridges: frozenset[int] = frozenset(),
) -> Guide:
    """The guide for these wires, in their order; ties are lettered.

    `other` is that of the mirror image, for a pair; `bridges` are segments that the
    drawing didn't have. Raises ValueError when there are no wires.
    """
    if not wires:
        raise ValueError("a guide needs at least one wire")
    ties = find_ties(wires, guide_config.binding_gauge, guide_config.binding_turns)
    pair = other is not None
    first = Work("", tuple(wires), held.handling, ties, held.findings, ring, bridges, of_pair=pair)
    chapters, scenes = chapters_of(first, guide_config, wire_config)
    strips = strips_of(wires, first.forms, chapters, ties)
    effort = effort_of(chapters, wires, ties)
    if other is not None:
        more, more_scenes = _other(first, other, guide_config, wire_config)
        chapters, scenes = (*chapters, *more), (*scenes, *more_scenes)
        effort = effort[0], 2 * effort[1]
    pieces = 1 if other is None else 2
    materials = materials_of(wires, ties, ring, guide_config, wire_config, pieces)
    at_hand = materials_page(
        materials,
        wires,
        ring,
        wire_config,
        pieces=pieces,
        benches=first.benches,
        effort=effort,
    )
    width, height = size_mm(wires)
    lead = text("lead", wires=len(wires), ties=len(ties), x=Length(width), y=Length(height), pieces=pieces)
    whole = scenes[0]
    caption = text("cover-caption", ring="yes" if ring is not None else "no")
    return Guide(
        name=name,
        lead=lead,
        cover=cover_figure(whole, text("cover-picture"), caption, ring),
        true_size=true_size_picture(whole, ties),
        pages=(*_jig_pages(pages), at_hand),
        chapters=tuple(chapters),
        ties=ties,
        strips=strips,
        wires=tuple(wires),
        shared={key: shapes for scene in scenes for key, shapes in scene.shared.items()},
        materials=materials,
        difficulty=effort[0],
        minutes=effort[1],
    )


def _jig_pages(pages: Sequence[GuidePage]) -> Iterator[Page]:
    """The pages of all kinds of jigs; those after the first say that one kind is enough."""
    for page in pages:
        alone = page is pages[0]
        enough = () if alone else (Paragraph(text("other-jig", title=pages[0].title)),)
        yield Page(page.anchor, page.title, (*enough, *page.blocks))


def _other(
    first: Work, other: Held, guide_config: GuideConfig, wire_config: WireConfig
) -> tuple[tuple[Chapter, ...], tuple[Scene, ...]]:
    """The mirror image, made in jigs of its own with the same letters at the same ties."""
    wires = mirrored(first.wires)
    points = {binding.junction: binding.point for wire in wires for binding in wire.bindings}
    ties = tuple(replace(tie, point=points[tie.junction]) for tie in first.ties)
    work = replace(
        first,
        prefix=OTHER,
        wires=wires,
        handling=other.handling,
        ties=ties,
        findings=other.findings,
        ring=mirrored_ring(first.ring),
    )
    return chapters_of(work, guide_config, wire_config)


def size_mm(wires: Sequence[Wire]) -> tuple[float, float]:
    """Width and height of the finished piece, its wires' thickness and loops to hang it from included."""
    clouds = [chain_of(wire.centreline).sampled(0.05) for wire in wires]
    low = np.min([cloud.min(axis=0) for cloud in clouds], axis=0)
    high = np.max([cloud.max(axis=0) for cloud in clouds], axis=0)
    thick = max(wire.diameter_mm for wire in wires)
    return float(high[0] - low[0]) + thick, float(high[1] - low[1]) + thick
