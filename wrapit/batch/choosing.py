"""Which pieces a batch makes: configs, folders of them, and patterns where no shell expanded them."""

from __future__ import annotations

import glob
import os
import unicodedata
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Final

from wrapit.batch.model import INDEX, LEDGER, Piece
from wrapit.calling import pasted
from wrapit.config import load_config, named_after
from wrapit.config.texts.presets import is_preset
from wrapit.errors import ConfigError, WrapItError

# What configs are called where a folder of them is given.
_SUFFIXES: Final = (".yaml", ".yml")


def choose(arguments: Sequence[Path], overrides: Sequence[str] = ()) -> tuple[Piece, ...]:
    """The pieces in the order of the arguments, a file that is named twice once.

    A config that can't be loaded is a piece with its trouble. Raises ConfigError where an argument stands for
    no file, and where two pieces would share a folder (also on systems that don't tell `Bee` from `bee`).
    """
    paths: dict[str, Path] = {}
    for argument in arguments:
        for path in _configs(argument):
            paths.setdefault(os.path.realpath(path), path)
    pieces = tuple(_piece(path, overrides) for path in paths.values())
    _refuse_shared_folders(pieces)
    return pieces


def _configs(argument: Path) -> Iterator[Path]:
    if is_preset(argument):
        raise ConfigError(
            "a preset is no piece of its own",
            str(argument),
            f"merge it: {pasted('build', argument, 'CONFIG')}",
        )
    if argument.is_dir():
        found = sorted(path for path in argument.iterdir() if _is_config(path))
        if not found:
            raise ConfigError(
                "this folder holds no *.yaml", str(argument), "name configs, or a folder of them"
            )
        yield from found
    elif glob.has_magic(str(argument)) and not os.path.lexists(argument):
        matches = (Path(name) for name in glob.glob(str(argument), recursive=True))  # noqa: PTH207  absolute too
        found = sorted(path for path in matches if path.is_file())
        if not found:
            raise ConfigError("no config is called so", str(argument), "name configs, or a folder of them")
        yield from found
    else:
        yield argument


def _is_config(path: Path) -> bool:
    return path.suffix.lower() in _SUFFIXES and not path.name.startswith(".") and path.is_file()


def _piece(path: Path, overrides: Sequence[str]) -> Piece:
    try:
        config = load_config(path, overrides)
    except WrapItError as error:
        return Piece(named_after(path)[0], path, trouble=error)
    return Piece(config.name, path, config)


def _refuse_shared_folders(pieces: Sequence[Piece]) -> None:
    taken: dict[str, Piece] = {}
    for piece in pieces:
        if piece.config is None:
            continue  # it is given no folder
        folder = _as_folder(piece.name)
        if folder in (LEDGER, INDEX):
            problem = f"the piece is called {piece.name!r} like a file of the batch"
            raise ConfigError(problem, str(piece.config_path), "give it another `name:`")
        other = taken.setdefault(folder, piece)
        if other is not piece:
            alike = "" if other.name == piece.name else f" and {other.name!r}, one folder on some systems"
            problem = f"{other.config_path} and this config are both called {piece.name!r}{alike}"
            raise ConfigError(problem, str(piece.config_path), "give one of them another `name:`")


def _as_folder(name: str) -> str:
    """What systems that tell neither capitals nor ways to write an accent apart make of a name."""
    return unicodedata.normalize("NFC", unicodedata.normalize("NFC", name).casefold())
