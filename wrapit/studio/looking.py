"""What somebody asked to be looked for, in a process of its own beside the build."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from wrapit.studio.bench import Bench, Message


class Looking:
    """One order and what it found; `changed` is called when there is news.

    `found` is None where nobody asked, `{"building": True}` while it is looked for, then what was found, or
    `{"error": ...}`.
    """

    def __init__(self, order: str, changed: Callable[[], object]) -> None:
        self._order, self._changed = order, changed
        self._bench = Bench(self._hear)
        self._of = ""
        self.found: Any = None

    def begin(self, of: str, *arguments: Any) -> None:
        """Orders it; `of` is a hash of what it depends upon."""
        self.found, self._of = {"building": True}, of
        self._bench.order(self._order, *arguments)

    def forget_unless(self, of: str) -> None:
        """Drops what was found, or is looked for, of something else by now."""
        if self.found is not None and self._of != of:
            self.found = None
            self._bench.stop()

    def end(self) -> None:
        """Ends the process; returns when it is gone."""
        self._bench.end()

    def _hear(self, message: Message) -> None:
        if message.get("ended") is not None:
            self.found = {"error": message["ended"]}
        self.found = message.get("found", self.found)
        self._changed()
