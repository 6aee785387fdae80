"""The order of the whole work: jig after jig, wire after wire, lifting out, putting together, tying, ends."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from wrapit.config import GuideConfig, WireConfig
from wrapit.instructions.model import Chapter, Crossing, Step
from wrapit.instructions.order.crossings import crossings_in
from wrapit.instructions.order.guide_work import Work
from wrapit.instructions.order.putting_together import put_together
from wrapit.instructions.order.springing import springs_back
from wrapit.instructions.order.wire_steps import MANY_TIES, Laid, wire_steps
from wrapit.instructions.pictures import PRESENT, Scene, step_figure
from wrapit.jig.bench.model import NO_WALL, Bench
from wrapit.jig.made import MIRRORED, file_stem
from wrapit.jig.model import SameShape
from wrapit.pages.model import Figure, Length, Shared, Text, listed, text
from wrapit.wires.model import Wire


def chapters_of(
    work: Work, guide: GuideConfig, wire_config: WireConfig
) -> tuple[tuple[Chapter, ...], tuple[Scene, ...]]:
    """All chapters in the order of the work, and the scenes that their pictures show."""
    whole = Scene.of_piece(f"{work.prefix}piece", work.wires, work.ties)
    scenes = [whole]
    chapters: list[Chapter] = []
    groups: list[tuple[Wire, ...]] = []
    for number, bench in enumerate(work.benches, start=1):
        scene = Scene.of_bench(f"{work.prefix}jig{number}", bench)
        scenes.append(scene)
        made, lifted = _in_jig(work, bench, scene, wire_config)
        chapters += made
        groups += lifted
    made_there = {wire.number for group in groups for wire in group}
    for wire in work.wires:
        if wire.number not in made_there:
            chapters.append(_by_hand(work, wire, whole, wire_config))
            groups.append((wire,))
    together = tuple(put_together(work, groups, whole, guide))
    chapters = _said_once(chapters)
    chapters.append(
        Chapter(
            f"{work.prefix}together",
            text("chapter-together", which="other" if work.prefix else "first"),
            together,
        )
    )
    return tuple(chapters), tuple(scenes)


def _said_once(chapters: Sequence[Chapter]) -> list[Chapter]:
    """The same without telling of springing back again, where the wire before was told the same."""
    said: set[Text] = set()
    once = []
    for chapter in chapters:
        first = chapter.steps[0]
        kept = tuple(each for each in first.texts if each not in said)
        said |= {each for each in first.texts if each.key.startswith("spring-")}
        once.append(replace(chapter, steps=(replace(first, texts=kept), *chapter.steps[1:])))
    return once


def _in_jig(
    work: Work, bench: Bench, scene: Scene, wire_config: WireConfig
) -> tuple[list[Chapter], list[tuple[Wire, ...]]]:
    """The chapters of one jig, and what comes out of it at once each time."""
    chapters: list[Chapter] = []
    last = len(bench.wires) - 1
    crossed = crossings_in(bench.wires)
    for index, wire in enumerate(bench.wires):
        laid = _laid(work, wire, bench, bench.wires[:index], crossed[index])
        steps = list(wire_steps(laid, _overbend(work, wire, wire_config)))
        if index == 0:
            steps[0] = replace(steps[0], texts=(*_take(work, bench), *steps[0].texts))
        steps = [_pictured(step, wire, scene, laid) for step in steps]
        if index == last:
            steps.append(_lift(bench, scene))
        chapters.append(_chapter(work, wire, steps))
    groups = [tuple(work.named(wire.name) for wire in bench.wires)]
    for form in work.forms:
        like = next((wire for wire in bench.wires if wire.name == form.like), None)
        if like is not None:
            wire = work.named(form.wire)
            again = _again(wire, like, form, bench, scene)
            chapters.append(_chapter(work, wire, [again]))
            groups.append((wire,))
    return chapters, groups


def _laid(
    work: Work, wire: Wire, bench: Bench | None, earlier: Sequence[Wire], crossings: tuple[Crossing, ...]
) -> Laid:
    mine = tuple(finding for finding in work.findings if finding.wire == wire.name)
    ties = {tie.junction: tie for tie in work.ties}
    return Laid(wire, bench, tuple(earlier), ties, crossings, mine, work.bridges)


def _overbend(work: Work, wire: Wire, wire_config: WireConfig) -> tuple[Text, ...]:
    made_up = work.handling is not None and work.handling.overbent
    return (text("spring-made-up"),) if made_up else tuple(springs_back(wire, wire_config))


def _take(work: Work, bench: Bench) -> Iterator[Text]:
    """Which jig, and what goes into it before the first wire."""
    if len(work.benches) > 1 or work.of_pair:
        suffix = MIRRORED if work.prefix else ""
        yield text("take-jig", jig=file_stem(bench.name, len(work.benches)) + suffix)
    if bench.seats_mm:
        yield text("set-beads", count=len(bench.seats_mm), sizes=listed(map(Length, bench.seats_mm)))


def _pictured(step: Step, wire: Wire, scene: Scene, laid: Laid) -> Step:
    shown = step.ties if len(step.ties) <= MANY_TIES else ()
    ties = [tie for tie in laid.ties.values() if tie.letter in shown]
    earlier = [each.number for each in laid.earlier]
    return replace(step, figure=step_figure(scene, step, wire, earlier, ties))


def _chapter(work: Work, wire: Wire, steps: Sequence[Step]) -> Chapter:
    which = "other" if work.prefix else "first"
    heading = text("chapter-wire", wire=wire.number, wires=len(work.wires), which=which)
    return Chapter(f"{work.prefix}wire-{wire.number}", heading, tuple(steps))


def _lift(bench: Bench, scene: Scene) -> Step:
    numbers = [wire.number for wire in bench.wires]
    texts = [text("lift-press")]
    if len(numbers) > 1:
        texts.append(text("lift-tape"))
    texts.append(text("lift-anchored" if bench.anchored else "lift-board", count=len(numbers)))
    if bench.seats_mm:
        texts.append(text("lift-beads", count=len(bench.seats_mm)))
    shapes = [Shared(scene.key), *(scene.line(wire, PRESENT) for wire in bench.wires)]
    figure = Figure(scene.picture(shapes), text("picture-lift", wires=listed(numbers)))
    return Step("lift", text("heading-lift", count=len(numbers)), tuple(texts), figure=figure)


def _again(wire: Wire, like: Wire, form: SameShape, bench: Bench, scene: Scene) -> Step:
    """A wire that is made in the place of another: once more, then turned over where it is mirrored."""
    texts = [
        text("start-cut", cut=Length(wire.cut_length_mm), tail=Length(wire.tail_mm)),
        text("again-like", wire=like.number),
        text("again-lift"),
    ]
    if form.mirrored:
        texts.append(text("again-mirrored"))
    if form.reversed:
        texts.append(text("again-reversed"))
    whole = replace(
        Step("again", text("heading-again", wire=like.number), tuple(texts), wire=wire.number),
        end_mm=like.length_mm,
        walls=tuple(sorted({each.index for each in bench.contacts[like.name] if each.index != NO_WALL})),
    )
    return replace(whole, figure=step_figure(scene, whole, like, (), ()))


def _by_hand(work: Work, wire: Wire, whole: Scene, wire_config: WireConfig) -> Chapter:
    """A wire that no jig holds: bent over the print at true size."""
    # Nothing lies there yet but the wire's own beginning.
    laid = _laid(work, wire, None, (), crossings_in((wire,))[0])
    steps = [
        _pictured(step, wire, whole, laid) for step in wire_steps(laid, _overbend(work, wire, wire_config))
    ]
    return _chapter(work, wire, steps)
