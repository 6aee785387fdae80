"""What is built of a config, as the page sees it: what was shown last stays until there is newer."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from pathlib import Path
from typing import Any, Final

from wrapit.config import Config
from wrapit.pipeline.reads import Keys
from wrapit.studio.bench import Bench, Message

GATHER_S: Final = 0.1
"""Changes so near to each other are built together, as while a slider is drawn."""


class Building:
    """Orders builds and alternatives, and keeps what they tell; `changed` is called after each of it.

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
        self.alternatives: Any = None
        self.folder: Path | None = None
        self._alternatives_of = ""
        self._builder = Bench(self._hear)
        self._chooser = Bench(self._hear_alternatives)
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
        if self.alternatives is not None and self._alternatives_of != self._foundation(config):
            self.alternatives = None
            self._chooser.stop()
        if config is not None:
            self.progress = {"stage": "starting", "done": [], "stages": []}
            self._builder.warm_up()
            self._soon = asyncio.get_running_loop().call_later(GATHER_S, self._order)

    def find_alternatives(self, config: Config, count: int) -> None:
        """Begins to look for so many of the best ways to divide the drawing."""
        self.alternatives = {"building": True}
        self._alternatives_of = self._foundation(config)
        self._chooser.order("find_alternatives", self._path, count)

    def end(self) -> None:
        """Ends the processes; returns when they are gone."""
        if self._soon is not None:
            self._soon.cancel()
        self._builder.end()
        self._chooser.end()

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

    def _hear_alternatives(self, message: Message) -> None:
        if message.get("ended") is not None:
            self.alternatives = {"error": message["ended"]}
        self.alternatives = message.get("alternatives", self.alternatives)
        self._changed()

    def _foundation(self, config: Config | None) -> str:
        """What alternatives depend upon, as a hash."""
        if config is None:
            return ""
        # Choosing one of them changes none of them.
        best = config.decomposition.model_copy(update={"choice": 1})
        drawing = self._path.parent / config.drawing
        keys = Keys(
            config.model_copy(update={"decomposition": best}), str(signature(drawing)), drawing.suffix
        )
        return keys.of("alternatives")


def signature(path: Path) -> tuple[int, ...] | None:
    """What changes when a file is written, also by a file of the same size in its place."""
    try:
        status = path.stat()
    except OSError:
        return None
    return status.st_mtime_ns, status.st_ctime_ns, status.st_size, status.st_ino
