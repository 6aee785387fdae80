"""What to have at hand: metal by thickness, the cut list, tools, and how hard and long the work is."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Final, Literal

from wrapit.config import GuideConfig, WireConfig
from wrapit.instructions.model import Chapter, Difficulty, Material, Page, Step, Tie
from wrapit.instructions.order.bead_words import beads_table
from wrapit.jig.bench.model import Bench
from wrapit.materials import METALS
from wrapit.pages.model import (
    Block,
    Duration,
    Facts,
    Length,
    Mass,
    Points,
    Table,
    Text,
    Thickness,
    listed,
    text,
)
from wrapit.wires.model import JumpRing, Wire

# How long hands take, in minutes: to get ready, to cut and begin a wire, for a step along it, a tie, a tail.
# A rule of thumb: the paper's participants all finished their pieces within half an hour.
READY_MIN, WIRE_MIN, STEP_MIN, TIE_MIN, TAIL_MIN = 4.0, 1.5, 0.5, 2.0, 0.5
# From so many steps and ties on a piece asks for patience, and from so many for experience.
MEDIUM_STEPS: Final = 25
HARD_STEPS: Final = 80
# From so many places that need a hand's help on, it asks for experience too.
HARD_CAUTIONS: Final = 6


def materials_of(
    wires: Sequence[Wire],
    ties: Sequence[Tie],
    ring: JumpRing | None,
    guide: GuideConfig,
    wire_config: WireConfig,
    pieces: int,
) -> tuple[Material, ...]:
    """The wires' metal by thickness, the thickest first; then that of ties and of the jump ring."""
    metal, materials = METALS[wire_config.metal], []

    def add(use: Literal["frame", "binding", "ring"], diameter_mm: float, length_mm: float) -> None:
        total_mm = pieces * length_mm
        materials.append(Material(use, diameter_mm, total_mm, metal.mass_g(total_mm, diameter_mm)))

    for diameter_mm in sorted({wire.diameter_mm for wire in wires}, reverse=True):
        add("frame", diameter_mm, sum(w.cut_length_mm for w in wires if w.diameter_mm == diameter_mm))
    if ties:
        add("binding", guide.binding_gauge, sum(tie.binding_mm for tie in ties))
    if ring is not None:
        add("ring", ring.diameter_mm, ring.length_mm)
    return tuple(materials)


def materials_page(
    materials: Sequence[Material],
    wires: Sequence[Wire],
    ring: JumpRing | None,
    wire_config: WireConfig,
    *,
    pieces: int,
    benches: Sequence[Bench],
    effort: tuple[Difficulty, float],
) -> Page:
    """For so many `pieces` (two are a pair)."""
    difficulty, minutes = effort
    facts = (
        (text("fact-difficulty"), text(f"difficulty-{difficulty}")),
        (text("fact-time"), text("time-about", time=Duration(minutes))),
    )
    blocks: tuple[Block, ...] = (
        _materials(materials, ring, wire_config, pieces),
        *beads_table(wires, pieces),
        _cut_list(wires, pieces),
        Points(tuple(_tools(benches))),
        Facts(facts),
    )
    return Page("materials", text("materials-title"), blocks)


def effort_of(
    chapters: Sequence[Chapter], wires: Sequence[Wire], ties: Sequence[Tie]
) -> tuple[Difficulty, float]:
    """How hard the work is, and about how many minutes it takes."""
    steps = [step for chapter in chapters for step in chapter.steps]
    along = sum(step.times for step in steps if step.wire)
    tails = 2 * len(wires)
    minutes = READY_MIN + WIRE_MIN * len(wires) + STEP_MIN * along + TIE_MIN * len(ties) + TAIL_MIN * tails
    return _difficulty(steps, along + len(ties)), minutes


def _difficulty(steps: Sequence[Step], amount: int) -> Difficulty:
    cautions = sum(len(step.cautions) for step in steps)
    if amount >= HARD_STEPS or cautions >= HARD_CAUTIONS:
        return "hard"
    return "medium" if amount >= MEDIUM_STEPS else "easy"


def _materials(
    materials: Sequence[Material], ring: JumpRing | None, wire_config: WireConfig, pieces: int
) -> Table:
    name = text(f"metal-{wire_config.metal.replace(' ', '-')}")
    temper = text(f"temper-{wire_config.temper.replace(' ', '-')}")

    def what(material: Material) -> Text:
        if material.use == "ring" and ring is not None:
            inside = Thickness(ring.inner_diameter_mm)
            return text("material-ring", metal=name, inside=inside, count=pieces)
        if material.use == "binding":
            return text("material-binding", metal=name)
        return text("material-frame", metal=name, temper=temper)

    rows = tuple(
        (
            what(each),
            text("thickness", value=Thickness(each.diameter_mm, wire=True)),
            text("length", value=Length(each.length_mm)),
            text("mass", value=Mass(each.mass_g)),
        )
        for each in materials
    )
    head = tuple(text(f"materials-head-{each}") for each in ("what", "thickness", "length", "weight"))
    return Table(text("materials-table"), head, rows)


def _cut_list(wires: Sequence[Wire], pieces: int) -> Table:
    rows = tuple(
        (
            text("wire-capital", wire=wire.number),
            text("cut-pieces", length=Length(wire.cut_length_mm), count=pieces),
            text("length", value=Length(wire.tail_mm)),
            text("length", value=Length(wire.length_mm)),
        )
        for wire in wires
    )
    head = tuple(text(f"cut-head-{each}") for each in ("wire", "cut", "tail", "shape"))
    return Table(text("cut-table"), head, rows)


def _tools(benches: Sequence[Bench]) -> Iterator[Text]:
    yield text("tools")
    if benches:
        yield text("tools-jig", count=len(benches), board="no" if benches[0].anchored else "yes")
        if len(benches) > 1:
            yield text("tools-jigs", names=listed(bench.name for bench in benches))
