"""Drawings made fit for wire: how fit they are, what that cost by a judge of its own, what wires they give.

Run as `python -m tests.bench fit [names] [--solids | --quick]`: the corpus's clean drawings, and public
clipart (OpenMoji, CC BY-SA 4.0), a folder named in $WRAPIT_CLIPART; names are of drawings, or `clipart`. With
$WRAPIT_CLIPART unset it is the corpus alone.
$WRAPIT_BENCH_SIZES (30,40,50,60), $WRAPIT_BENCH_GAUGES (18,22) and $WRAPIT_BENCH_FIT
(off,gentle,bold) choose fewer. `--solids` makes the wires' solids too, by the kernel: minutes more; `--quick`
plans no jig, so that weak turns and what lies off stay unknown. In the table `untight` is no tight-bend
finding and no such stretch within a segment; `fits` asks for rounded corners, and room in each face, too.
"""

from __future__ import annotations

import math
import os
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np

from tests.bench.drawing import CORPUS, pictures
from tests.bench.fit_judge import Fitness, Price, fitness, price
from wrapit.config import Config
from wrapit.decomposition.stage import decompose
from wrapit.drawing.model import Drawing
from wrapit.drawing.stage import trace
from wrapit.errors import WrapItError
from wrapit.fit.stage import make_fit
from wrapit.jig.printed.planning import plan_jigs
from wrapit.materials import min_inner_bend_radius_mm
from wrapit.wires.model import Wire
from wrapit.wires.stage import draw_wires

# What each level promises: room in a face in wire diameters, and the shortest segment in mm.
PROMISED: Final = {"off": (2.0, 5.0), "gentle": (1.0, 3.0), "bold": (2.0, 5.0)}
# What is to be reached: outline kept; length left out of drawings with few wires; wires of those that were of
# drawings with many.
OUTLINE: Final = 0.9
LEFT_OUT: Final = 0.1
WIRES: Final = 1 / 3
MANY_WIRES: Final = 12


@dataclass(frozen=True)
class Row:
    """What came of one drawing at one size and thickness.

    `before` are the wires of the drawing as it was read; `over_half` is None where no jig can be planned,
    not a number where none was asked for.
    """

    name: str
    size: str
    level: str
    seen: Fitness
    paid: Price
    before: int
    wires: int
    tight: int
    weak: int
    unsound: int
    over_half: float | None
    seconds: float

    @property
    def makeable(self) -> bool:
        """Not one finding of a tight bend, a weak turn or a wire without a solid."""
        return self.over_half is not None and not (self.tight or self.weak or self.unsound)

    @property
    def untight(self) -> bool:
        """No bend that the metal doesn't take but for corners, which wires are rounded at."""
        return not (self.tight or self.seen.spans)

    @property
    def fits(self) -> bool:
        """No bend that the metal doesn't take, and no face without the room that is promised."""
        return not (self.seen.tight or self.tight or self.seen.narrow(PROMISED[self.level][0]))


def main(words: Sequence[str]) -> None:
    """A line for each build, and a table by level and size."""
    names = [word for word in words if word not in ("--solids", "--quick")]
    rows: list[Row] = []
    for kind, picture, tracing in _pictures():
        if names and picture.stem not in names and kind not in names:
            continue
        for size_mm in _chosen("SIZES", "30,40,50,60"):
            for gauge in _chosen("GAUGES", "18,22"):
                settings = {"drawing": str(picture), "size": f"{size_mm} mm", "tracing": tracing}
                wire = {"wire": {"gauge": f"{gauge} AWG"}}
                rows += _rows(f"{kind} {picture.stem}", Config.model_validate(settings | wire), words)
    _print_table(rows)


def _chosen(what: str, usual: str) -> list[str]:
    return os.environ.get(f"WRAPIT_BENCH_{what}", usual).split(",")


def _pictures() -> Iterator[tuple[str, Path, dict[str, Any]]]:
    """Kind, file, and how it is read: clipart is made of many parts."""
    if (CORPUS / "dev").is_dir():
        yield from (("corpus", path, {}) for kind, path, _, _ in pictures() if kind == "clean")
    else:
        print("the corpus of drawings is not here; set WRAPIT_CORPUS")
    if "WRAPIT_CLIPART" in os.environ:
        for path in sorted(Path(os.environ["WRAPIT_CLIPART"]).glob("*.svg")):
            yield "clipart", path, {"components": "join"}
    else:
        print("no clipart here; set WRAPIT_CLIPART")


def _rows(name: str, config: Config, words: Sequence[str]) -> Iterator[Row]:
    """A row for each level; none where the drawing is refused, or cannot be made fit."""
    size = f"{config.size:.0f} mm {config.wire.gauge:.2f}"
    try:
        drawing, _ = trace(Path(config.drawing), config.tracing, config.size)
        before = len(decompose(drawing, config.decomposition)[0].trails)
    except WrapItError as error:
        print(f"{name:32s} {size} {error}", flush=True)
        return
    for level in _chosen("FIT", "off,gentle,bold"):
        at_level = Config.model_validate(config.model_dump() | {"fit": level})
        try:
            row = _row(name, size, drawing, before, at_level, words)
        except WrapItError as error:
            print(f"{name:32s} {size} {level:6s} exit {error.exit_code}: {error}", flush=True)
            continue
        print(_line(row), flush=True)
        yield row


def _row(name: str, size: str, drawing: Drawing, before: int, config: Config, words: Sequence[str]) -> Row:
    gauge_mm = config.wire.gauge
    began = time.process_time()
    fitted = make_fit(drawing, config)[0].drawing
    seconds = time.process_time() - began
    solution, _ = decompose(fitted, config.decomposition)
    wires, said = draw_wires(solution, config)
    weak, over_half = (0, math.nan) if "--quick" in words else _planned(name, wires, config)
    radius_mm = min_inner_bend_radius_mm(gauge_mm, config.wire.temper) + gauge_mm / 2
    return Row(
        name=name,
        size=size,
        level=config.fit,
        seen=fitness(fitted, gauge_mm, radius_mm),
        paid=price(drawing, fitted, gauge_mm),
        before=before,
        wires=len(wires),
        tight=sum(finding.code == "tight-bend" for finding in said),
        weak=weak,
        unsound=_unsound(wires) if "--solids" in words else 0,
        over_half=over_half,
        seconds=seconds,
    )


def _planned(name: str, wires: tuple[Wire, ...], config: Config) -> tuple[int, float | None]:
    """Weak turns of the printed jig, and the share of the wires that lie off by over 0.5 mm when taut."""
    try:
        planned, findings = plan_jigs(wires, config.jig)
    except WrapItError as error:
        print(f"{name:32s} has no jig: {error}", flush=True)
        return 0, None
    off_mm = np.concatenate([course.off_mm for jig in planned.jigs for course in jig.plan.laid])
    return sum(finding.code == "weak-turn" for finding in findings), float((off_mm > 0.5).mean())


def _unsound(wires: tuple[Wire, ...]) -> int:
    """Wires without a sound solid."""
    from wrapit.kernel.round_wires.sweeps import round_wire

    made = [round_wire(w.centreline, w.diameter_mm, w.lifts, w.name) for w in wires]
    return sum(each.solid is None for each in made)


def _line(row: Row) -> str:
    seen, paid, (room, short_mm) = row.seen, row.paid, PROMISED[row.level]
    off = "  no jig" if row.over_half is None else f"{row.over_half:8.3f}"
    least = f"{seen.faces_d[0]:4.1f}" if seen.faces_d else "   -"
    return (
        f"{row.name:32s} {row.size} {row.level:6s} segments {seen.segments:3d}"
        f" wires {row.wires:2d} of {row.before:2d} findings: tight {row.tight:2d}"
        f" weak {row.weak:2d} unsound {row.unsound} off{off}"
        f" left: spans {seen.spans:2d} corners {seen.corners:2d} narrow {seen.narrow(room):2d}"
        f" least {least} d short {seen.short(short_mm):2d} stubs {seen.short_stubs(short_mm):2d}"
        f" pieces {seen.pieces} crossings {seen.crossings}"
        f" cost: outline {paid.outline_kept:.3f} out {paid.left_out:.3f}"
        f" moved {paid.moved_mm:.3f} at most {paid.furthest_mm:.2f}"
        f" {1e3 * row.seconds:5.0f} ms {1e3 * row.seconds / seen.segments:4.1f} each"
    )


def _print_table(rows: list[Row]) -> None:
    """What the rows reach of the goals, by kind, level and size, and over all sizes.

    Length left out is that of drawings with few wires, wires/off that of drawings with many.
    """
    print(
        f"\n{'':38s}    n makeable untight  fits  outline  ≥ 90 %  out median  ≤ 10 %  wires/off  ≤ 1/3"
        "  over .5  narrow  short  slowest"
    )
    groups: dict[str, list[Row]] = {}
    for row in rows:
        kind = row.name.split()[0]
        groups.setdefault(f"{kind} {row.level:6s} {row.size}", []).append(row)
        groups.setdefault(f"{kind} {row.level:6s} all", []).append(row)
    for title, group in sorted(groups.items()):
        print(f"{title:38s}{_summary(group)}")


def _summary(rows: list[Row]) -> str:
    """One line of the table: shares of the drawings, and medians."""

    def share(reached: Sequence[bool]) -> str:
        return f"{np.mean(reached):7.2f}" if reached else "      -"

    kept = [row.paid.outline_kept for row in rows]
    out = [row.paid.left_out for row in rows if row.before < MANY_WIRES]
    fewer = [row.wires / row.before for row in rows if row.before >= MANY_WIRES]
    half = [row.over_half for row in rows if row.over_half is not None and not math.isnan(row.over_half)]
    room, short_mm = PROMISED[rows[0].level]
    return (
        f"{len(rows):5d}  {share([row.makeable for row in rows])}"
        f"{share([row.untight for row in rows])}{share([row.fits for row in rows])}"
        f"  {np.mean(kept):7.3f} {share([each >= OUTLINE for each in kept])}"
        f"  {f'{np.median(out):10.3f}' if out else '         -'} {share([each <= LEFT_OUT for each in out])}"
        f"  {f'{np.median(fewer):9.2f}' if fewer else '        -'}{share([each <= WIRES for each in fewer])}"
        f"  {f'{np.mean(half):7.3f}' if half else '      -'}"
        f"  {np.mean([row.seen.narrow(room) for row in rows]):6.1f}"
        f" {np.mean([row.seen.short(short_mm) for row in rows]):6.1f}"
        f"  {max(row.seconds for row in rows):5.2f} s"
    )
