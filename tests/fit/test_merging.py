"""Two nodes become one: what met there follows, and nothing crosses for it."""

from __future__ import annotations

from hypothesis import given, settings
from hypothesis import strategies as st

from tests.bench.fit_judge import fitness
from tests.fit.drawn import drawn
from wrapit.fit.merging.merged import merged, quoted
from wrapit.fit.sketch import Sketch


@settings(max_examples=20, deadline=None, derandomize=True)
@given(st.sampled_from(["net", "ladder", "grate", "scribble", "leaf", "double"]), st.integers(0, 60))
def test_the_ends_of_a_short_line_become_one_node(kind: str, seed: int) -> None:
    drawing = drawn(kind, seed, 40.0)
    sketch = Sketch.of(drawing).simplified()
    was = fitness(drawing, 1.0, 1.0)
    for n in sorted(sketch.lines, key=lambda n: sketch.lines[n].curve.length)[:5]:
        line = sketch.lines[n]
        if min(len(sketch.arms[node]) for node in (line.start, line.end)) < 3:
            continue  # a stub goes, and no more comes of it
        merger = merged(sketch, n, 1.0)
        if merger is None:
            continue
        after = merger.sketch
        assert n not in after.lines
        assert len(after.lines) == len(sketch.lines) - 1
        assert len({line.start, line.end} & set(after.nodes)) == 1
        # Odd nodes: two become an even one, one of two stays, even ones stay even.
        ends = [len(sketch.arms[node]) for node in (line.start, line.end)]
        assert len(after.arms[min(line.start, line.end)]) == sum(ends) - 2
        seen = fitness(after.drawing(drawing)[0], 1.0, 1.0)
        assert seen.pieces == was.pieces
        assert seen.crossings <= was.crossings
        touched = {arm[0] for node in (line.start, line.end) for arm in sketch.arms[node]}
        assert all(after.lines[m] is sketch.lines[m] for m in after.lines if m not in touched)


def test_a_quote_is_what_the_merger_costs() -> None:
    agreed = []
    for kind in ("net", "ladder", "grate", "scribble", "leaf", "double"):
        for seed in range(12):
            sketch = Sketch.of(drawn(kind, seed, 40.0)).simplified()
            for n in sorted(sketch.lines, key=lambda n: sketch.lines[n].curve.length)[:5]:
                quote, merger = quoted(sketch, n, 1.0), merged(sketch, n, 1.0)
                # Curves are within 0.02 mm of the points: rarely do only they cross, or only the points.
                agreed.append((quote is None) == (merger is None))
                if quote is not None and merger is not None:
                    assert quote.moved == merger.moved
                    assert quote.lost == merger.lost
    assert sum(agreed) > 0.97 * len(agreed)
