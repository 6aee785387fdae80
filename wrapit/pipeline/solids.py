"""What runs in the kernel's process: the jig's solids, and the files that need them."""

from __future__ import annotations

import dataclasses
from pathlib import Path
from typing import TYPE_CHECKING, Any

from wrapit.config import Config
from wrapit.errors import Finding
from wrapit.jig.model import Jig, JigSet
from wrapit.materials import METALS
from wrapit.wires.model import JumpRing, Wire

if TYPE_CHECKING:
    from wrapit.kernel.files import FilePart

PRELOAD = ("wrapit.kernel.files", "wrapit.jig.printed.stage")


def make_solids(
    wires: tuple[Wire, ...],
    laid: tuple[Wire, ...],
    ring: JumpRing | None,
    config: Config,
    folder: Path | None,
    suffix: str = "",
) -> tuple[JigSet, tuple[Finding, ...]]:
    """The jigs, built and checked; their files in `folder`, `jig{suffix}.step` and so on.

    `laid` are the wires as they lie in the jig; a jump ring is in `wires{suffix}.step`.
    The result holds no kernel shapes.
    """
    from wrapit.jig.printed.stage import build_jig

    jigs, findings = build_jig(laid, config.jig)
    if folder is not None:
        findings += _write(jigs, wires, ring, config, folder, suffix)
    bare = tuple(
        dataclasses.replace(jig, part=dataclasses.replace(jig.part, solid=None)) for jig in jigs.jigs
    )
    return dataclasses.replace(jigs, jigs=bare), findings


def _write(
    jigs: JigSet, wires: tuple[Wire, ...], ring: JumpRing | None, config: Config, folder: Path, suffix: str
) -> tuple[Finding, ...]:
    from wrapit.kernel.files import write_3mf, write_step, write_stl

    findings: tuple[Finding, ...] = ()
    if "step" in config.outputs:
        findings = _write_wires(wires, ring, config, folder / f"wires{suffix}.step")
        write_step(folder / f"jig{suffix}.step", config.name, [_jig_part(jig) for jig in jigs.jigs])
    for jig in jigs.jigs:
        stem = f"{jig.name if len(jigs.jigs) > 1 else 'jig'}{suffix}"
        if "stl" in config.outputs:
            write_stl(folder / f"{stem}.stl", [jig.part.solid], config.jig.stl_tolerance)
        if "3mf" in config.outputs:
            write_3mf(folder / f"{stem}.3mf", [_jig_part(jig)])
    return findings


def _jig_part(jig: Jig) -> FilePart:
    from wrapit.kernel.files import FilePart

    return FilePart(jig.part.name, jig.part.solid, jig.part.colour)


def _write_wires(
    wires: tuple[Wire, ...], ring: JumpRing | None, config: Config, path: Path
) -> tuple[Finding, ...]:
    """Solids and centrelines; a finding for each wire whose solid isn't sound and stays out."""
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
