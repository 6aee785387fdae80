"""What goes wrong, said so that a person can act: problem, place, remedy."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Literal

Level = Literal["note", "warning", "error"]


@dataclass(frozen=True)
class Finding:
    """Something the maker should know about a result; `code` is stable, the rest is for reading."""

    level: Level
    code: str
    where: str
    message: str
    remedy: str = ""


class WrapItError(Exception):
    """A mistake that the user can repair. `exit_code` is what the command line returns.

    The three texts are the exception's `args`, so that it survives pickling between processes.
    """

    exit_code: ClassVar[int] = 1

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


class DrawingError(WrapItError):
    """The drawing can't be read, or is no line drawing."""

    exit_code = 3


class DecompositionError(WrapItError):
    """The drawing can't be divided into wires as asked."""

    exit_code = 3


class WireError(WrapItError):
    """A wire can't be bent as the drawing asks."""

    exit_code = 3


class JigError(WrapItError):
    """No jig that works can be made as asked."""

    exit_code = 3


class KernelError(WrapItError):
    """A geometric operation failed or didn't end."""


class ExportError(WrapItError):
    """A file couldn't be written."""
