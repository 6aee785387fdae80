"""Second runs: every line offered once more, side by side with its first run."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from wrapit.decomposition.graph import Graph, SecondRun
from wrapit.decomposition.model import half_edges


def with_second_runs(graph: Graph, extra: dict[int, float] | None = None) -> Graph:
    """The graph with a second run of every stroke appended, in their order.

    Its cost is its length in mean strokes, and what is `extra` for it. Strokes that start and end at one
    junction are left out: running round once more changes neither parity nor connection.
    """
    strokes = [e for e in range(graph.segments) if e not in graph.optional]
    mean_mm = sum(graph.lengths_mm[e] for e in strokes) / len(strokes)
    twice = [e for e in strokes if graph.junction_of[2 * e] != graph.junction_of[2 * e + 1]]
    ends = [h for e in twice for h in half_edges(e)]
    return replace(
        graph,
        junction_of=(*graph.junction_of, *(graph.junction_of[h] for h in ends)),
        tangents=np.concatenate([graph.tangents, graph.tangents[ends]]),
        lengths_mm=(*graph.lengths_mm, *(graph.lengths_mm[e] for e in twice)),
        second_runs={
            graph.segments + index: SecondRun(e, graph.lengths_mm[e] / mean_mm + (extra or {}).get(e, 0.0))
            for index, e in enumerate(twice)
        },
    )
