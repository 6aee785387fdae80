"""What is built of a config, as the page sees it: what was shown last stays until there is newer."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from pathlib import Path
from typing import Any, Final

from wrapit.config import Config
from wrapit.pipeline.reads import Keys
from wrapit.studio.bench import Bench, Message
from wrapit.studio.looking import Looking

GATHER_S: Final = 0.1
"""Changes so near to each other are built together, as while a slider is drawn."""


class Building:
    """Orders builds, alternatives and what fewer wires cost, and keeps what they tell; `changed` is called
    after each of it.

    `helped` are codes of findings against which it helps to make the drawing fit.
    """

    def __init__(self, path: Path, output: Path | None, changed: Callable[[], object]) -> None:
        self._path, self._output, self._changed = path, output, changed
        self.problem: Message | None = None
        self.progress: Message | None = None
        self.fresh = False
        self.shown: Message = {"drawing": None, "fit": None, "wires": [], "energy": None, "optimal": None}
        self.shown |= {"report": None, "files": {}, "stage": None, "timings_s": {}}
        self.findings: list[Message] = []
        self.helped: list[str] = []
        self.folder: Path | None = None
        self._builder = Bench(self._hear)
        self.alternatives = Looking("find_alternatives", changed)
        self.fewer_wires = Looking("find_fewer_wires", changed)
        self._soon: asyncio.TimerHandle | None = None

    @property
    def size_mm(self) -> float | None:
        """Longest side of the piece as it was last built."""
        size = ((self.shown["report"] or {}).get("drawing") or {}).get("size_mm")
        return max(size) if size else None

    def begin(self, config: Config | None) -> None:
        """Builds anew, and stops what is under way; nothing is built where there is no config that holds."""
        self.fresh, self.problem, self.progress, self.helped = False, None, None, []
        if self._soon is not None:
            self._soon.cancel()
        if self._builder.is_busy:
            self._builder.stop()
        self.alternatives.forget_unless(self._foundation(config, "alternatives"))
        self.fewer_wires.forget_unless(self._foundation(config, "fewer wires"))
        if config is not None:
            self.progress = {"stage": "starting", "done": [], "stages": []}
            self._builder.warm_up()
            self._soon = asyncio.get_running_loop().call_later(GATHER_S, self._order)

    def find_alternatives(self, config: Config, count: int) -> None:
        """Begins to look for so many of the best ways to divide the drawing."""
        self.alternatives.begin(self._foundation(config, "alternatives"), self._path, count)

    def find_fewer_wires(self, config: Config) -> None:
        """Begins to look for what fewer wires cost."""
        self.fewer_wires.begin(self._foundation(config, "fewer wires"), self._path)

    def end(self) -> None:
        """Ends the processes; returns when they are gone."""
        if self._soon is not None:
            self._soon.cancel()
        self._builder.end()
        self.alternatives.end()
        self.fewer_wires.end()

    def _order(self) -> None:
        self._builder.order("build_piece", self._path, self._output)

    def _hear(self, message: Message) -> None:
        if "ended" in message:
            self.progress, self.problem = None, message["ended"]
            self.fresh = self.problem is None
        if self.progress is not None and "building" in message:
            self.progress = self.progress | {"stage": message["building"], "stages": message["stages"]}
        if self.progress is not None and "done" in message:
            self.progress = self.progress | {"done": [*self.progress["done"], message["done"]]}
        self.shown = self.shown | message.get("shown", {})
        self.findings = message.get("findings", self.findings)
        self.helped = message.get("helped", self.helped)
        if "folder" in message:
            self.folder = Path(message["folder"])
        self._changed()

    def _foundation(self, config: Config | None, step: str) -> str:
        """What a step that is looked for depends upon, as a hash."""
        if config is None:
            return ""
        # Choosing one of them changes none of them.
        chosen: dict[str, Any] = {"choice": 1}
        if step == "fewer wires":
            chosen |= {"max_wires": None, "doubling": False}
        best = config.decomposition.model_copy(update=chosen)
        drawing = self._path.parent / config.drawing
        keys = Keys(
            config.model_copy(update={"decomposition": best}), str(signature(drawing)), drawing.suffix
        )
        return keys.of(step)


def signature(path: Path) -> tuple[int, ...] | None:
    """What changes when a file is written, also by a file of the same size in its place."""
    try:
        status = path.stat()
    except OSError:
        return None
    return status.st_mtime_ns, status.st_ctime_ns, status.st_size, status.st_ino
