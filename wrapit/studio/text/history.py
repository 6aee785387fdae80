"""The texts that a config had, so that a change can be taken back and made again."""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

MOST_STEPS: Final = 500
"""Steps that are kept: 500 configs of some kB; nobody goes back further than an afternoon's work."""


class History:
    """Contents in order, and which of them is the file's; `holds` says which may be restored."""

    def __init__(self, content: bytes, holds: Callable[[bytes], bool]) -> None:
        self._contents, self._index, self._holds = [content], 0, holds

    @property
    def current(self) -> bytes:
        """What the file holds as far as is known."""
        return self._contents[self._index]

    def add(self, content: bytes) -> None:
        """A further step; those that were taken back are given up."""
        if content == self.current:
            return
        self._contents = [*self._contents[: self._index + 1], content][-MOST_STEPS:]
        self._index = len(self._contents) - 1

    def before(self) -> bytes | None:
        """The nearest earlier content that may be restored."""
        return self._content(self._earlier())

    def after(self) -> bytes | None:
        """The nearest content that was taken back and may be restored."""
        return self._content(self._later())

    def go_back(self) -> None:
        """The content before is now the file's."""
        self._index = self._known(self._earlier())

    def go_on(self) -> None:
        """The content after is now the file's."""
        self._index = self._known(self._later())

    def _earlier(self) -> int | None:
        return self._nearest(range(self._index - 1, -1, -1))

    def _later(self) -> int | None:
        return self._nearest(range(self._index + 1, len(self._contents)))

    def _nearest(self, indices: range) -> int | None:
        return next((index for index in indices if self._holds(self._contents[index])), None)

    def _content(self, index: int | None) -> bytes | None:
        return None if index is None else self._contents[index]

    def _known(self, index: int | None) -> int:
        if index is None:
            raise ValueError("there is no such step")
        return index
