"""Jigs and wires for a CAD script of one's own: build123d parts, cadquery workplanes and assemblies.

All of them lie in the piece's frame, in mm: x and y as in the drawing. A jig's plate has its bottom at z = 0.
A wire's lowest layer has its centreline at z = 0, or lies on the plate of the jig that is named with `on`.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from wrapit.errors import KernelError
from wrapit.jig.model import Jig, JigSet
from wrapit.kernel.objects import (
    FilePart,
    build123d_edge,
    build123d_part,
    cadquery_assembly,
    cadquery_workplane,
    moved,
)
from wrapit.kernel.round_wires.sweeps import round_wire
from wrapit.wires.model import Wire


def jig_part(jig: Jig) -> Any:
    """The jig as a `build123d.Part` with its name as label, and its colour.

    Raises KernelError where the jig holds no solid, as in the report of a build.
    """
    return build123d_part(_jig(jig))


def wire_part(wire: Wire, on: Jig | None = None) -> Any:
    """The round wire as a `build123d.Part`. Raises KernelError where it has no sound solid."""
    return build123d_part(_solid(_wire(wire, on)))


def wire_edge(wire: Wire, on: Jig | None = None) -> Any:
    """The wire's centreline as one `build123d.Edge`: an exact spline."""
    return build123d_edge(_wire(wire, on))


def jig_workplane(jig: Jig) -> Any:
    """The jig as a `cadquery.Workplane`, tagged with its name. Raises KernelError as `jig_part` does."""
    return cadquery_workplane(_jig(jig))


def wire_workplane(wire: Wire, on: Jig | None = None) -> Any:
    """The round wire as a `cadquery.Workplane`. Raises KernelError as `wire_part` does."""
    return cadquery_workplane(_solid(_wire(wire, on)))


def assembly(name: str, wires: Sequence[Wire], jigs: JigSet | None = None) -> Any:
    """A `cadquery.Assembly` of wires and jigs with names and colours; each wire lies on its jig's plate.

    Beside each wire is its centreline, also where its solid isn't sound and stays out.
    """
    parts = [_jig(jig) for jig in jigs.jigs] if jigs is not None else []
    parts += [_wire(wire, _holder(wire, jigs)) for wire in wires]
    return cadquery_assembly(name, parts)


def _holder(wire: Wire, jigs: JigSet | None) -> Jig | None:
    return next((jig for jig in jigs.jigs if wire.name in jig.wires), None) if jigs is not None else None


def _jig(jig: Jig) -> FilePart:
    if jig.part.solid is None:
        raise KernelError("this jig holds no solid", jig.name, "take it from build_jigs")
    return FilePart(jig.part.name, jig.part.solid, jig.part.colour)


def _wire(wire: Wire, on: Jig | None) -> FilePart:
    made = round_wire(wire.centreline, wire.diameter_mm, wire.lifts, wire.name)
    part = FilePart(wire.name, made.solid, wire.colour, (made.centreline,))
    if on is None:
        return part
    return moved(part, (0.0, 0.0, on.plan.plate.thickness_mm + wire.diameter_mm / 2))


def _solid(part: FilePart) -> FilePart:
    if part.solid is None:
        raise KernelError("this wire has no sound solid", part.name, "take its centreline, or a larger piece")
    return part
