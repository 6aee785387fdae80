"""Steps cover the wire from start to end, and tell each crossing, tie and finding on its way once."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable, Iterator, Sequence

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.exports.pieces_for_tests import eye
from tests.instructions.order.walks import (
    PLANNED,
    Walk,
    bench_along,
    bench_by_hand,
    planned,
    walks,
)
from tests.jig.metal import circle, line, wires_of
from wrapit.config import GuideConfig
from wrapit.errors import Finding
from wrapit.instructions.model import Step, Tie
from wrapit.instructions.order.binding_order import find_ties
from wrapit.instructions.order.crossings import crossings_in
from wrapit.instructions.order.wire_steps import BY_HAND, DIRECTIONS, Laid, direction, wire_steps
from wrapit.instructions.words.quantities import half_millimetres, sixteenths
from wrapit.jig.bench.model import Bench
from wrapit.pages.model import Length, Listed, Span, Text, Value
from wrapit.wires.model import Wire

CONFIG = GuideConfig()


def values_in(said: Text) -> Iterator[Value]:
    """All that goes into a text, in the order in which it is given, texts within it included."""

    def within(value: Value) -> Iterator[Value]:
        yield value
        if isinstance(value, Text):
            yield from values_in(value)
        elif isinstance(value, Listed):
            for item in value.items:
                yield from within(item)

    for _, value in said.values:
        yield from within(value)


def places_in(texts: Sequence[Text], key: str) -> list[float]:
    """The places that texts of this key tell."""
    return [
        value.mm
        for said in texts
        if said.key == key
        for value in values_in(said)
        if isinstance(value, Length)
    ]


def laid(wire: Wire, bench: Bench | None, earlier: Sequence[Wire], findings: Sequence[Finding] = ()) -> Laid:
    ties = {tie.junction: tie for tie in find_ties([*earlier, wire], CONFIG.binding_gauge, 5)}
    return Laid(wire, bench, tuple(earlier), ties, crossings_in((*earlier, wire))[-1], tuple(findings))


def check(each: Laid, steps: Sequence[Step]) -> None:
    wire, first, last = each.wire, steps[0], steps[-1]
    assert [step.kind for step in steps] == ["start", *["shape"] * (len(steps) - 2), "end"]
    assert {step.wire for step in steps} == {wire.number}
    along = steps[1:]
    assert along[0].start_mm == 0
    assert [step.start_mm for step in along[1:]] == [step.end_mm for step in along[:-1]]
    assert last.end_mm == pytest.approx(wire.length_mm, abs=1e-3)
    assert first.texts[0].key == "start-cut"
    assert [crossing for step in steps for crossing in step.crossings] == list(each.crossings)
    told = sorted(mm for step in steps for mm in places_in(step.texts, "note-over"))
    assert told == sorted(crossing.at_mm for crossing in each.crossings)
    check_ties(wire, steps, each.ties.values())
    check_cautions(each, steps)
    for step in along:
        check_spans(step)
        if step.moves:
            assert (step.moves[0].start_mm, step.moves[-1].end_mm) == (step.start_mm, step.end_mm)
        assert all(a.end_mm == b.start_mm for a, b in itertools.pairwise(step.moves))


def check_ties(wire: Wire, steps: Sequence[Step], ties: Iterable[Tie]) -> None:
    places = sorted(binding.at_mm for binding in wire.bindings)
    assert sorted(mm for step in steps for mm in places_in(step.texts, "note-ties")) == places
    letters = {tie.junction: tie.letter for tie in ties}
    for step in steps[1:]:
        end_mm = step.end_mm + 1 if step.kind == "end" else step.end_mm
        mine = [
            letters[binding.junction] for binding in wire.bindings if step.start_mm <= binding.at_mm < end_mm
        ]
        assert list(step.ties) == list(dict.fromkeys(mine))


def check_cautions(each: Laid, steps: Sequence[Step]) -> None:
    for code in BY_HAND:
        said = [(step, mm) for step in steps for mm in places_in(step.cautions, f"caution-{code}")]
        wanted = [mm for finding in each.findings if finding.code == code for mm in finding.places_mm]
        assert sorted(mm for _, mm in said) == sorted(wanted)
        assert all(step.start_mm <= mm <= max(step.end_mm, mm * (step.kind == "end")) for step, mm in said)


def check_spans(step: Step) -> None:
    """Lengths that are said lie end to end from the step's start, and add up as they are read."""
    said = [text for text in step.texts if not text.key.startswith(("note-", "tie-"))]
    spans = [value for text in said for value in values_in(text) if isinstance(value, Span)]
    if not spans:
        assert step.kind == "end"
        return
    assert spans[0].start_mm == step.start_mm
    assert all(a.end_mm == b.start_mm for a, b in itertools.pairwise(spans))
    if step.times == 1:
        assert spans[-1].end_mm == step.end_mm
    else:
        assert spans[-1].end_mm < step.end_mm
    for read in (half_millimetres, sixteenths):
        total = sum(read(span.end_mm) - read(span.start_mm) for span in spans)
        assert total == pytest.approx(read(spans[-1].end_mm) - read(step.start_mm))


def findings_at(wire: Wire, found: Sequence[tuple[str, Sequence[float]]]) -> tuple[Finding, ...]:
    return tuple(
        Finding(
            "warning",
            code,
            "there",
            "so",
            wire=wire.name,
            places_mm=tuple(share * wire.length_mm for share in shares),
        )
        for code, shares in found
    )


def found_things() -> st.SearchStrategy[list[tuple[str, list[float]]]]:
    code = st.sampled_from([*BY_HAND, "split", "small-wall"])
    return st.lists(st.tuples(code, st.lists(st.floats(0, 1), max_size=3, unique=True)), max_size=4)


@given(walks(), found_things(), st.booleans())
@settings(max_examples=50)
def test_along_any_wire(walk: Walk, found: list[tuple[str, list[float]]], by_hand: bool) -> None:
    bench = bench_along(walk)
    (wire,) = bench.wires
    each = laid(wire, None if by_hand else bench, (), findings_at(wire, found))
    check(each, wire_steps(each, ()))


@given(walks())
@settings(max_examples=20)
def test_what_lies_just_where_one_step_ends_is_told_once(walk: Walk) -> None:
    bench = bench_along(walk)
    (wire,) = bench.wires
    bounds = sorted({step.end_mm for step in wire_steps(laid(wire, bench, ()), ())[1:]} | {0.0})
    found = [Finding("warning", "hemmed", "there", "so", wire=wire.name, places_mm=tuple(bounds))]
    each = laid(wire, bench, (), found)
    check(each, wire_steps(each, ()))


@pytest.mark.parametrize("name", PLANNED)
def test_in_jigs_that_are_planned(name: str) -> None:
    for bench in planned(name).benches:
        for index, wire in enumerate(bench.wires):
            each = laid(wire, bench, bench.wires[:index], findings_at(wire, [("strays", [0.0, 0.4, 1.0])]))
            check(each, wire_steps(each, ()))


def test_each_place_of_the_eye_is_told() -> None:
    first, second = eye()[1]
    each = laid(second, bench_by_hand((first, second), ()), (first,))
    steps = wire_steps(each, ())
    check(each, steps)
    # The bar begins and ends on the eye: it lies on it at both places.
    assert [crossing.over for crossing in each.crossings] == [(1,), (1,)]
    assert sum(len(step.ties) for step in steps) == len(second.bindings) == 2


@pytest.mark.parametrize("turn", range(8))
def test_starts_lead_the_way_that_the_compass_says(turn: int) -> None:
    end = (20 * math.cos(turn * math.pi / 4), 20 * math.sin(turn * math.pi / 4))
    assert direction(wires_of([line((0, 0), end)])[0]) == DIRECTIONS[turn]


@pytest.mark.parametrize("turn", range(8))
def test_a_wire_shorter_than_the_look_ahead_has_a_way_too(turn: int) -> None:
    end = (0.9 * math.cos(turn * math.pi / 4), 0.9 * math.sin(turn * math.pi / 4))
    (wire,) = wires_of([line((0, 0), end)])
    steps = wire_steps(laid(wire, None, ()), ())
    assert [step.kind for step in steps] == ["start", "end"]
    assert dict(steps[0].texts[2].values)["way"] == Text(f"way-{DIRECTIONS[turn]}")


def test_ends_go_into_the_hole_that_is_there() -> None:
    wires = wires_of([line((0, 0), (20, 0)), line((40, 0), (20, 0.5)), line((20, 0), (20, 30)), circle(9)])
    bench = bench_by_hand(wires, ())

    def said(index: int, key: str) -> Text:
        steps = wire_steps(laid(wires[index], bench, wires[:index]), ())
        (found,) = (text for text in steps[-1].texts if text.key == key)
        return found

    assert dict(said(0, "end-numbered-hole").values)["hole"] == 3
    assert dict(said(1, "end-numbered-hole").values)["hole"] == 3
    assert said(2, "end-hole") == Text("end-hole")
    assert dict(said(3, "end-same-hole").values)["hole"] == 4
