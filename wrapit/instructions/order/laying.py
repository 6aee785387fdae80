"""The order of the whole work: jig after jig, wire after wire, lifting out, putting together, tying, ends."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Final

from wrapit.config import GuideConfig, WireConfig
from wrapit.errors import Finding
from wrapit.instructions.model import Chapter, Step, Tie
from wrapit.instructions.order.binding_order import Placement, assembly_order
from wrapit.instructions.order.crossings import crossings_over
from wrapit.instructions.order.springing import springs_back
from wrapit.instructions.order.wire_steps import MANY_TIES, Laid, wire_steps
from wrapit.instructions.pictures import PRESENT, Scene, piece_figure, step_figure, tie_marks
from wrapit.jig.bench.model import Bench, Handling
from wrapit.jig.made import MIRRORED, file_stem
from wrapit.jig.model import SameShape
from wrapit.pages.model import Figure, Length, Listed, Mark, Shared, Text, listed, text
from wrapit.wires.model import JumpRing, Wire

# A wire that ends this near a tie is wound round what it meets there; any other end is turned in.
AT_TIE_MM: Final = 2.0
# So many ties are made in one step: their letters stand on one picture, and a pause comes after them.
MOST_TIES: Final = 8
# What is left of a tail to turn in: round the tip of round-nose pliers.
TURNED_IN_MM: Final = 8.0


@dataclass(frozen=True, eq=False)
class Work:
    """What is laid: the piece's wires, the jigs with theirs, ties, and what was found of the jigs.

    `prefix` begins the anchors and picture keys: the other one of a pair has its own. `bridges` are segments
    that the drawing didn't have.
    """

    prefix: str
    wires: tuple[Wire, ...]
    handling: Handling | None
    ties: tuple[Tie, ...]
    findings: tuple[Finding, ...]
    ring: JumpRing | None
    bridges: frozenset[int] = frozenset()

    @property
    def benches(self) -> tuple[Bench, ...]:
        """The jigs."""
        return self.handling.benches if self.handling is not None else ()

    @property
    def forms(self) -> tuple[SameShape, ...]:
        """Wires that are made in another's place."""
        return self.handling.forms if self.handling is not None else ()

    def named(self, name: str) -> Wire:
        """The wire of the piece with this name."""
        return next(wire for wire in self.wires if wire.name == name)


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
    together = tuple(_together(work, groups, whole, guide))
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
    for index, wire in enumerate(bench.wires):
        laid = _laid(work, wire, bench, bench.wires[:index])
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


def _laid(work: Work, wire: Wire, bench: Bench | None, earlier: Sequence[Wire]) -> Laid:
    mine = tuple(finding for finding in work.findings if finding.wire == wire.name)
    ties = {tie.junction: tie for tie in work.ties}
    # By hand nothing lies there yet but the wire's own beginning.
    return Laid(wire, bench, tuple(earlier), ties, crossings_over(wire, earlier), mine, work.bridges)


def _overbend(work: Work, wire: Wire, wire_config: WireConfig) -> tuple[Text, ...]:
    made_up = work.handling is not None and work.handling.overbent
    return (text("spring-made-up"),) if made_up else tuple(springs_back(wire, wire_config))


def _take(work: Work, bench: Bench) -> Iterator[Text]:
    """Which jig, and what goes into it before the first wire."""
    if len(work.benches) > 1 or work.prefix:
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
    tail_mm = (wire.cut_length_mm - wire.length_mm) / 2
    texts = [
        text("start-cut", cut=Length(wire.cut_length_mm), tail=Length(tail_mm)),
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
        walls=tuple(sorted({contact.index for contact in bench.contacts[like.name]})),
    )
    return replace(whole, figure=step_figure(scene, whole, like, (), ()))


def _by_hand(work: Work, wire: Wire, whole: Scene, wire_config: WireConfig) -> Chapter:
    """A wire that no jig holds: bent over the print at true size."""
    laid = _laid(work, wire, None, ())
    steps = [
        _pictured(step, wire, whole, laid) for step in wire_steps(laid, _overbend(work, wire, wire_config))
    ]
    return _chapter(work, wire, steps)


def _together(
    work: Work, groups: Sequence[tuple[Wire, ...]], whole: Scene, guide: GuideConfig
) -> Iterator[Step]:
    """Laying what came out of the jigs in its place, ties as soon as they can be made, then ends and ring."""
    marks = tie_marks(whole, work.ties)
    placed: list[int] = []
    order = assembly_order(groups, work.ties)
    for index, placement in enumerate(order):
        if len(order) > 1:
            yield _placed(placement, whole, placed, index)
        placed += placement.wires
        by_size: dict[tuple[int, float], list[Tie]] = {}
        for tie in placement.ties:
            by_size.setdefault((tie.passes, round(tie.binding_mm)), []).append(tie)
        for ties in (
            alike[first : first + MOST_TIES]
            for alike in by_size.values()
            for first in range(0, len(alike), MOST_TIES)
        ):
            yield _tied(ties, whole, placed, [marks[tie.letter] for tie in ties], guide)
    yield _ends(work, whole)
    if work.ring is not None:
        figure = piece_figure(whole, text("picture-ring"), laid=placed, ring=work.ring)
        yield Step("ring", text("heading-ring"), (text("ring-open"),), figure=figure)


def _placed(placement: Placement, whole: Scene, placed: Sequence[int], index: int) -> Step:
    wires = _wires(placement.wires)
    count = len(placement.wires)
    if index == 0:
        said = text("place-first", wires=wires, count=count)
    elif placement.joins:
        said = text("place-joined", wires=wires, count=count, others=_wires(placement.joins))
    else:
        said = text("place-alone", wires=wires, count=count)
    figure = piece_figure(whole, text("picture-place", wires=wires), laid=placed, now=placement.wires)
    return Step("place", text("heading-place", wires=wires), (said,), figure=figure)


def _tied(
    ties: Sequence[Tie], whole: Scene, placed: Sequence[int], marks: Sequence[Mark], guide: GuideConfig
) -> Step:
    letters = tuple(tie.letter for tie in ties)
    places = listed(
        text("tie-wires", letter=tie.letter, wires=_wires(tie.wires))
        if len(tie.wires) > 1
        else text("tie-itself", letter=tie.letter, wire=tie.wires[0])
        for tie in ties
    )
    texts = (
        text("tie-where", places=places),
        text(
            "tie-how",
            count=len(ties),
            turns=guide.binding_turns,
            length=Length(ties[0].binding_mm),
            strands=ties[0].passes,
        ),
    )
    figure = piece_figure(whole, text("picture-tie", letters=listed(letters)), laid=placed, marks=marks)
    heading = text("heading-tie", letters=listed(letters))
    return Step("tie", heading, texts, ties=letters, figure=figure)


def _ends(work: Work, whole: Scene) -> Step:
    """What becomes of each tail: wound round what it meets at a tie, else turned in."""
    closed: list[int] = []
    wound: list[Text] = []
    turned: list[Text] = []
    for wire in work.wires:
        if wire.closed:
            closed.append(wire.number)
            continue
        at_tie = [
            any(abs(binding.at_mm - end_mm) < AT_TIE_MM for binding in wire.bindings)
            for end_mm in (0.0, wire.length_mm)
        ]
        for tails, mine in ((wound, at_tie), (turned, [not each for each in at_tie])):
            if any(mine):
                which = "both" if all(mine) else "start" if mine[0] else "end"
                tails.append(text(f"tail-{which}", wire=wire.number))
    texts = [text("ends-straighten")] if any(bench.anchored for bench in work.benches) else []
    if closed:
        texts.append(text("ends-closed", wires=_wires(closed), count=len(closed)))
    left = Length(TURNED_IN_MM)
    for key, tails in (("wound", wound), ("turned", turned)):
        if tails:
            alone = not (turned if tails is wound else wound) and not closed
            said = (
                text(f"ends-{key}-all", left=left)
                if alone
                else text(f"ends-{key}", tails=listed(tails), left=left)
            )
            texts.append(said)
    if work.ties:
        texts.append(text("ends-binding"))
    everything = [wire.number for wire in work.wires]
    figure = piece_figure(whole, text("picture-finished"), laid=everything)
    return Step("ends", text("heading-ends"), tuple(texts), figure=figure)


def _wires(numbers: Sequence[int]) -> Listed:
    return listed(text("wire-number", wire=number) for number in numbers)
