"""Reads YAML configs; every mistake is named with file, line, column and a remedy."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

from pydantic import ValidationError

from wrapit.calling import pasted
from wrapit.config.naming import named_after
from wrapit.config.root import Config
from wrapit.config.texts.budgets import DEEPEST
from wrapit.config.texts.mistakes import explain, user_keys
from wrapit.config.texts.reading import read_yaml
from wrapit.config.texts.written import Written, merged, place_of, read_written, seen_from
from wrapit.errors import ConfigError
from wrapit.units import printable, shortened

LONGEST_OVERRIDE: Final = 10_000
"""Letters; the longest that makes sense is a list of some hundred constraints."""


@dataclass(frozen=True)
class Loaded:
    """A config, the file that the piece is named after, and all files that it was read from.

    `folder` is where the config's `drawing` is looked for.
    """

    config: Config
    named_by: Path
    folder: Path
    sources: tuple[Path, ...]

    @property
    def drawing_path(self) -> Path:
        return self.folder / self.config.drawing


def load_config(path: Path | Sequence[Path], overrides: Sequence[str] = ()) -> Config:
    """The config in `path`, with `--set` overrides such as `wire.gauge=20 AWG` applied.

    Several configs are merged left to right; `:pendant` and the like are presets. Where none says a name
    it gets that of the last file, made safe (`naming.named_after`).

    Raises ConfigError with `file:line:column key` for the first mistake.
    """
    return load(path, overrides).config


def load(path: Path | Sequence[Path], overrides: Sequence[str] = ()) -> Loaded:
    """As `load_config`, with the files. A drawing is relative to the file that names it, one that an
    override or no file names to the last of the files; raises what `load_config` raises."""
    written = _read(path)
    files = [each for each in written if not each.preset]
    folder = files[-1].path.parent if files else Path()
    data = _merged(written, folder, overrides)
    if not files and "drawing" not in data:
        raise ConfigError(
            "a preset has no drawing of its own",
            " ".join(printable(str(each.path)) for each in written),
            "give your config behind it, or --set drawing=bee.png",
        )
    config = _validated(data, written, overrides)
    named_by = files[-1].path if files else Path(config.drawing)
    if not config.name:
        config = config.model_copy(update={"name": named_after(named_by)[0]})
    return Loaded(config, named_by, folder, tuple(each.path for each in files))


def config_without_drawing(path: Path | Sequence[Path] = (), overrides: Sequence[str] = ()) -> Config:
    """The config, for what needs no drawing: none has to be named, nor any config at all."""
    written = _read(path) if path else []
    return _validated({"drawing": "none", **_merged(written, Path(), overrides)}, written, overrides)


def _read(path: Path | Sequence[Path]) -> list[Written]:
    paths = [path] if isinstance(path, Path) else list(path)
    if not paths:
        raise ConfigError("no config is given", remedy="give the path of a .yaml file")
    return [read_written(each) for each in paths]


def _merged(written: Sequence[Written], folder: Path, overrides: Sequence[str]) -> dict[str, Any]:
    blocks = [_plain(each.blocks) for each in written]
    for each, block in zip(written, blocks, strict=True):
        if not each.preset and isinstance(block.get("drawing"), str) and block["drawing"].strip():
            block["drawing"] = seen_from(folder, block["drawing"], each.path.parent)
    data = merged(blocks)
    for override in overrides:
        _apply(data, override)
    return data


def _validated(data: dict[str, Any], written: Sequence[Written], overrides: Sequence[str]) -> Config:
    try:
        return Config.model_validate(data)
    except ValidationError as error:
        raise _first_mistake(error, data, written, overrides) from None


def _first_mistake(
    error: ValidationError, data: dict[str, Any], written: Sequence[Written], overrides: Sequence[str]
) -> ConfigError:
    mistake, *others = error.errors(include_url=False)
    if mistake["type"] == "missing":  # a key that is mistyped explains the one that is missing
        mistyped = (each for each in others if each["type"] == "extra_forbidden")
        mistake = next((each for each in mistyped if each["loc"][:-1] == mistake["loc"][:-1]), mistake)
    keys = user_keys(mistake["loc"], data)
    dotted = ".".join(map(str, keys))
    problem, remedy = explain(mistake, keys)
    for override in reversed(overrides):
        if f"{dotted}.".startswith(f"{override.partition('=')[0]}."):
            return ConfigError(problem, _set(override), remedy)
    place = f"{place_of(keys, written)} {shortened(printable(dotted), 80)}"
    return ConfigError(problem, place.rstrip(), remedy)


def _apply(data: dict[str, Any], override: str) -> None:
    key, equals, text = override.partition("=")
    where, blocks = _set(override), key.split(".")
    if not equals or not all(blocks) or not key.isprintable():
        raise ConfigError("not of the form key=value", where, "write for example --set wire.gauge='20 AWG'")
    if len(override) > LONGEST_OVERRIDE or len(blocks) > DEEPEST:
        raise ConfigError("this is too long or too deep", where, f"see `{pasted('schema')}` for the keys")
    inner: Any = data
    for name in blocks[:-1]:
        inner = inner.setdefault(name, {}) if isinstance(inner, dict) else inner
    if not isinstance(inner, dict):
        raise ConfigError(
            f"{'.'.join(blocks[:-1])} is no block of keys", where, f"see `{pasted('schema')}` for the keys"
        )
    try:
        inner[blocks[-1]] = _plain(read_yaml(text, where))
    except ConfigError as error:
        raise ConfigError(error.problem, where, error.remedy) from None  # one line needs no line number


def _set(override: str) -> str:
    return f"--set {shortened(printable(override), 80)}"


def _plain(value: Any) -> Any:
    """ruamel's annotated containers and scalars as plain ones, so that type errors read well."""
    from ruamel.yaml.scalarbool import ScalarBoolean

    if isinstance(value, dict):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, list):
        return [_plain(item) for item in value]
    if isinstance(value, ScalarBoolean):  # one with an anchor, which is a whole number for Python
        return bool(value)
    for kind in (bool, int, float, str):
        if isinstance(value, kind):
            return kind(value)
    return value if value is None else str(value)
