"""The kernel's exceptions, told with what was being done and where."""

from __future__ import annotations

import pytest

from wrapit.errors import KernelError
from wrapit.kernel.guard import guarded


def test_exceptions_of_the_kernel_become_errors() -> None:
    from OCP.gp import gp_Dir

    with (
        pytest.raises(KernelError, match=r"wire-03: making a direction failed"),
        guarded("making a direction", "wire-03"),
    ):
        gp_Dir(0, 0, 0)


def test_errors_without_a_place_get_one_and_others_keep_theirs() -> None:
    for thrown, told in (("", "wire-03: no room"), ("wire-01", "wire-01: no room")):
        with pytest.raises(KernelError, match=told), guarded("making it", "wire-03"):
            raise KernelError("no room", thrown)


def test_mistakes_of_the_programmer_stay_what_they_are() -> None:
    with pytest.raises(ValueError, match="mine"), guarded("making it", "wire-03"):
        raise ValueError("mine")
