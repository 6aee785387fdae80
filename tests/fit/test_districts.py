"""Large sketches are chosen from region by region: every line is looked at, mirror images together."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from tests.bench.large_drawings import drawing_text
from wrapit.config import Config
from wrapit.drawing.stage import trace
from wrapit.fit import programme
from wrapit.fit.districts import cuts_of, parted, regions
from wrapit.fit.faces import faces_of
from wrapit.fit.limits import limits_of
from wrapit.fit.programme import Choice, Task, Weights, choose
from wrapit.fit.sketch import Line, Sketch
from wrapit.fit.worth import worths
from wrapit.geometry import straight


@settings(max_examples=50)
@example([(0.0, 0.0)] * 3, 2, False)
@given(
    st.lists(st.tuples(st.floats(-50, 50), st.floats(-50, 50)), min_size=1, max_size=90),
    st.integers(2, 40),
    st.booleans(),
)
def test_regions_cover_all_lines(places: list[tuple[float, float]], size: int, mirrored: bool) -> None:
    lines = {
        n: Line(2 * n, 2 * n + 1, straight((x, y), (x + 1, y)), frozenset((n,)))
        for n, (x, y) in enumerate(places)
    }
    ends = {node: np.zeros(2) for line in lines.values() for node in (line.start, line.end)}
    last = len(lines) - 1
    pairs = {n: last - n for n in lines} if mirrored else {}
    found = list(regions(Sketch(ends, lines), lines, pairs, size))
    assert frozenset().union(*found) == set(lines)
    for region in found:
        assert {pairs.get(n, n) for n in region} == region
        assert len({frozenset((n, pairs.get(n, n))) for n in region}) <= size


@settings(max_examples=100)
@given(
    st.lists(st.tuples(st.integers(0, 11), st.integers(0, 11)), min_size=1, max_size=24),
    st.sets(st.integers(0, 23)),
)
def test_nothing_leads_out_of_a_cut(ends: list[tuple[int, int]], dropped: set[int]) -> None:
    """Each cut is left by dropped lines alone, and all parts but one lie within one cut at least."""
    curve = straight((0.0, 0.0), (5.0, 0.0))
    lines = {n: Line(a, b, curve, frozenset((n,))) for n, (a, b) in enumerate(ends)}
    sketch = Sketch({node: np.zeros(2) for pair in ends for node in pair}, lines)
    gone = dropped & lines.keys()
    if len(gone) == len(lines):
        return
    cuts, apart = list(cuts_of(sketch, gone)), parted(sketch, gone)
    for cut in cuts:
        crossing = {n for n, line in lines.items() if (line.start in cut) != (line.end in cut)}
        assert crossing <= gone
        left = [line for n, line in lines.items() if n not in gone]
        assert any({line.start, line.end} <= cut for line in left)
        assert any(not {line.start, line.end} & cut for line in left)
    assert all(any(part <= cut for cut in cuts) for part in apart)
    assert bool(cuts) == bool(apart)


def _task(folder: Path, kind: str, segments: int) -> Task:
    path = folder / "net.json"
    path.write_text(drawing_text(kind, segments, 60))
    config = Config.model_validate({"drawing": str(path), "size": "60 mm", "wire": {"gauge": "18 AWG"}})
    drawing, _ = trace(path, config.tracing, config.size)
    sketch, limits = Sketch.of(drawing).simplified(), limits_of(config, "bold")
    faces = faces_of(sketch)
    worth = worths(sketch, faces, limits)
    return Task(sketch, faces, worth, limits, {}, frozenset(), {}, Weights(6.0, few=6, more_mm=5.0))


def _cost(task: Task, choice: Choice) -> float:
    """What is sure to be paid: what leaves the eye, and half a wire for each odd node."""
    left = task.sketch.changed(choice.dropped)
    odd = sum(len(arms) % 2 for arms in left.arms.values())
    return sum(task.worth[n] for n in choice.dropped) + 3 * odd + 2.5 * max(0, odd - 12)


@pytest.mark.parametrize("kind", ["cells", "grid"])
def test_region_by_region_costs_little_more(
    tmp_path: Path, kind: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    task = _task(tmp_path, kind, 90)
    assert len(task.sketch.lines) > programme._EXACT
    by_region = choose(task)
    monkeypatch.setattr(programme, "_EXACT", 1000)
    at_once = choose(task)
    assert by_region.unmet <= at_once.unmet
    assert _cost(task, by_region) <= 1.15 * _cost(task, at_once)
    assert not list(parted(task.sketch, set(by_region.dropped)))
