"""Two runs side by side in the guide: told once each, on the side where they are; nothing passes over."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest

from tests.instructions.order.walks import bench_by_hand, course
from tests.jig.metal import arcs, wires_of
from tests.jig.paired.pairs import SHAPES, STRAIGHT, D, Parts, hairpin, two_wires
from wrapit.config import JigConfig
from wrapit.instructions.model import Step
from wrapit.instructions.order.crossings import crossings_in
from wrapit.instructions.order.wire_steps import Laid, wire_steps
from wrapit.instructions.words.speaking import Speaker
from wrapit.jig.bench.mirrored_bench import mirrored_handling
from wrapit.jig.bench.model import NO_WALL, Bench, Handling
from wrapit.jig.bench.touching import bench_of
from wrapit.jig.printed.planning import plan_jigs
from wrapit.pages.model import Text
from wrapit.wires.model import DoubleRun, Wire

BESIDE = ("note-beside", "note-leave-room")


def planned(wires: tuple[Wire, ...]) -> Bench:
    (jig,) = plan_jigs(wires, JigConfig())[0].jigs
    plan, reach_mm = jig.plan, jig.channels.reach_mm
    return bench_of("jig", wires, jig.walls, plan.plate.outline, plan.pins, reach_mm)


def steps_of(wire: Wire, bench: Bench | None) -> tuple[Step, ...]:
    earlier: tuple[Wire, ...] = ()
    crossings: tuple = ()
    if bench is not None:
        place = bench.wires.index(wire)
        earlier, crossings = bench.wires[:place], crossings_in(bench.wires)[place]
    return wire_steps(Laid(wire, bench, earlier, {}, crossings, ()), ())


def said(steps: Sequence[Step], *keys: str) -> list[Text]:
    return [text for step in steps for text in step.texts if text.key in keys]


def values(text: Text) -> dict[str, object]:
    return dict(text.values)


def lies_to_the(side: str, wire: Wire, run: DoubleRun, other: Wire) -> bool:
    """Whether the other run lies there, by points along both: no side of ours is asked."""
    at_mm, points, left = course(wire)
    middle = int(np.abs(at_mm - (run.start_mm + run.end_mm) / 2).argmin())
    there_mm, there, _ = course(other)
    away = there - points[middle]
    if other is wire:
        away = away[np.abs(there_mm - at_mm[middle]) > 5 * D]
    nearest = away[np.linalg.norm(away, axis=1).argmin()]
    assert np.linalg.norm(nearest) == pytest.approx(D, abs=0.03)
    return bool((nearest @ left[middle] > 0) == (side == "left"))


@pytest.mark.parametrize("how", ["along", "opposed", "fold"])
@pytest.mark.parametrize("shape", SHAPES)
def test_each_run_is_told_once_with_the_side_on_which_the_other_is(shape: str, how: str) -> None:
    parts = SHAPES[shape]
    wires = (hairpin(parts),) if how == "fold" else two_wires(parts, opposed=how == "opposed")
    bench = planned(wires)
    for wire in wires:
        steps = steps_of(wire, bench)
        told = said(steps, *BESIDE)
        assert len(told) == len(wire.doubles)
        for run, text in zip(wire.doubles, told, strict=True):
            other = next(each for each in wires if each.name == run.other)
            assert text.key == ("note-leave-room" if run.first else "note-beside")
            about = values(text)
            assert about["way"] == ("other" if how != "fold" else "back")
            # What comes lies to the side that is told; what lies there has this run on that side of it.
            away = {"left": "right", "right": "left"}
            there = str(about["side"]) if run.first else away[str(about["side"])]
            assert lies_to_the(there, wire, run, other)
        assert not any(step.crossings for step in steps)
        assert not said(steps, "note-over", "note-doubled")
        index = [number for step in steps for number in step.walls]
        assert all(0 <= number < len(bench.walls) for number in index)


def test_the_same_way_once_more_is_told_so() -> None:
    wire = hairpin(STRAIGHT)
    again = replace(wire, doubles=tuple(replace(run, opposed=False) for run in wire.doubles))
    assert [values(text)["way"] for text in said(steps_of(again, None), *BESIDE)] == ["again", "again"]


def test_where_the_second_run_leans_it_is_bent_round_the_first() -> None:
    (wire,) = wires = (hairpin(SHAPES["right"]),)
    bench = planned(wires)
    (leans,) = [each for each in bench.contacts[wire.name] if each.around == "run"]
    (outer,) = [turn for turn in wire.turns if turn.start_mm > 50]
    assert (leans.start_mm, leans.end_mm, leans.side) == (outer.start_mm, outer.end_mm, outer.inside)
    assert leans.index == NO_WALL
    assert len(said(steps_of(wire, bench), "do-wrap-run")) == 1
    # The first run has nothing to lean on yet.
    (left,) = (hairpin(SHAPES["arc"]),)
    assert not said(steps_of(left, planned((left,))), "do-wrap-run")
    (mirrored,) = mirrored_handling(Handling((bench,))).benches
    assert {each.side for each in mirrored.contacts[wire.name] if each.around == "run"} == {"right"}


@pytest.mark.parametrize(
    ("radius", "key"), [(0.7, "do-hairpin"), (1.2, "do-hairpin-pin"), (1.6, "do-hairpin-wall")]
)
@pytest.mark.parametrize("shape", ["straight", "S"])
def test_a_hairpin_is_a_narrow_loop_round_what_stands_in_it(shape: str, radius: float, key: str) -> None:
    wire = hairpin(SHAPES[shape], radius)
    steps = steps_of(wire, planned((wire,)))
    (turned,) = [step for step in steps if step.heading.key == "heading-hairpin"]
    out, back = wire.doubles
    assert turned.start_mm < (out.end_mm + back.start_mm) / 2 < turned.end_mm
    assert key in [text.key for text in turned.texts]
    assert values(said([turned], key)[0])["side"] == "left"


def test_a_loop_of_the_drawing_between_both_runs_is_no_hairpin() -> None:
    wire = hairpin(STRAIGHT)
    out, back = wire.doubles
    spans = ((0.0, out.end_mm), (out.end_mm, back.start_mm), (back.start_mm, wire.length_mm))
    assert said(steps_of(wire, planned((wire,))), "do-hairpin-wall")
    drawn = replace(wire, segment_spans_mm=spans)
    assert not said(steps_of(drawn, planned((drawn,))), "do-hairpin-wall")


def test_a_wire_of_another_jig_is_not_there_to_lie_beside() -> None:
    one, two = two_wires(SHAPES["arc"])
    for wire in (one, two):
        assert not said(steps_of(wire, planned((wire,))), *BESIDE)
        assert not said(steps_of(wire, None), *BESIDE)


def test_a_pair_that_passes_over_a_pair_passes_over_it() -> None:
    """A wire that runs beside another, and comes back across both."""
    parts: Parts = ((30, 0), (8, 270), (30, 0))
    wires = two_wires(parts)
    bench = bench_by_hand(wires, ())
    first, second = crossings_in(wires)
    assert [each.over for each in first] == [(1,)]
    assert {number for each in second for number in each.over} == {1, 2}
    assert len(second) <= 2
    assert said(steps_of(wires[1], bench), "note-over")


def test_words_in_both_languages() -> None:
    (wire,) = (hairpin(STRAIGHT),)
    room, back = said(steps_of(wire, planned((wire,))), *BESIDE)
    english, german = (Speaker(language, "mm") for language in ("en", "de"))
    plain = lambda words: words.replace("\u00a0", " ")  # noqa: E731  one place of use
    assert plain(english.say(room)) == (
        "From 0 mm to 40 mm on the wire, leave room as wide as the wire on its left: "
        "later it comes back there, close beside itself."
    )
    assert plain(english.say(back)) == (
        "Go back along the same line, on its right, close beside the run that lies there: "
        "from 50.5 mm to 90.5 mm on the wire."
    )
    assert plain(german.say(back)) == (
        "Geh auf derselben Linie zurück, rechts von ihr, dicht neben dem Lauf, der dort liegt: "
        "von 50,5 mm bis 90,5 mm auf dem Draht."
    )


def test_wires_without_another_run_are_told_as_before() -> None:
    (wire,) = wires_of([arcs((0, 0), 0, (20, 0), (5, 180), (20, 0))])
    assert not said(steps_of(wire, planned((wire,))), *BESIDE, "do-wrap-run", "do-hairpin-wall")
