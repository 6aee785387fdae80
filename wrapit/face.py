"""The stages for programs: paths may be texts, the config may be left out, what is heavy comes when needed.

Each of `trace`, `decompose`, `draw_wires` and `build_jigs` takes what the one before returns first, and
returns its model with its findings; so does `make_fit`, whose drawing may take the place of the traced one.
`build` and `check` return the report, which holds them.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from wrapit.config import Config
    from wrapit.decomposition.model import Solution
    from wrapit.drawing.model import Drawing
    from wrapit.errors import Finding
    from wrapit.fit.model import Bead, Fitted
    from wrapit.jig.model import JigSet
    from wrapit.pipeline.build import Build
    from wrapit.pipeline.work import Stage
    from wrapit.wires.model import Wire


Paths = str | PathLike[str] | Sequence[str | PathLike[str]]
"""A config or several, merged left to right; `:pendant` and the like are presets."""


def load_config(path: Paths, overrides: Sequence[str] = ()) -> Config:
    """The config in a YAML file, or in several; `overrides` are `key=value`, as with `--set`.

    Raises ConfigError naming file, line and key.
    """
    from wrapit.config import load_config as load

    return load(_paths(path), overrides)


def trace(
    path: str | PathLike[str], config: Config | None = None, size_mm: float | None = None
) -> tuple[Drawing, tuple[Finding, ...]]:
    """The drawing in a bitmap, SVG or JSON file.

    `size_mm` is the longest side of the piece, instead of the config's `size`; a bitmap needs one of them.
    Raises ConfigError where it is missing or no length, DrawingError where the file is no line drawing.
    """
    from wrapit.drawing.stage import trace as run

    config = config if config is not None else _usual()
    return run(Path(path), config.reading, _checked(size_mm) if size_mm is not None else config.size)


def make_fit(drawing: Drawing, config: Config) -> tuple[Fitted, tuple[Finding, ...]]:
    """The drawing as the config's wire can follow it (`Fitted.drawing`), as its `fit`, `keep`, `drop` and
    `beads` say.

    Raises ConfigError where `keep` or `drop` names no segment, or names one in both.
    """
    from wrapit.fit.stage import make_fit as run

    return run(drawing, config)


def decompose(drawing: Drawing, config: Config | None = None) -> tuple[Solution, tuple[Finding, ...]]:
    """The best wires for a drawing, as trails over its segments.

    Raises DecompositionError where the wishes in the config can't be met together.
    """
    from wrapit.decomposition.stage import decompose as run
    from wrapit.wires.beside.side_by_side import room_of

    config = config if config is not None else _usual()
    return run(drawing, config.decomposition, room_of(config))


def draw_wires(
    solution: Solution, config: Config | None = None, beads: Sequence[Bead] = ()
) -> tuple[tuple[Wire, ...], tuple[Finding, ...]]:
    """The wires as exact curves, with turns, lengths, ties and beads; longest first. Raises WireError."""
    from wrapit.wires.stage import draw_wires as run

    return run(solution, config if config is not None else _usual(), beads)


def build_jigs(wires: Sequence[Wire], config: Config | None = None) -> tuple[JigSet, tuple[Finding, ...]]:
    """The printed jigs as solids, checked; they bend further than drawn where the config says so.

    Raises JigError where no jig holds the wires, KernelError where the solid modeller fails.
    """
    from wrapit.jig.overbending import overbend_wires
    from wrapit.jig.printed.stage import build_jig

    config = config if config is not None else _usual()
    laid = tuple(wires)
    said: tuple[Finding, ...] = ()
    if config.jig.springback == "compensate":
        bent, said = overbend_wires(laid, config)
        laid = tuple(each.wire for each in bent)
    jigs, findings = build_jig(laid, config.jig)
    return jigs, (*said, *findings)


def build(
    config: Paths,
    folder: str | PathLike[str] | None = None,
    overrides: Sequence[str] = (),
    until: Stage = "exports",
    force: bool = False,
    alternatives: int = 0,
) -> Build:
    """Builds a piece into a folder (default `build/<name>`), as `wrapit build` does.

    Its solids are made in a process of their own, which starts by importing the calling script: call it
    below `if __name__ == "__main__":`. Raises the WrapItError of the stage that fails.
    """
    from wrapit.pipeline.build import build as run

    target = None if folder is None else Path(folder)
    return run(_paths(config), target, overrides, until, force, alternatives)


def check(config: Paths, overrides: Sequence[str] = (), *, exact: bool = False) -> Build:
    """Finds what a build would find and writes nothing, as `wrapit check` does.

    With `exact` the kernel also cuts the finished jig with each wire, which takes some seconds a wire. To be
    called as `build` is, and raises what it raises.
    """
    from wrapit.pipeline.build import check as run

    return run(_paths(config), overrides, exact=exact)


def _paths(paths: Paths) -> list[Path]:
    return [Path(paths)] if isinstance(paths, str | PathLike) else [Path(path) for path in paths]


def _usual() -> Config:
    """What a config says that names nothing but a drawing."""
    from wrapit.config import Config

    return Config(drawing="drawing.svg")


def _checked(size_mm: float) -> float:
    """A size that the config would take, too."""
    from pydantic import ValidationError

    from wrapit.config import Config
    from wrapit.errors import ConfigError

    text = f"{float(size_mm)} mm" if math.isfinite(size_mm) else "0 mm"
    try:
        checked = Config.model_validate({"drawing": "drawing.svg", "size": text}).size
    except ValidationError as error:
        _, _, remedy = str(error.errors()[0]["ctx"]["error"]).partition("; ")
        raise ConfigError(f"{size_mm} mm is out of range", "size_mm", remedy) from None
    assert checked is not None
    return checked
