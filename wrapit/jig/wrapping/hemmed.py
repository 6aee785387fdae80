"""Where a jig is a channel: walls on both sides of a wire, which the paper (section 5) tried and gave up."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from wrapit.errors import Finding
from wrapit.geometry import FloatArray
from wrapit.geometry.arrays import runs
from wrapit.jig.channel import SIDES, Channels
from wrapit.wires.model import Turn

# So near to the wire's surface a wall hems it in.
BESIDE_MM = 0.75
STEP_MM = 0.2
# Over so much of a wire the walls at a crossing may stand on both sides. In our seven pieces all runs are of
# 4.0 mm or less but two of 4.6 mm in the bee, which are told.
CROSSING_MM = 4.0

Mask = NDArray[np.bool_]


def hemmed_share(channels: Channels, walls: Iterable[Any]) -> float:
    """The share of the wires' length that has a wall (shapely polygon) close by on both sides."""
    return float(np.concatenate([hemmed for _, hemmed in _places(channels, walls)]).mean())


def hemmed_findings(channels: Channels, walls: Iterable[Any]) -> tuple[Finding, ...]:
    """A note for each wire that walls (shapely polygons) hem in over more than a crossing, at the longest."""
    findings = []
    for wire, (at_mm, hemmed) in zip(channels.wires, _places(channels, walls), strict=True):
        spans = [(float(at_mm[first]), float(at_mm[last])) for first, last in runs(hemmed)]
        long = [(start, end) for start, end in spans if end - start > CROSSING_MM]
        if not long:
            continue
        start, end = max(long, key=lambda span: span[1] - span[0])
        places = f", and at {len(long) - 1} more places" if len(long) > 1 else ""
        findings.append(
            Finding(
                "note",
                "hemmed",
                f"{wire.name} at {(start + end) / 2:.0f} mm",
                f"walls stand on both sides over {end - start:.0f} mm{places}: each holds a wire there",
                "press the wire in with a rounded stick there",
                severity=end - start,
                wire=wire.name,
                places_mm=((start + end) / 2,),
            )
        )
    return tuple(findings)


def _places(channels: Channels, walls: Iterable[Any]) -> list[tuple[FloatArray, Mask]]:
    """For each wire places along it (n,), mm, and whether it is hemmed in there (n,)."""
    import shapely

    standing = shapely.union_all(list(walls))
    shapely.prepare(standing)
    radius_mm = channels.diameter_mm / 2
    places = []
    for wire in channels.wires:
        whole = Turn(wire.name, 0.0, wire.length_mm, "left", 0.0)
        at_mm, points, normals, _ = channels.stations(whole, STEP_MM)
        hemmed = np.ones(len(points), dtype=bool)
        for side in SIDES.values():
            ends = (points + side * radius_mm * normals, points + side * (radius_mm + BESIDE_MM) * normals)
            hemmed &= shapely.intersects(standing, shapely.linestrings(np.stack(ends, axis=1)))
        places.append((at_mm, hemmed))
    return places
