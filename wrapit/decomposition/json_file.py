"""`decomposition.json`, as other programs read it."""

from __future__ import annotations

import json
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

    Symmetry appears among the weights and energies only where it was asked for.
    """
    symmetric = solution.weights.symmetry > 0
    return {
        "format": "wrapit-decomposition/1",
        "solver": solution.solver,
        "seed": solution.seed,
        "energy": _without(asdict(solution.energy), "asymmetry", keep=symmetric),
        "weights": _without(asdict(solution.weights), "symmetry", keep=symmetric),
        "lower_bound": solution.lower_bound,
        "optimal": solution.optimal,
        "bridges_used": list(solution.bridges_used),
        "doubled": list(solution.doubled),
        "iterations": solution.iterations,
    }


def _without(terms: dict[str, Any], key: str, *, keep: bool) -> dict[str, Any]:
    return {name: value for name, value in terms.items() if keep or name != key}
