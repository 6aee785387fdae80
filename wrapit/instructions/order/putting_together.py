"""Putting the piece together: laying what came out of the jigs in its place, ties, ends, and the ring."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Final

from wrapit.config import GuideConfig
from wrapit.instructions.model import Step, Tie
from wrapit.instructions.order.binding_order import Placement, assembly_order
from wrapit.instructions.order.guide_work import Work
from wrapit.instructions.pictures import Scene, piece_figure, tie_marks
from wrapit.pages.model import Length, Listed, Mark, Text, listed, text
from wrapit.wires.model import Wire

# A wire that ends this near a tie is wound round what it meets there; any other end is turned in.
AT_TIE_MM: Final = 2.0
# So many ties are made in one step: their letters stand on one picture, and a pause comes after them.
MOST_TIES: Final = 8
# What is left of a tail to turn in: round the tip of round-nose pliers.
TURNED_IN_MM: Final = 8.0


def put_together(
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
        # The tail of a loop to hang the piece from goes round the loop's neck, as its own step says.
        own = [True, True] if wire.bail is None else [wire.bail.start_mm > 0, wire.bail.start_mm <= 0]
        for tails, tied in ((wound, True), (turned, False)):
            mine = [free and each == tied for free, each in zip(own, at_tie, strict=True)]
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
