"""What goes wrong, said so that a person can act: problem, place, remedy."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import ClassVar, Literal

Level = Literal["note", "warning", "error"]


@dataclass(frozen=True)
class Finding:
    """Something the maker should know about a result; `code` is stable, the rest is for reading.

    `severity` orders findings of one kind: the largest is the worst. What concerns places along a wire says
    so in `wire` and `places_mm` too.
    """

    level: Level
    code: str
    where: str
    message: str
    remedy: str = ""
    severity: float = field(default=0.0, compare=False)
    wire: str = field(default="", compare=False)
    places_mm: tuple[float, ...] = field(default=(), compare=False)


class WrapItError(Exception):
    """A mistake that the user can repair; `exit_code` is what the command line returns, `code` its kind.

    The three texts are the exception's `args`, so that it survives pickling between processes.
    """

    exit_code: ClassVar[int] = 1
    code: ClassVar[str] = "failure"

    def __init__(self, problem: str, where: str = "", remedy: str = "") -> None:
        super().__init__(problem, where, remedy)
        self.problem, self.where, self.remedy = problem, where, remedy

    def __str__(self) -> str:
        place = f"{self.where}: " if self.where else ""
        remedy = f"; {self.remedy}" if self.remedy else ""
        return " ".join(f"{place}{self.problem}{remedy}".split())


class ConfigError(WrapItError):
    """The config (or a command-line argument) is wrong."""

    exit_code = 2
    code = "config"


class DrawingError(WrapItError):
    """The drawing can't be read, or is no line drawing."""

    exit_code = 3
    code = "drawing"


class DecompositionError(WrapItError):
    """The drawing can't be divided into wires as asked."""

    exit_code = 3
    code = "decomposition"


class WireError(WrapItError):
    """A wire can't be bent as the drawing asks."""

    exit_code = 3
    code = "wire"


class JigError(WrapItError):
    """No jig that works can be made as asked."""

    exit_code = 3
    code = "jig"


class UnheldError(JigError):
    """The jig would hold too little of the wires' turns."""

    code = "unheld"


class KernelError(WrapItError):
    """A geometric operation failed or didn't end."""

    code = "kernel"


class ExportError(WrapItError):
    """A file couldn't be written."""

    code = "export"
