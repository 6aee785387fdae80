"""What the stages of one build have made so far."""

from __future__ import annotations

import contextlib
import time
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, Literal, get_args

from wrapit.config import Config, JigKind
from wrapit.errors import Finding
from wrapit.pipeline.cache.remembering import Outcome, keep, recall
from wrapit.pipeline.cache.store import Store
from wrapit.pipeline.reads import Keys

if TYPE_CHECKING:
    from wrapit.decomposition.model import Solution
    from wrapit.drawing.model import Drawing
    from wrapit.fit.model import Fitted
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
    """What the stages have made so far.

    Values that come from the cache are loaded when they are first asked for.
    """

    config: Config
    drawing_path: Path
    until: Stage
    progress: Progress
    alternatives: int
    exact: bool = False
    """Whether solids are judged once more, by the kernel's booleans."""

    after: AfterStage = lambda stage, work: None
    store: Store = field(default_factory=Store)
    drawing_sha256: str = ""
    timings_s: dict[str, float] = field(default_factory=dict)
    cached: list[str] = field(default_factory=list)
    """Stages that made nothing anew."""

    findings: list[Finding] = field(default_factory=list)
    report: dict[str, Any] = field(default_factory=dict)
    outcomes: dict[str, Outcome] = field(default_factory=dict)
    """By step; see `reads`."""

    kinds: tuple[JigKind, ...] = ()
    """Of the jigs that were made."""

    _anew: bool = False

    def __post_init__(self) -> None:
        self._keys = Keys(self.config, self.drawing_sha256, self.drawing_path.suffix.lower())

    @property
    def drawing(self) -> Drawing | None:
        """As it is divided into wires: made fit for them where the config asks for it."""
        read: Drawing | None = self._value("trace")
        return self.fitted.drawing if self.fitted is not None else read

    @property
    def fitted(self) -> Fitted | None:
        """The drawing beside the one that was read; None where nothing asks for another."""
        fitted: Fitted | None = self._value("fit")
        return fitted

    @property
    def solution(self) -> Solution | None:
        solution: Solution | None = self._value("decomposition")
        return solution

    @property
    def wires(self) -> tuple[Wire, ...]:
        return self._drawn[0]

    @property
    def laid(self) -> tuple[Wire, ...]:
        """The wires as they lie in the jig: bent further than drawn where it makes up for springback."""
        return self._value("laid") or self.wires

    @property
    def ring(self) -> JumpRing | None:
        return self._drawn[1]

    @property
    def made(self) -> dict[JigKind, Made]:
        return {kind: self._value(f"jig {kind}") for kind in self.kinds}

    @property
    def mirrored(self) -> Made | None:
        made: Made | None = self._value("mirrored jig")
        return made

    @property
    def has_mirrored(self) -> bool:
        """Whether there is a jig of the other earring; nothing is loaded to say so."""
        return "mirrored jig" in self.outcomes and bool(self.outcomes["mirrored jig"].blocks)

    @property
    def _drawn(self) -> tuple[tuple[Wire, ...], JumpRing | None]:
        drawn: tuple[tuple[Wire, ...], JumpRing | None] | None = self._value("wires")
        return drawn or ((), None)

    def _value(self, step: str) -> Any:
        return self.outcomes[step].value if step in self.outcomes else None

    @contextlib.contextmanager
    def stage(self, name: str) -> Iterator[None]:
        self.progress(name)
        self._anew = False
        start = time.perf_counter()
        yield
        self.timings_s[name] = round(time.perf_counter() - start, 4)
        if not self._anew:
            self.cached.append(name)
        self.after(name, self)

    def reaches(self, stage: Stage) -> bool:
        return STAGES.index(self.until) >= STAGES.index(stage)

    def key(self, step: str, *also: Any, upon: Iterable[str] = ()) -> str:
        """Under which key the cache has what a step makes; `also` and `upon` as for `Keys.of`."""
        return self._keys.of(step, *also, upon=upon)

    def recall(self, key: str, folder: Path | None) -> Outcome | None:
        """What a step made at another time, if the cache has it; its files are put into `folder`."""
        return recall(self.store, key, folder)

    def keep(self, key: str, outcome: Outcome, folder: Path | None) -> Outcome:
        """Puts into the cache what a step made anew, with its files in `folder`; returns it."""
        self._anew = True
        keep(self.store, key, outcome, folder)
        return outcome

    def remember(self, key: str, make: Callable[[], Outcome], folder: Path | None) -> Outcome:
        """What a step makes, from the cache where it is there."""
        return self.recall(key, folder) or self.keep(key, make(), folder)

    def take(self, step: str, outcome: Outcome) -> None:
        """Puts what a step made into its place, its findings and its blocks of the report to the others."""
        self.outcomes[step] = outcome
        self.findings += outcome.findings
        self.report.update(outcome.blocks)
