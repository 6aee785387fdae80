"""The paper's own validations in small; `python -m tests.bench paper` repeats them in full."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from tests.bench.composing import compose, write_ink
from tests.bench.paper import SIZE_MM, annealed_hits, fewest_wires, known_mate, owners_of, recover, traced
from wrapit.config.decomposition import DecompositionConfig
from wrapit.config.tracing import TracingConfig
from wrapit.decomposition.graph import graph_of
from wrapit.decomposition.stage import decompose
from wrapit.decomposition.trails import trails_of
from wrapit.drawing.stage import trace


@pytest.mark.parametrize(
    ("name", "segments", "wires"),
    [("butterfly", 13, 3), ("lotus", 24, 5), ("dolphin", 17, 3), ("bee", 19, 6), ("mandala", 56, 16)],
)
def test_our_pieces_need_the_fewest_wires_and_none_is_weak(name: str, segments: int, wires: int) -> None:
    drawing, strokes = traced(name), traced(name, "svg")
    solution, _ = decompose(drawing, DecompositionConfig())

    assert len(drawing.segments) == len(strokes.segments) == segments
    assert sorted(map(len, drawing.half_edges())) == sorted(map(len, strokes.half_edges()))
    assert solution.energy.complexity == fewest_wires(drawing) == wires
    assert solution.energy.robustness == 0
    assert solution.optimal


def test_known_wires_come_back_through_ink_and_tracing(tmp_path: Path) -> None:
    result = recover(compose(np.random.default_rng(7), 5), tmp_path)

    assert result.recovered == result.wires == result.found == 5
    assert result.answer_energy == pytest.approx(result.truth_energy)


def test_known_wires_are_a_decomposition_of_what_was_traced(tmp_path: Path) -> None:
    piece = compose(np.random.default_rng(6), 6)
    drawing, _ = trace(write_ink(piece, tmp_path), TracingConfig(), SIZE_MM)
    owners = owners_of(drawing, piece)
    mate = known_mate(drawing, piece, owners)

    assert mate is not None
    trails = trails_of(graph_of(drawing), mate)
    assert len(trails) == 6
    for trail in trails:
        assert len({owners[step.segment] for step in trail.traversals}) == 1
    lengths = np.zeros(6)
    for segment in drawing.segments:
        wire = owners[segment.id]
        assert wire is not None
        lengths[wire] += segment.curve.length
    drawn = np.array([wire.length for wire in piece.wires])
    assert lengths / lengths.sum() == pytest.approx(drawn / drawn.sum(), abs=0.005)


def test_annealing_finds_the_proven_optimum_of_the_butterfly() -> None:
    assert annealed_hits(traced("butterfly"), 4) == (4, 4)
