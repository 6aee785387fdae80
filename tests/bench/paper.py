"""The paper's own validations, repeated on drawings of our own: Table 1, Figures 5 and 6, section 4.3.

WRAPIT_BENCH_RUNS sets the number of annealing runs, WRAPIT_BENCH_PIECES that of the composed pieces.
"""

from __future__ import annotations

import itertools
import os
import tempfile
import time
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from tests.bench.composing import UNITS_PER_STROKE, Composed, compose, write_ink
from wrapit.config.decomposition import AnnealingConfig, DecompositionConfig
from wrapit.config.tracing import TracingConfig
from wrapit.decomposition.annealing.stage import anneal
from wrapit.decomposition.energy import energy_of
from wrapit.decomposition.exact.stage import solve_exactly
from wrapit.decomposition.graph import graph_of
from wrapit.decomposition.model import NO_MATE, Weights
from wrapit.decomposition.problem import Problem
from wrapit.decomposition.stage import decompose
from wrapit.drawing.model import Drawing, PixelFrame
from wrapit.drawing.stage import trace
from wrapit.geometry import FloatArray

CONFIGS = Path(__file__).parent.parent.parent / "configs"
SIZE_MM = 60.0
BUDGET = 2_000_000
_NOISE = 0.01  # of energy: six degrees of bend, about what drawing and tracing blur
# Segments and wires that the paper prints, beside the piece of ours that is nearest in size.
TABLE_1 = (("butterfly", 12, 3), ("lotus", 24, 5), ("mandala", 54, 16))
FIGURE_6 = ("lotus", "dolphin", "bee", "butterfly")


@dataclass(frozen=True)
class Recovery:
    """What came back of a composed piece after drawing, tracing and decomposing it.

    `apart` counts the known wires that end where no other one does, `apart_recovered` those of them
    that came back. `truth_energy` is that of the known wires on the traced drawing, None where tracing
    joined or cut lines otherwise than they were laid; `answer_energy` is that of the wires found.
    """

    wires: int
    segments: int
    recovered: int
    found: int
    apart: int
    apart_recovered: int
    fewest: int
    answer_energy: float
    truth_energy: float | None


def main() -> None:
    _table_1()
    _figure_6()
    _figure_5(int(os.environ.get("WRAPIT_BENCH_PIECES", "12")))
    _section_4_3(int(os.environ.get("WRAPIT_BENCH_RUNS", "1000")))


def traced(name: str, kind: str = "png") -> Drawing:
    """A drawing of ours, from its bitmap or from its strokes."""
    return trace(CONFIGS / f"{name}.{kind}", TracingConfig(), SIZE_MM)[0]


def fewest_wires(drawing: Drawing) -> int:
    """No decomposition of a connected drawing has fewer wires."""
    return max(1, drawing.odd_junctions // 2)


def recover(piece: Composed, folder: Path) -> Recovery:
    """Draws a piece in ink, traces the picture, divides it, and compares with the wires it was laid of."""
    picture = write_ink(piece, folder)
    drawing, _ = trace(picture, TracingConfig(), SIZE_MM)
    solution, _ = decompose(drawing, DecompositionConfig())
    owners = owners_of(drawing, piece)
    truth = [{e for e, owner in enumerate(owners) if owner == wire} for wire in range(len(piece.wires))]
    found = [{step.segment for step in trail.traversals} for trail in solution.trails]
    mate = known_mate(drawing, piece, owners)
    energy = None if mate is None else energy_of(graph_of(drawing), mate, Weights()).total
    back = {index for index, wire in enumerate(truth) if wire and wire in found}
    apart = piece.wires_apart
    return Recovery(
        wires=len(piece.wires),
        segments=len(drawing.segments),
        recovered=len(back),
        found=len(found),
        apart=len(apart),
        apart_recovered=len(apart & back),
        fewest=fewest_wires(drawing),
        answer_energy=solution.energy.total,
        truth_energy=energy,
    )


def owners_of(drawing: Drawing, piece: Composed) -> list[int | None]:
    """For each traced segment the known wire that it lies on, all along within 3/4 of the stroke width."""
    assert drawing.pixel_frame is not None
    reach_mm = 0.75 * UNITS_PER_STROKE * piece.px_per_unit * drawing.pixel_frame.mm_per_px
    lines = [_in_mm(line, piece, drawing.pixel_frame) for line in piece.lines]
    owners: list[int | None] = []
    for segment in drawing.segments:
        points = segment.curve.sampled(0.3)
        apart = [
            float(np.linalg.norm(points[:, None] - line[None], axis=2).min(axis=1).max()) for line in lines
        ]
        nearest = int(np.argmin(apart))
        owners.append(nearest if apart[nearest] < reach_mm else None)
    return owners


def known_mate(drawing: Drawing, piece: Composed, owners: list[int | None]) -> tuple[int, ...] | None:
    """The known wires as a decomposition of the traced drawing; None where it has others in their way."""
    assert drawing.pixel_frame is not None
    mate = [NO_MATE] * (2 * len(drawing.segments))
    for wire, line in enumerate(piece.lines):
        line_mm = _in_mm(line, piece, drawing.pixel_frame)
        runs = []
        for segment in drawing.segments:
            if owners[segment.id] == wire:
                start, end = (_place(line_mm, point) for point in (segment.curve.start, segment.curve.end))
                half_edges = (2 * segment.id, 2 * segment.id + 1)
                runs.append((min(start, end), half_edges if start < end else half_edges[::-1]))
        runs.sort()
        junctions = {h: j for j, ends in enumerate(drawing.half_edges()) for h in ends}
        for (_, (_, leaving)), (_, (arriving, _)) in itertools.pairwise(runs):
            if junctions[leaving] != junctions[arriving]:
                return None
            mate[leaving], mate[arriving] = arriving, leaving
    return None if None in owners else tuple(mate)


def annealed_hits(drawing: Drawing, runs: int) -> tuple[int, int]:
    """How many of the paper's annealing runs end in the proven optimum, and in its number of wires."""
    problem = Problem(graph_of(drawing), Weights())
    answer = solve_exactly(problem, BUDGET)
    assert answer is not None
    assert answer.proven
    best = problem.energy(answer.mate)
    hits = same = 0
    for seed in range(runs):
        found = anneal(problem, AnnealingConfig(), np.random.default_rng(seed))
        energy = problem.energy(found.mate)
        hits += energy.total < best.total + 1e-6
        same += energy.complexity == best.complexity
    return hits, same


def _table_1() -> None:
    print("\nTable 1: segments and wires in the paper, and of a piece of ours of that size")
    print(f"{'paper':>14}{'ours':>24}{'fewest possible':>17}{'weak':>6}{'proven':>8}")
    for name, segments, wires in TABLE_1:
        drawing = traced(name)
        solution, _ = decompose(drawing, DecompositionConfig())
        ours = f"{name} {len(drawing.segments)} → {solution.energy.complexity}"
        print(
            f"{f'{segments} → {wires}':>14}{ours:>24}{fewest_wires(drawing):17}"
            f"{solution.energy.robustness:6}{solution.optimal!s:>8}",
            flush=True,
        )


def _figure_6() -> None:
    print("\nFigure 6: pieces as a novice draws them, from the bitmap and from the strokes")
    print(f"{'':12}{'segments':>10}{'from strokes':>14}{'wires':>7}{'fewest':>8}{'weak':>6}{'bends':>8}")
    for name in FIGURE_6:
        drawing = traced(name)
        energy = decompose(drawing, DecompositionConfig())[0].energy
        print(
            f"{name:12}{len(drawing.segments):10}{len(traced(name, 'svg').segments):14}{energy.complexity:7}"
            f"{fewest_wires(drawing):8}{energy.robustness:6}{np.degrees(energy.smoothness_rad):7.0f}°",
            flush=True,
        )


def _figure_5(pieces: int) -> None:
    print(f"\nFigure 5: pieces laid of known wires, drawn in ink, traced, divided ({pieces} of each size).")
    print("Where two known wires end at one point, the energy prefers one wire to the two: 'apart' is the")
    print("share recovered of the wires that end where no other does. The rest counts pieces; 'fewest':")
    print("those whose answer has the fewest wires possible.")
    print(
        f"{'wires':>7}{'segments':>10}{'recovered':>11}{'apart':>7}{'traced as laid':>16}{'same':>6}"
        f"{'fewer wires':>13}{'smoother':>10}{'as good':>9}{'worse':>7}{'fewest':>8}"
        f"{'E laid':>9}{'E found':>9}"
    )
    for count in (5, 8, 12, 16):
        results = []
        for number in range(pieces):
            with tempfile.TemporaryDirectory() as folder:
                piece = compose(np.random.default_rng([count, number]), count)
                results.append(recover(piece, Path(folder)))
        kinds = Counter(map(_compared, results))
        recovered = sum(each.recovered for each in results) / (count * pieces)
        apart = sum(each.apart_recovered for each in results) / sum(each.apart for each in results)
        known = [(each.truth_energy, each.answer_energy) for each in results if each.truth_energy is not None]
        laid, found = np.mean(known, axis=0)
        print(
            f"{count:7}{np.mean([each.segments for each in results]):10.1f}{recovered:11.0%}{apart:7.0%}"
            f"{len(known):16}{kinds['same']:6}{kinds['fewer']:13}{kinds['better']:10}{kinds['as good']:9}"
            f"{kinds['worse']:7}{sum(each.found == each.fewest for each in results):8}"
            f"{laid:9.3f}{found:9.3f}",
            flush=True,
        )


def _compared(result: Recovery) -> str:
    """Why the wires found are others than those that were laid."""
    if result.recovered == result.wires == result.found:
        return "same"
    if result.truth_energy is None:
        return "traced otherwise"
    gain = result.truth_energy - result.answer_energy
    if abs(gain) <= _NOISE:
        return "as good"
    return "worse" if gain < 0 else "fewer" if result.found < result.wires else "better"


def _section_4_3(runs: int) -> None:
    start = time.process_time()
    hits, same = annealed_hits(traced("butterfly"), runs)
    each_s = (time.process_time() - start) / runs
    print(f"\nsection 4.3: {hits} of {runs} annealing runs end in the butterfly's proven optimum")
    print(f"(the paper: 999 of 1000), {same} in its number of wires; {each_s:.2f} s each", flush=True)


def _in_mm(line: FloatArray, piece: Composed, frame: PixelFrame) -> FloatArray:
    """Drawing units to mm; the centre of pixel (0, 0) is half a pixel inside the paper."""
    px = line * piece.px_per_unit - 0.5
    return np.asarray(frame.origin_mm) + px * np.array([1.0, -1.0]) * frame.mm_per_px


def _place(line: FloatArray, point: FloatArray) -> int:
    return int(np.argmin(np.linalg.norm(line - point, axis=1)))


if __name__ == "__main__":
    main()
