"""What runs in the kernel's process: solids, and the files that need them."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from wrapit.config import Config
from wrapit.errors import Finding
from wrapit.geometry import FloatArray
from wrapit.jig.made import Made, Wires, file_stem
from wrapit.materials import METALS
from wrapit.wires.model import JumpRing

# What loads for seconds, while drawing and wires are made and jigs planned: cadquery brings OpenCascade.
PRELOAD = ("wrapit.kernel.files", "wrapit.kernel.terraces", "wrapit.jig.printed.stage", "cadquery")
# How far apart do jigs stand in one file? So far that each is seen as one of its own.
_BETWEEN_MM = 10.0

# By file: what was added to the piece's coordinates, or that by the name of each jig in it.
Frames = dict[str, list[float] | dict[str, list[float]]]


def make_solids(planned: Callable[[], Made], config: Config, folder: Path | None, suffix: str = "") -> Made:
    """A planned jig, built and checked; its files in `folder`, `jig{suffix}.step` and so on.

    The result holds no kernel shapes; its numbers say in which frame each file is.
    """
    made = planned()
    numbers = made.numbers
    if folder is not None:
        numbers = {**numbers, "frames": _write(made, config, folder, suffix)}
    return dataclasses.replace(
        made,
        numbers=numbers,
        parts=tuple(dataclasses.replace(part, solid=None) for part in made.parts),
    )


def judged_solids(
    planned: Callable[[], Made], judge: Callable[[Made, Wires, Config], Made], wires: Wires, config: Config
) -> Made:
    """A planned jig, made and looked at by its kind's judge, which raises KernelError at a fault."""
    return judge(planned(), wires, config)


def _write(made: Made, config: Config, folder: Path, suffix: str) -> Frames:
    """Writes the files; what was added to the piece's coordinates in each."""
    from wrapit.kernel.files import FilePart, write_printable, write_step
    from wrapit.kernel.objects import moved

    parts = [FilePart(part.name, part.solid, part.colour) for part in made.parts]
    boxes = [part.box_mm for part in made.parts]
    frames: Frames = {}
    if "step" in config.outputs:
        places = side_by_side(boxes)
        name = f"jig{suffix}.step"
        write_step(
            folder / name, config.name, [moved(part, by) for part, by in zip(parts, places, strict=True)]
        )
        by_name = {part.name: list(by) for part, by in zip(parts, places, strict=True)}
        frames[name] = by_name if len(parts) > 1 else list(places[0])
    for part, (low, _) in zip(parts, boxes, strict=True):
        stem = f"{file_stem(part.name, len(parts))}{suffix}"
        if "step" in config.outputs and len(parts) > 1:
            write_step(folder / f"{stem}.step", config.name, [part])
            frames[f"{stem}.step"] = [0.0, 0.0, 0.0]
        to_origin = at_origin(low)
        printed = moved(part, to_origin)
        stl = folder / f"{stem}.stl" if "stl" in config.outputs else None
        three_mf = folder / f"{stem}.3mf" if "3mf" in config.outputs else None
        write_printable(printed, stl, three_mf, config.jig.stl_tolerance)
        frames |= {path.name: list(to_origin) for path in (stl, three_mf) if path is not None}
    return frames


def side_by_side(boxes: Sequence[tuple[FloatArray, FloatArray]]) -> list[tuple[float, float, float]]:
    """By how much each box moves so that all stand in a row along x; the first one stays in its place."""
    edge = boxes[0][0][0]
    places = []
    for low, high in boxes:
        by = _up(edge - low[0])
        places.append((by, 0.0, 0.0))
        edge = high[0] + by + _BETWEEN_MM
    return places


def at_origin(low: FloatArray) -> tuple[float, float, float]:
    """What brings a part's least x, y and z to 0, as slicers want it; never less than that."""
    x, y, z = (_up(-float(value)) for value in low)
    return (x, y, z)


def _up(value: float) -> float:
    """Rounded up, as the report says it; what is only rounding of 0 is 0."""
    return 0.0 + math.ceil(value * 1e4 - 1e-6) / 1e4


def write_wires(wires: Wires, ring: JumpRing | None, config: Config, path: Path) -> tuple[Finding, ...]:
    """`wires.step`: solids and centrelines as they lie on a jig's plate whose bottom is z = 0.

    Returns a finding for each wire whose solid isn't sound and stays out.
    """
    from wrapit.kernel.files import FilePart, write_step
    from wrapit.kernel.objects import moved
    from wrapit.kernel.round_wires.sweeps import round_wire

    made = [(w, round_wire(w.centreline, w.diameter_mm, w.lifts, w.name)) for w in wires]
    parts = [FilePart(w.name, m.solid, w.colour, (m.centreline,)) for w, m in made]
    if ring is not None:
        parts.append(FilePart("jump-ring", _ring_solid(ring), METALS[config.wire.metal].colour))
    on_plate = (0.0, 0.0, config.jig.base_thickness + config.wire.gauge / 2)
    write_step(path, config.name, [moved(part, on_plate) for part in parts])
    return tuple(
        Finding(
            "warning",
            "wire-without-solid",
            w.name,
            f"its round solid is not sound ({m.flaw}); {path.name} holds its centreline alone",
            "bends tighter than the wire is thick have no sound solid: make the piece larger",
        )
        for w, m in made
        if m.solid is None
    )


def _ring_solid(ring: JumpRing) -> Any:
    from wrapit.kernel.round_wires.sweeps import torus

    u, v = ring.outward
    return torus(ring.centre, (-v, u, 0.0), ring.radius_mm, ring.diameter_mm / 2, "jump-ring")
