"""What the stages of one build have made so far."""

from __future__ import annotations

import contextlib
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Final, Literal, get_args

from wrapit.config import Config, JigKind
from wrapit.decomposition.model import Solution
from wrapit.drawing.model import Drawing
from wrapit.errors import Finding
from wrapit.jig.made import Made
from wrapit.wires.model import JumpRing, Wire

Stage = Literal["drawing", "decomposition", "wires", "jig", "exports"]
# In the order in which they run.
STAGES: Final[tuple[Stage, ...]] = get_args(Stage)
Progress = Callable[[str], None]
AfterStage = Callable[[str, "Work"], None]
"""Told after each stage: its name, and what there is by then."""


@dataclass
class Work:
    """What the stages have made so far."""

    config: Config
    drawing_path: Path
    until: Stage
    progress: Progress
    alternatives: int
    exact: bool = False
    """Whether solids are judged once more, by the kernel's booleans."""

    after: AfterStage = lambda stage, work: None
    timings_s: dict[str, float] = field(default_factory=dict)
    findings: list[Finding] = field(default_factory=list)
    drawing: Drawing | None = None
    solution: Solution | None = None
    wires: tuple[Wire, ...] = ()
    laid: tuple[Wire, ...] = ()
    """The wires as they lie in the jig: bent further than drawn where it makes up for springback."""

    ring: JumpRing | None = None
    made: dict[JigKind, Made] = field(default_factory=dict)
    mirrored: Made | None = None
    report: dict[str, Any] = field(default_factory=dict)

    @contextlib.contextmanager
    def stage(self, name: str) -> Iterator[None]:
        self.progress(name)
        start = time.perf_counter()
        yield
        self.timings_s[name] = round(time.perf_counter() - start, 4)
        self.after(name, self)

    def reaches(self, stage: Stage) -> bool:
        return STAGES.index(self.until) >= STAGES.index(stage)
