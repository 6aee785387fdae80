"""YAML text into blocks and values, within budgets: no file takes long, none fails without a clear line."""

from __future__ import annotations

import re
import stat
from pathlib import Path
from typing import Any, Final

from wrapit.calling import argument, pasted
from wrapit.config.texts.budgets import check_budgets
from wrapit.errors import ConfigError
from wrapit.units import printable, shortened

LARGEST_FILE: Final = 200_000
"""Bytes; a config has some hundred, and YAML takes seconds for a megabyte."""
DRAWINGS: Final = (
    ".png",
    ".jpg",
    ".jpeg",
    ".bmp",
    ".tif",
    ".tiff",
    ".webp",
    ".gif",
    ".svg",
    ".svgz",
    ".json",
)
"""Ends of files that are drawings; but JSON may be a config too, for it is YAML."""
_DRAWN: Final = re.compile(rb'\s*\{\s*"format"\s*:\s*"wrapit-drawing/')
"""How a drawing in JSON begins."""
UNREADABLE: Final = (ArithmeticError, AssertionError, AttributeError, LookupError, RecursionError, TypeError)
"""What the YAML library also raises when a value is not what it seems."""
_FORBIDDEN: Final = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\x7f\ud800-\udfff\ufffe\uffff]")
"""Characters that YAML 1.2 doesn't allow in a text (section 5.1)."""


def read_blocks(path: Path) -> dict[str, Any]:
    """The blocks of the config in `path`; they know their lines (attribute `lc`).

    Raises ConfigError with the place: for what is no file of text, no YAML, no block, or beyond a budget.
    """
    where = printable(str(path))
    data = read_yaml(_text_of(path, where), where)
    if not isinstance(data, dict):
        raise ConfigError("the config is not a block of keys", where, "start with 'drawing: my-drawing.png'")
    return data


def read_yaml(text: str, where: str) -> Any:
    """What the YAML `text` says; dates stay text. Raises ConfigError with `where:line:column`."""
    from ruamel.yaml.constructor import DuplicateKeyError
    from ruamel.yaml.error import MarkedYAMLError, YAMLError

    if found := _FORBIDDEN.search(text):
        problem = f"the character {printable(found[0])} can't be in a config"
        line, column = text.count("\n", 0, found.start()), found.start() - text.rfind("\n", 0, found.start())
        raise ConfigError(problem, f"{where}:{line + 1}:{column}", "take it away, and save the file as UTF-8")
    try:
        check_budgets(_yaml().parse(text), where)
        return _yaml().load(text)
    except MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        place = f"{where}:{mark.line + 1}:{mark.column + 1}" if mark else where
        twice = isinstance(error, DuplicateKeyError)
        remedy = "keep one of the two" if twice else "check indentation, colons and quotes"
        problem = shortened(error.problem or error.context or "a mistake", 150)
        raise ConfigError(f"not valid YAML: {problem}", place, remedy) from None
    except (YAMLError, ValueError, *UNREADABLE) as error:
        problem = f"not valid YAML: {shortened(reason(error), 150)}"
        raise ConfigError(problem, where, "check indentation and quotes") from None


def reason(error: Exception) -> str:
    """Why, never empty."""
    said = getattr(error, "strerror", None) or str(error)
    return " ".join(said.split()).lower() or f"a value can't be read, {type(error).__name__}"


def _text_of(path: Path, where: str) -> str:
    remedy = "give a YAML text file"
    try:
        kind = path.stat().st_mode
        if not stat.S_ISREG(kind):  # reading a pipe would wait for ever
            what = "a folder" if stat.S_ISDIR(kind) else "no ordinary file but a pipe, device or socket"
            raise ConfigError(f"the config can't be read (it is {what})", where, remedy)
        if path.suffix.lower() in DRAWINGS and path.suffix.lower() != ".json":
            raise _drawing(path, where)
        with path.open("rb") as file:
            content = file.read(LARGEST_FILE + 1)
    except FileNotFoundError:
        raise ConfigError("no such config", where, "give the path of a .yaml file") from None
    except (OSError, ValueError) as error:
        raise ConfigError(f"the config can't be read ({reason(error)})", where, remedy) from None
    if _DRAWN.match(content):
        raise _drawing(path, where)
    if len(content) > LARGEST_FILE:
        problem = f"the config is larger than {LARGEST_FILE // 1000} kB"
        raise ConfigError(problem, where, f"{remedy}; the drawing is a file of its own")
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        problem = f"the config can't be read (byte {error.start + 1}, in line {line}, is not UTF-8)"
        raise ConfigError(problem, where, "save it as UTF-8 text") from None


def _drawing(path: Path, where: str) -> ConfigError:
    """The refusal of what newcomers give: a drawing, where its config belongs."""
    remedy = f"write one for it with: {printable(pasted('init', argument(path)))}"
    return ConfigError("this is a drawing, no config", where, remedy)


def _yaml() -> Any:
    from ruamel.yaml import YAML
    from ruamel.yaml.constructor import RoundTripConstructor

    class Constructor(RoundTripConstructor):
        """Dates stay the text that they are: no key is a date, and 2001-13-45 is a name like others."""

    Constructor.add_constructor("tag:yaml.org,2002:timestamp", RoundTripConstructor.construct_scalar)
    yaml = YAML(typ="rt")
    yaml.Constructor = Constructor
    return yaml
