"""What runs in the kernel's process: solids, and the files that need them."""

from __future__ import annotations

import dataclasses
from pathlib import Path
from typing import Any

from wrapit.config import Config, JigKind
from wrapit.errors import Finding
from wrapit.jig.made import Made, Wires
from wrapit.materials import METALS
from wrapit.wires.model import JumpRing

# What loads for seconds, while drawing and wires are made.
PRELOAD = ("wrapit.kernel.files", "wrapit.jig.printed.stage")


def make_solids(kind: JigKind, wires: Wires, config: Config, folder: Path | None, suffix: str = "") -> Made:
    """The jig of a kind with solids, built and checked; its files in `folder`, `jig{suffix}.step` and so on.

    `wires` are as they lie in the jig. The result holds no kernel shapes.
    """
    from wrapit.jig.kinds import JIGS

    made = JIGS[kind].make(wires, config)
    if folder is not None:
        _write(made, config, folder, suffix)
    return dataclasses.replace(
        made, parts=tuple(dataclasses.replace(part, solid=None) for part in made.parts)
    )


def _write(made: Made, config: Config, folder: Path, suffix: str) -> None:
    from wrapit.kernel.files import FilePart, write_3mf, write_step, write_stl

    parts = [FilePart(part.name, part.solid, part.colour) for part in made.parts]
    if "step" in config.outputs:
        write_step(folder / f"jig{suffix}.step", config.name, parts)
    for part in parts:
        stem = f"{part.name if len(parts) > 1 else 'jig'}{suffix}"
        if "stl" in config.outputs:
            write_stl(folder / f"{stem}.stl", [part.solid], config.jig.stl_tolerance)
        if "3mf" in config.outputs:
            write_3mf(folder / f"{stem}.3mf", [part])


def write_wires(wires: Wires, ring: JumpRing | None, config: Config, path: Path) -> tuple[Finding, ...]:
    """`wires.step`: solids and centrelines; a finding for each wire whose solid isn't sound and stays out."""
    from wrapit.kernel.files import FilePart, write_step
    from wrapit.kernel.sweeps import round_wire

    made = [(w, round_wire(w.centreline, w.diameter_mm, w.lifts, w.name)) for w in wires]
    parts = [FilePart(w.name, m.solid, w.colour, (m.centreline,)) for w, m in made]
    if ring is not None:
        parts.append(FilePart("jump-ring", _ring_solid(ring), METALS[config.wire.metal].colour))
    write_step(path, config.name, parts)
    return tuple(
        Finding(
            "warning",
            "wire-without-solid",
            w.name,
            f"its round solid is not sound ({m.flaw}); {path.name} holds its centreline alone",
            "folds, and bends tighter than the wire is thick, have no sound solid: make the piece larger",
        )
        for w, m in made
        if m.solid is None
    )


def _ring_solid(ring: JumpRing) -> Any:
    from wrapit.kernel.sweeps import torus

    u, v = ring.outward
    return torus(ring.centre, (-v, u, 0.0), ring.radius_mm, ring.diameter_mm / 2, "jump-ring")
