"""Linear programmes with integer variables, solved by HiGHS through scipy."""

from __future__ import annotations

import ctypes
import os
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

import numpy as np

# HiGHS stops when the gap is below 1e-6, which scipy can't change: scaling the costs makes it 1e-9.
_SCALE = 1e3

Name = tuple[Any, ...]


@dataclass(frozen=True)
class Optimum:
    """Values by name; `bound` is proven. `values` is None where none was found in the nodes allowed."""

    values: Mapping[Name, float] | None
    bound: float
    nodes: int
    feasible: bool


@dataclass
class Programme:
    """Minimise Σ cost · x over x in [0, 1] with rows low ≤ Σ coefficient · x ≤ high."""

    columns: dict[Name, int] = field(default_factory=dict)
    costs: list[float] = field(default_factory=list)
    whole: list[bool] = field(default_factory=list)
    rows: list[tuple[dict[Name, float], float, float]] = field(default_factory=list)
    _entries: list[tuple[int, int, float]] = field(default_factory=list)
    _reached: tuple[int, int] = (0, 0)

    def add_column(self, name: Name, cost: float, *, whole: bool = True) -> None:
        """A variable, unless it is there already."""
        if name not in self.columns:
            self.columns[name] = len(self.columns)
            self.costs.append(cost)
            self.whole.append(whole)

    def add_row(self, coefficients: dict[Name, float], low: float = -np.inf, high: float = np.inf) -> None:
        """A row; names without a column count as zero."""
        self.rows.append((coefficients, low, high))

    def solve(self, node_limit: int, gap: float = 0.0, held: Mapping[Name, float] | None = None) -> Optimum:
        """The optimum (within a share `gap` of it), or what is known of it after so many nodes.

        Some columns may be `held` at a value; names without a column count for nothing.
        """
        if not self.columns:
            return Optimum({}, 0.0, 0, all(low <= 0 <= high for _, low, high in self.rows))
        from scipy.optimize import Bounds, LinearConstraint, milp
        from scipy.sparse import csr_array

        entries = self._entered()
        rows, columns, coefficients = zip(*entries, strict=True) if entries else ((), (), ())
        matrix = csr_array((coefficients, (rows, columns)), shape=(len(self.rows), len(self.columns)))
        low, high = np.zeros(len(self.columns)), np.ones(len(self.columns))
        for name, value in (held or {}).items():
            if name in self.columns:
                low[self.columns[name]] = high[self.columns[name]] = value
        with silent_stdout():
            outcome = milp(
                np.array(self.costs) * _SCALE,
                integrality=np.array(self.whole, dtype=int),
                bounds=Bounds(low, high),
                constraints=LinearConstraint(
                    matrix, [low for _, low, _ in self.rows], [high for _, _, high in self.rows]
                ),
                options={"disp": False, "mip_rel_gap": gap, "node_limit": node_limit},
            )
        infeasible = outcome.status == 2
        values = None
        if outcome.x is not None:
            values = {name: float(outcome.x[column]) for name, column in self.columns.items()}
        bound = outcome.get("mip_dual_bound")
        if bound is None or not np.isfinite(bound):
            bound = -np.inf
        return Optimum(values, float(bound) / _SCALE, int(outcome.get("mip_node_count") or 0), not infeasible)

    def _entered(self) -> list[tuple[int, int, float]]:
        """Row, column and coefficient of all that isn't zero; what was there at the last call is kept."""
        rows, columns = self._reached
        if columns != len(self.columns):  # a name that counted as zero may be one of the new
            rows, self._entries = 0, []
        self._entries += [
            (rows + row, self.columns[name], coefficient)
            for row, (coefficients, _, _) in enumerate(self.rows[rows:])
            for name, coefficient in coefficients.items()
            if name in self.columns
        ]
        self._reached = len(self.rows), len(self.columns)
        return self._entries


@contextmanager
def silent_stdout() -> Iterator[None]:
    """Keeps standard output for results: HiGHS prints some warnings there whatever it is told."""
    library = ctypes.CDLL("ucrtbase" if os.name == "nt" else None)
    if sys.stdout is not None:
        sys.stdout.flush()
    library.fflush(None)
    saved, nowhere = os.dup(1), os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    try:
        yield
    finally:
        library.fflush(None)
        os.dup2(saved, 1)
        os.close(saved)
        os.close(nowhere)
