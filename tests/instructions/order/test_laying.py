"""The whole work in an order that hands can follow: made, lifted, laid, tied, each once."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

import pytest

from tests.exports.pieces_for_tests import eye, woven
from tests.instructions.order.test_binding_order import star
from tests.instructions.order.test_wire_steps import values_in
from tests.instructions.order.walks import PLANNED, Part, bench_by_hand, planned, wire_along
from wrapit.config import GuideConfig, WireConfig
from wrapit.errors import Finding
from wrapit.instructions.model import Chapter, Step
from wrapit.instructions.order.binding_order import find_ties
from wrapit.instructions.order.guide_work import Work
from wrapit.instructions.order.laying import chapters_of
from wrapit.instructions.plan import OTHER, Held, plan_guide
from wrapit.jig.bench.model import Handling
from wrapit.jig.model import SameShape
from wrapit.pages.model import Listed, Text
from wrapit.wires.mirror import mirrored
from wrapit.wires.model import JumpRing, Turn, Wire

CONFIG, WIRE = GuideConfig(), WireConfig()
RING = JumpRing((0.0, 0.0), (0.0, 1.0), 0.0, 4.0, 0.8, True)


def work_of(
    wires: Sequence[Wire],
    handling: Handling | None,
    *,
    findings: Sequence[Finding] = (),
    ring: JumpRing | None = None,
) -> Work:
    ties = find_ties(wires, CONFIG.binding_gauge, CONFIG.binding_turns)
    return Work("", tuple(wires), handling, ties, tuple(findings), ring)


def chapters(work: Work) -> tuple[Chapter, ...]:
    return chapters_of(work, CONFIG, WIRE)[0]


def value(said: Text, name: str) -> object:
    return dict(said.values)[name]


def numbers(value: object) -> list[int]:
    """Of the wires in a list of them."""
    assert isinstance(value, Listed)
    return [number for item in value.items if isinstance(item, Text) for _, number in item.values]  # type: ignore[misc]


def check(work: Work) -> list[Step]:
    """What holds of any work; returns its steps."""
    told = chapters(work)
    steps = [step for chapter in told for step in chapter.steps]
    everything = sorted(wire.number for wire in work.wires)
    assert len({chapter.anchor for chapter in told}) == len(told)
    made_at = {step.wire: place for place, step in enumerate(steps) if step.kind in ("end", "again")}
    begun = [step.wire for step in steps if step.kind in ("start", "again")]
    assert sorted(begun) == everything == sorted(made_at)
    check_lifting(work, steps)
    laid_at: dict[int, int] = {}
    placing = [(place, step) for place, step in enumerate(steps) if step.kind == "place"]
    for place, step in placing:
        for number in numbers(value(step.heading, "wires")):
            assert number not in laid_at
            assert made_at[number] < place
            laid_at[number] = place
    if placing:
        assert sorted(laid_at) == everything
    tied: list[str] = []
    for place, step in enumerate(steps):
        if step.kind == "tie":
            for tie in (tie for tie in work.ties if tie.letter in step.ties):
                assert all(laid_at.get(number, made_at[number]) < place for number in tie.wires)
                assert value(step.texts[1], "strands") == tie.passes
            tied += step.ties
    assert sorted(tied) == sorted(tie.letter for tie in work.ties)
    rest = [step.kind for step in steps if step.kind in ("ends", "ring")]
    assert rest == ["ends", *["ring"] * (work.ring is not None)]
    assert steps[-len(rest) :] == [step for step in steps if step.kind in ("ends", "ring")]
    assert all(step.figure is not None for step in steps)
    return steps


def check_lifting(work: Work, steps: Sequence[Step]) -> None:
    """Each jig is emptied right after its last wire, which says how many come out."""
    kinds = [(step.kind, step.wire) for step in steps]
    assert [kind for kind, _ in kinds].count("lift") == len(work.benches)
    for bench in work.benches:
        place = kinds.index(("end", bench.wires[-1].number))
        assert steps[place + 1].kind == "lift"
        count = len(bench.wires)
        assert value(steps[place + 1].heading, "count") == count
        assert any(text.key == "lift-tape" for text in steps[place + 1].texts) == (count > 1)
        ends = [kinds.index(("end", wire.number)) for wire in bench.wires]
        assert ends == sorted(ends)
    for step in steps:
        for said in step.texts:
            if said.key in ("start-hole", "start-unmarked", "end-same-hole"):
                assert value(said, "hole") == step.wire


@pytest.mark.parametrize("name", PLANNED)
def test_in_jigs_that_are_planned(name: str) -> None:
    handling = planned(name)
    wires = [wire for bench in handling.benches for wire in bench.wires]
    made = {wire.name for wire in wires}
    assert all(form.like in made for form in handling.forms)
    if not handling.forms:
        check(work_of(sorted(wires, key=lambda wire: wire.number), handling))


@pytest.mark.parametrize("sizes", [(6,), (3, 3), (1, 2, 2), (1, 1, 1, 1, 1, 1), ()])
def test_over_several_jigs_and_by_hand(sizes: tuple[int, ...]) -> None:
    wires = star(5)
    benches, first = [], 0
    for index, size in enumerate(sizes):
        benches.append(bench_by_hand(wires[first : first + size], (), f"jig-{index + 1}"))
        first += size
    steps = check(work_of(wires, Handling(tuple(benches)) if benches else None, ring=RING))
    taken = [value(text, "jig") for step in steps for text in step.texts if text.key == "take-jig"]
    assert taken == ([bench.name for bench in benches] if len(benches) > 1 else [])
    by_hand = [step for step in steps if any(text.key == "start-hand" for text in step.texts)]
    assert [step.wire for step in by_hand] == [wire.number for wire in wires[first:]]


def test_nothing_is_laid_in_place_where_all_came_out_together() -> None:
    wires = woven(2)
    steps = check(work_of(wires, Handling((bench_by_hand(wires, ()),))))
    assert not [step for step in steps if step.kind == "place"]


@pytest.mark.parametrize("is_mirrored", [False, True])
@pytest.mark.parametrize("is_reversed", [False, True])
def test_a_wire_of_the_same_shape_is_made_in_the_same_place(is_mirrored: bool, is_reversed: bool) -> None:
    first = wire_along((Part(20), Part(6, 120, walled=True), Part(9)))
    second = replace(first, number=2)
    form = SameShape(second.name, first.name, is_mirrored, is_reversed)
    steps = check(work_of((first, second), Handling((bench_by_hand((first,), ()),), (form,))))
    (again,) = (step for step in steps if step.kind == "again")
    assert again.wire == 2
    keys = [text.key for text in again.texts]
    assert keys[:3] == ["start-cut", "again-like", "again-lift"]
    assert ("again-mirrored" in keys, "again-reversed" in keys) == (is_mirrored, is_reversed)
    assert value(again.texts[1], "wire") == 1
    assert steps.index(again) > next(place for place, step in enumerate(steps) if step.kind == "lift")


def test_beads_are_set_before_the_first_wire_and_named_when_lifted() -> None:
    wires = star(2)
    bench = replace(bench_by_hand(wires, ()), seats_mm=(4.0, 6.0))
    steps = check(work_of(wires, Handling((bench,))))
    assert steps[0].texts[0].key == "set-beads"
    (lift,) = (step for step in steps if step.kind == "lift")
    assert "lift-beads" in [text.key for text in lift.texts]


def test_findings_are_told_at_their_wire_alone() -> None:
    wires = star(3)
    found = [Finding("warning", "strays", "there", "so", wire=wires[1].name, places_mm=(5.0,))]
    steps = check(work_of(wires, Handling((bench_by_hand(wires, ()),)), findings=found))
    assert [step.wire for step in steps if step.cautions] == [2]


OTHERS = {"left": "right", "right": "left"}


@pytest.mark.parametrize("name", ["eye", "woven", "hairpin"])
def test_the_other_of_a_pair_is_the_mirror_image(name: str) -> None:
    handling = planned(name)
    (bench,) = handling.benches
    flipped = tuple(
        replace(bench, wires=mirrored(bench.wires), contacts=contacts)
        for contacts in [
            {
                wire: tuple(replace(each, side=OTHERS[each.side]) for each in mine)
                for wire, mine in bench.contacts.items()
            }
        ]
    )
    guide = plan_guide(
        bench.wires, CONFIG, WIRE, name="pair", held=Held(handling), other=Held(Handling(flipped))
    )
    half = len(guide.chapters) // 2
    assert len(guide.chapters) == 2 * half
    ours, others = guide.chapters[:half], guide.chapters[half:]
    for chapter, other in zip(ours, others, strict=True):
        assert other.anchor == OTHER + chapter.anchor
        assert value(other.heading, "which") == "other"
        assert [step.kind for step in other.steps] == [step.kind for step in chapter.steps]
        for step, there in zip(chapter.steps, other.steps, strict=True):
            assert [exchanged(text) for text in there.texts] == [spoken(text) for text in step.texts]
            assert there.ties == step.ties
    jigs = [[value(text, "jig") for step in half for text in step.texts if text.key == "take-jig"] for half in
            ([step for chapter in side for step in chapter.steps] for side in (ours, others))]  # fmt: skip
    assert jigs == [["jig"], ["jig-mirrored"]]


def spoken(said: Text) -> list[object]:
    return [said.key, *(one for one in map(plain, values_in(said)) if one is not None)]


def exchanged(said: Text) -> list[object]:
    """The same with sides and ways of the mirror image."""

    def other(one: object) -> object:
        if not isinstance(one, str):
            return one
        there = one.removesuffix("-mirrored")
        return re.sub("left|right", lambda found: OTHERS[found.group()], there)

    return [other(one) for one in spoken(said)]


def plain(value: object) -> object:
    """Words and whole numbers; lengths differ by rounding, and are checked along the wire."""
    if isinstance(value, Text):
        return value.key
    return value if isinstance(value, str | int) else None


def test_springing_back_is_told_once_for_wires_alike() -> None:
    first, second = eye()[1]
    bent = [replace(wire, turns=(Turn(wire.name, 1, 2, "left", 0.1),)) for wire in (first, second)]
    steps = check(work_of(bent, Handling((bench_by_hand(bent, ()),))))
    assert sum(text.key == "spring-further" for step in steps for text in step.texts) == 1
    overbent = Handling((bench_by_hand(bent, ()),), overbent=True)
    steps = check(work_of(bent, overbent))
    told = [text.key for step in steps for text in step.texts if text.key.startswith("spring-")]
    assert told == ["spring-made-up"]


def test_ends_are_wound_at_ties_turned_in_where_free_and_closed_where_they_meet() -> None:
    wires = star(2)
    steps = check(work_of(wires, None))
    (ends,) = (step for step in steps if step.kind == "ends")
    assert [text.key for text in ends.texts] == ["ends-wound", "ends-turned", "ends-binding"]
    wound, turned = ends.texts[0], ends.texts[1]
    tails = [(one.key, dict(one.values)["wire"]) for text in (wound, turned) for one in items(text)]
    assert sorted(tails) == [
        ("tail-both", 2), ("tail-end", 1), ("tail-end", 3), ("tail-start", 1), ("tail-start", 3),
    ]  # fmt: skip


def items(said: Text) -> list[Text]:
    tails = value(said, "tails")
    assert isinstance(tails, Listed)
    return [item for item in tails.items if isinstance(item, Text)]
