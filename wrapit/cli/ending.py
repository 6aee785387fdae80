"""What asks the program to end, and that it isn't forgotten where a library throws exceptions away."""

from __future__ import annotations

# The signals that asked this process to end.
came: list[int] = []


class Terminated(BaseException):
    """A signal asks the program to end; `exit_code` is what shells expect of it."""

    def __init__(self, signum: int) -> None:
        super().__init__(signum)
        self.signum = signum
        self.exit_code = 128 + signum


def heed() -> None:
    """Raises Terminated where a signal came before and nobody heeded it.

    An optional import amid which it came, for one, is taken by its library for a module that isn't there.
    """
    if came:
        raise Terminated(came[0])
