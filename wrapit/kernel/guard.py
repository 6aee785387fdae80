"""The kernel's exceptions as errors that say what was being done, and where."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from wrapit.errors import KernelError


@contextmanager
def guarded(doing: str, where: str) -> Iterator[None]:
    """Turns any exception of the kernel into a KernelError with the place; passes KernelErrors on."""
    from OCP.Standard import Standard_Failure

    try:
        yield
    except (Standard_Failure, RuntimeError, ArithmeticError) as failure:
        reason = " ".join(str(failure).split()) or type(failure).__name__
        raise KernelError(
            f"{doing} failed ({reason})", where, "change the size or the clearance a little"
        ) from failure
