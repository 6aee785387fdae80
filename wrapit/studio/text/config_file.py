"""The config's file: read as it is now, judged as a build would judge it, and written whole."""

from __future__ import annotations

import errno
import hashlib
import os
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

from wrapit.config import Config, load_config
from wrapit.config.texts.reading import LARGEST_FILE
from wrapit.errors import ConfigError, WrapItError
from wrapit.pipeline.textfile import write_whole
from wrapit.studio.text.values import BOM, said
from wrapit.units import printable

# What a file holds that isn't there; an empty config is no config either.
_GONE: Final = b""
# Somebody may write it: its owner, the group or all.
_WRITABLE: Final = 0o222


@dataclass(frozen=True)
class Judged:
    """The bytes of a config and what they say; `problem` where they can't be built from."""

    content: bytes
    text: str
    data: dict[str, Any]
    config: Config | None
    problem: WrapItError | None

    @property
    def sha256(self) -> str:
        """Of the file's bytes."""
        return hashlib.sha256(self.content).hexdigest()


def content_of(path: Path) -> bytes:
    """The bytes of the file, no more than a config may have and one; none where there is no such file."""
    try:
        with path.open("rb") as file:
            return file.read(LARGEST_FILE + 1)
    except OSError:
        return _GONE


def judged(content: bytes, path: Path) -> Judged:
    """What the bytes of a config say; mistakes are named by the config's file name."""
    try:
        text = content.decode("utf-8")
    except UnicodeDecodeError:
        text = ""
    try:
        config: Config | None = _loaded(content, path)
        problem = None
    except WrapItError as error:
        config, problem = None, error
    try:
        data = said(text)
    except ConfigError:
        data = {}
    return Judged(content, text.removeprefix(BOM), data, config, problem)


def text_of(content: bytes, path: Path) -> str:
    """The text of a config that a change may be made to, with its mark of bytes. Raises ConfigError."""
    if not content:
        raise ConfigError("the config is gone or empty", path.name, "save it again")
    try:
        return content.decode("utf-8")
    except UnicodeDecodeError:
        raise ConfigError("the config is not UTF-8", path.name, "save it as UTF-8 text") from None


def write(path: Path, text: str) -> None:
    """Writes the config whole, through links, with the rights that it had. Raises ConfigError."""
    target = Path(os.path.realpath(path))
    try:
        if not target.exists():  # an undo brings it back
            write_whole(target, text)
            return
        mode = target.stat().st_mode & 0o7777
        # A file that is put in its place would pass over that.
        if not mode & _WRITABLE or not os.access(target, os.W_OK):
            raise PermissionError(errno.EACCES, "it is read-only")
        write_whole(target, text)
        target.chmod(mode)
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        raise ConfigError(
            f"can't be written ({reason})", path.name, "check its permissions and the disk"
        ) from None


def _loaded(content: bytes, path: Path) -> Config:
    """The config as a build loads it: from a file of the same name, so that nothing is judged otherwise."""
    if not content:
        raise ConfigError("the config is gone or empty", path.name, "save it again")
    with tempfile.TemporaryDirectory(prefix="wrapit-studio-") as folder:
        copy = Path(folder) / path.name
        copy.write_bytes(content)
        try:
            return load_config(copy)
        except WrapItError as error:
            where = error.where.replace(printable(str(copy)), path.name)
            raise type(error)(error.problem, where, error.remedy) from None
