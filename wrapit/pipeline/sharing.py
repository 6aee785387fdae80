"""Like things made by two: the kernel's process makes some of them while it has nothing else to do."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, TypeVar

from wrapit.pipeline.worker import Job, OnCall

if TYPE_CHECKING:
    from wrapit.jig.made import Each

T = TypeVar("T")
R = TypeVar("R")


def shared(kernel: OnCall, where: str, limit_s: float) -> Each:
    """`Each` for two processes: this one goes through the things from the first on, the other from the last.

    The results are the same as of one. A kernel's process that doesn't run isn't started for it; errors are
    those of `Worker.result`, in which the work is called `where`.
    """

    def each(make: Callable[[T], R], things: Sequence[T], /) -> list[R]:
        made: list[R] = []
        others: list[Job] = []
        while len(made) + len(others) < len(things):
            last = len(things) - 1 - len(others)
            if last > len(made) and kernel.is_free():
                others.append(kernel.worker().start(where, limit_s, make, things[last]))
            made.append(make(things[len(made)]))
        return [*made, *(kernel.worker().result(job) for job in reversed(others))]

    return each
