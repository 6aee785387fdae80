"""What a build makes of a config up to its wires, made to see what would be."""

from __future__ import annotations

import contextlib
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Final, Literal

from wrapit.config import Config, TracingConfig
from wrapit.pipeline.reads import takes_fit

if TYPE_CHECKING:
    from wrapit.drawing.model import Drawing
    from wrapit.errors import Finding
    from wrapit.fit.model import Fitted
    from wrapit.wires.model import Wire

FitLevel = Literal["gentle", "bold"]
LEVELS: Final[tuple[FitLevel, ...]] = ("gentle", "bold")
"""Of `fit`, the one that changes less first."""


@dataclass(frozen=True, eq=False)
class Traced:
    """A drawing, and how it was read."""

    drawing: Drawing
    reading: TracingConfig

    def serves(self, reading: TracingConfig) -> bool:
        """Whether another reading gives this drawing: in one piece it is the same, joined or not."""
        if self.reading == reading:
            return True
        whole = self.reading.components == "largest" and all(r.what != "piece" for r in self.drawing.removed)
        return whole and self.reading.model_copy(update={"components": reading.components}) == reading


@dataclass(frozen=True, eq=False)
class Tried:
    """What the stages made; `fitted` is None where that stage isn't taken."""

    drawing: Drawing
    fitted: Fitted | None
    wires: tuple[Wire, ...]
    findings: tuple[Finding, ...]
    """Of the wires."""

    @property
    def tight_bends(self) -> tuple[Finding, ...]:
        """Those that the metal doesn't take."""
        return tuple(each for each in self.findings if is_tight(each))


def is_tight(finding: Finding) -> bool:
    """Whether it tells of a bend that the metal doesn't take."""
    return finding.code == "tight-bend" and finding.level != "note"


def read(config: Config, path: Path, known: Traced | None = None) -> tuple[Drawing, Fitted | None]:
    """The drawing that a build divides into wires: traced, and made fit where the config asks for it.

    What is `known` of the file isn't traced again. Raises the WrapItError of the stage that fails.
    """
    if known is not None and known.serves(config.reading):
        drawing = known.drawing
    else:
        drawing = _traced(path, _saved(path), config.reading.model_dump_json(), config.size)
    if not takes_fit(config):
        return drawing, None
    from wrapit.fit.stage import make_fit

    fitted, _ = make_fit(drawing, config)
    return fitted.drawing, fitted


@lru_cache(maxsize=4)  # trials of one piece differ in little that its drawing depends on
def _traced(path: Path, saved: tuple[int, ...], reading: str, size_mm: float | None) -> Drawing:
    from wrapit.drawing.stage import trace

    del saved  # it is what the drawing is known by
    return trace(path, TracingConfig.model_validate_json(reading), size_mm)[0]


def _saved(path: Path) -> tuple[int, ...]:
    """What tells that a file is another now; nothing of one that isn't there."""
    with contextlib.suppress(OSError):  # tracing says what is wrong with it
        about = path.stat()
        return about.st_mtime_ns, about.st_size, about.st_ino
    return ()


def tried(config: Config, path: Path, known: Traced | None = None) -> Tried:
    """The wires that a build would make. Raises the WrapItError of the stage that fails."""
    from wrapit.decomposition.stage import decompose
    from wrapit.wires.beside.side_by_side import room_of
    from wrapit.wires.stage import draw_wires

    drawing, fitted = read(config, path, known)
    beads = fitted.beads if fitted is not None else ()
    solution, _ = decompose(drawing, config.decomposition, room_of(config))
    wires, findings = draw_wires(solution, config, beads)
    return Tried(drawing, fitted, wires, findings)


def with_fit(config: Config, level: FitLevel) -> Config:
    """The config with another `fit`."""
    return config.model_copy(update={"fit": level})


def bolder(config: Config) -> tuple[FitLevel, ...]:
    """The levels that change more than the config's."""
    return LEVELS if config.fit == "off" else LEVELS[LEVELS.index(config.fit) + 1 :]
