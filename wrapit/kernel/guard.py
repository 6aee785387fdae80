"""The kernel's exceptions as errors that say what was being done, and where."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from wrapit.errors import KernelError

# What helps where the kernel stumbles: its faults hang on chance meetings of curves, which a small change
# parts.
REMEDY = "change the size or the clearance a little"


@contextmanager
def guarded(doing: str, where: str) -> Iterator[None]:
    """Turns any exception of the kernel into a KernelError with the place; gives KernelErrors theirs."""
    try:
        yield
    except KernelError as failure:
        if failure.where:
            raise
        raise KernelError(failure.problem, where, failure.remedy or REMEDY) from failure
    except Exception as failure:
        if not _of_the_kernel(failure):
            raise
        # What the kernel says is in its own words, or in French: it stays with the cause.
        raise KernelError(f"{doing} failed", where, REMEDY) from failure


def _of_the_kernel(failure: Exception) -> bool:
    """The binding's exceptions share no base class, only their module; some come as RuntimeError."""
    return type(failure).__module__.split(".")[0] == "OCP" or isinstance(failure, RuntimeError)
