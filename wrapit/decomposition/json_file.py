"""`decomposition.json`, as other programs read it."""

from __future__ import annotations

import json
from collections.abc import Collection
from dataclasses import asdict
from typing import Any

from wrapit.decomposition.model import Solution


def wire_name(index: int) -> str:
    """Name of the wire that trail `index` becomes.

    >>> wire_name(0)
    'wire-01'
    """
    return f"wire-{index + 1:02d}"


def wire_number(name: str) -> int:
    """The number, from 1, of the wire with a name.

    >>> wire_number("wire-12")
    12
    """
    return int(name.rpartition("-")[2])


def decomposition_json(solution: Solution) -> str:
    """The text of `decomposition.json` (format `wrapit-decomposition/1`), one wire per line."""
    document = decomposition_summary(solution)
    wires = [
        {
            "name": wire_name(index),
            "closed": trail.closed,
            "traversals": [[t.segment, t.reversed] for t in trail.traversals],
        }
        for index, trail in enumerate(solution.trails)
    ]
    lines = []
    for key, value in ({**document, "wires": wires}).items():
        if key == "wires":
            text = "[\n" + ",\n".join(f"    {json.dumps(wire)}" for wire in wires) + "\n  ]"
        else:
            text = json.dumps(value, allow_nan=False)
        lines.append(f"  {json.dumps(key)}: {text}")
    return "{\n" + ",\n".join(lines) + "\n}\n"


def decomposition_summary(solution: Solution) -> dict[str, Any]:
    """Everything in `decomposition.json` but the wires, as `report.json` repeats it.

    Symmetry and doubling appear among the weights and energies only where they have a part in it.
    """
    unasked = set()
    if solution.weights.symmetry == 0:
        unasked |= {"symmetry", "asymmetry"}
    if solution.energy.doubling == 0:
        unasked.add("doubling")
    return {
        "format": "wrapit-decomposition/1",
        "solver": solution.solver,
        "seed": solution.seed,
        "energy": _without(asdict(solution.energy), unasked),
        "weights": _without(asdict(solution.weights), unasked),
        "lower_bound": solution.lower_bound,
        "optimal": solution.optimal,
        "bridges_used": list(solution.bridges_used),
        "doubled": list(solution.doubled),
        "iterations": solution.iterations,
    }


def _without(terms: dict[str, Any], names: Collection[str]) -> dict[str, Any]:
    return {name: value for name, value in terms.items() if name not in names}
