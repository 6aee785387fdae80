"""One piece on the page: its config's file, what was built of it, and who wants to hear of changes."""

from __future__ import annotations

import asyncio
import dataclasses
import functools
from collections.abc import AsyncIterator, Callable
from pathlib import Path
from typing import Final

from wrapit.config import Config
from wrapit.errors import ConfigError, WrapItError
from wrapit.studio.bench import Message, told
from wrapit.studio.building import Building, signature
from wrapit.studio.controls import constraint_entries, controls, from_page, numbers_at
from wrapit.studio.fixes import Fix, fixes
from wrapit.studio.text.config_file import Judged, content_of, judged, text_of, write
from wrapit.studio.text.editing import change_from, edited
from wrapit.studio.text.history import History
from wrapit.studio.text.values import BOM, finite
from wrapit.units import printable

WATCH_S: Final = 0.25
"""Between two looks at the files: at once for a person, nothing for a disk, even over a network."""
SETTLE_S: Final = 0.05
"""Between two readings that have to agree before an editor's change is taken: some write in two steps."""
ALIVE_S: Final = 15.0
"""Between signs of life on a line of events, so that nobody between takes it for dead."""


class RefusedError(Exception):
    """A request that can't be done; `status` is HTTP's, `error` what the page shows."""

    def __init__(self, status: int, error: WrapItError) -> None:
        super().__init__(status, error)
        self.status, self.error = status, told(error)


class Session:
    """The state of the page and what changes it; all of it in the event loop's thread."""

    def __init__(self, path: Path, output: Path | None) -> None:
        self.path = path.absolute()
        self._judge = functools.lru_cache(maxsize=64)(lambda content: judged(content, self.path))
        self._now: Judged = self._judge(content_of(self.path))
        self._history = History(self._now.content, lambda content: self._judge(content).config is not None)
        self._revision = 1
        self._seen: Message = {"revision": 0}
        self._waiting: set[asyncio.Event] = set()
        self._ended = False
        self._building = Building(self.path, output and output.absolute(), self._bump)
        self._watching: asyncio.Task[None] | None = None
        self._files: tuple[object, ...] = self._signatures()

    # Begin and end

    def begin(self) -> None:
        """Watches the files and builds; within a running event loop."""
        self._watching = asyncio.get_running_loop().create_task(self._watch())
        self._rebuild()

    def leave(self) -> None:
        """Ends every line of events."""
        self._ended = True
        self._bump()

    def end(self) -> None:
        """Ends the watch and the processes; returns when they are gone."""
        self.leave()
        if self._watching is not None:
            self._watching.cancel()
        self._building.end()

    # What the page sees

    def state(self) -> Message:
        """All that the page shows."""
        if self._seen["revision"] != self._revision:
            self._seen = self._state()
        return self._seen

    def _state(self) -> Message:
        now, building = self._now, self._building
        data = finite(now.data)
        buttons = functools.cache(
            functools.partial(fixes, data=data, size_mm=building.size_mm, wires=len(building.shown["wires"]))
        )

        def offered(each: Message, where: str) -> list[Fix]:
            return buttons(each["remedy"], where, helped=each["code"] in building.helped)

        problem = told(now.problem) if now.problem is not None else building.problem
        return {
            "revision": self._revision,
            "name": now.config.name if now.config is not None else printable(self.path.stem),
            "config": printable(self.path.name),
            "text": now.text,
            "text_sha256": now.sha256,
            "problem": problem and problem | {"fixes": offered(problem, problem["where"])},
            "again": problem is not None and now.problem is None,
            "building": building.progress,
            "fresh": building.fresh,
            "can_undo": self._history.before() is not None or not now.content,
            "can_redo": self._history.after() is not None,
            "controls": controls(data),
            "constraints": constraint_entries(data),
            "keep": numbers_at(data, "keep"),
            "drop": numbers_at(data, "drop"),
            "shown": building.shown,
            "findings": [each | {"fixes": offered(each, "")} for each in building.findings],
            "alternatives": building.alternatives.found,
            "fewer_wires": building.fewer_wires.found,
        }

    async def revisions(self) -> AsyncIterator[int | None]:
        """The number of each state from now on; None where nothing happened for a while."""
        news = asyncio.Event()
        self._waiting.add(news)
        try:
            yield self._revision
            while not self._ended:
                try:
                    await asyncio.wait_for(news.wait(), ALIVE_S)
                except TimeoutError:
                    yield None
                    continue
                news.clear()
                yield self._revision
        finally:
            self._waiting.discard(news)

    @property
    def drawing(self) -> Path | None:
        """The drawing that the config names."""
        return self.path.parent / self._now.config.drawing if self._now.config is not None else None

    @property
    def folder(self) -> Path | None:
        """Where the last good build is."""
        return self._building.folder

    @property
    def files(self) -> dict[str, str]:
        """Names of the files of the last good build."""
        return dict(self._building.shown["files"])

    # What the page asks for; each raises RefusedError

    def change(self, document: object) -> int:
        """Applies a change to the text as it is now on the disk."""

        def changed(text: str) -> str:
            asked = change_from(document)
            values = {key: from_page(key, value) for key, value in asked.set.items()}
            gone = [key for key, value in values.items() if value is None]
            kept = {key: value for key, value in values.items() if value is not None}
            return edited(text, dataclasses.replace(asked, set=kept, unset=[*asked.unset, *gone]))

        return self._rewrite(changed)

    def replace(self, text: str, base: str) -> int:
        """Puts another text in place of the one with the hash `base`; line ends stay what they were."""

        def replaced(old: str) -> str:
            if self._now.sha256 != base:
                problem = "the file has been changed meanwhile"
                raise RefusedError(
                    409, ConfigError(problem, self.path.name, "look at it, and change it again")
                )
            new = text.removeprefix(BOM)
            if "\r\n" in old and "\r" not in new:  # pages know no other line ends than \n
                new = new.replace("\n", "\r\n")
            return (BOM if old.startswith(BOM) else "") + new

        return self._rewrite(replaced)

    def undo(self) -> int:
        """Restores the text before the last change."""
        return self._travel(self._history.before, self._history.go_back, "undo")

    def redo(self) -> int:
        """Makes the change again that was taken back last."""
        return self._travel(self._history.after, self._history.go_on, "redo")

    def again(self) -> int:
        """Builds anew what couldn't be built: the disk has room now, or a folder was cleared."""
        if not self._notice(content_of(self.path)):
            self._rebuild()
        return self._revision

    def find_alternatives(self, count: int) -> int:
        """Begins to look for so many of the best ways to divide the drawing."""
        self._building.find_alternatives(self._config(), count)
        return self._bump()

    def find_fewer_wires(self) -> int:
        """Begins to look for what fewer wires cost."""
        self._building.find_fewer_wires(self._config())
        return self._bump()

    def _config(self) -> Config:
        """The config as it is now on the disk."""
        self._notice(content_of(self.path))
        if self._now.config is None:
            raise RefusedError(
                422, self._now.problem or ConfigError("the config doesn't hold", self.path.name)
            )
        return self._now.config

    # Changes of the file

    def _rewrite(self, changed: Callable[[str], str]) -> int:
        """Writes what `changed` makes of the file's text, if a build would take it."""
        content = content_of(self.path)
        self._notice(content)
        try:
            old = text_of(content, self.path)
            text = changed(old)
            new = self._judge(text.encode("utf-8", "surrogatepass"))
            if new.problem is not None:
                raise new.problem
            if text != old:
                self._write(text, content)
        except WrapItError as error:
            raise RefusedError(422, error) from None
        self._history.add(new.content)
        self._take(new)
        return self._revision

    def _travel(self, there: Callable[[], bytes | None], go: Callable[[], None], what: str) -> int:
        content = content_of(self.path)
        if self._notice(content):
            problem = "the file has just been changed in an editor"
            raise RefusedError(409, ConfigError(problem, self.path.name, f"look at it, and {what} again"))
        if not content and what == "undo":  # the file is gone: its last step is what is to come back
            there, go = (lambda: self._history.current), (lambda: None)
        target = there()
        if target is None:
            raise RefusedError(409, ConfigError(f"there is nothing to {what}", self.path.name))
        try:
            self._write(target.decode("utf-8"), content)
        except ConfigError as error:
            raise RefusedError(422, error) from None
        go()
        self._take(self._judge(target))
        return self._revision

    def _write(self, text: str, known: bytes) -> None:
        if content_of(self.path) != known:
            problem = "the file has been changed at this very moment"
            raise ConfigError(problem, self.path.name, "look at it, and try again")
        write(self.path, text)

    def _notice(self, content: bytes) -> bool:
        """Takes what somebody else wrote as a step of the history; whether there was any."""
        if content == self._now.content:
            return False
        if content:  # a file that is gone for a moment, as some editors save, is no step
            self._history.add(content)
        self._take(self._judge(content))
        return True

    def _take(self, now: Judged) -> None:
        if now.content != self._now.content:
            self._now = now
            self._files = self._signatures()
            if content_of(self.path) != now.content:  # written once more since: the watch is to look again
                self._files = (object(), *self._files[1:])
            self._rebuild()

    async def _watch(self) -> None:
        while True:
            await asyncio.sleep(WATCH_S)
            signatures = self._signatures()
            if signatures == self._files:
                continue
            content = content_of(self.path)
            await asyncio.sleep(SETTLE_S)
            if content != content_of(self.path) or signatures != self._signatures():
                continue  # it is being written; the next look sees all of it
            drawing_too = signatures[1:] != self._files[1:]
            self._files = signatures
            # A config that is saved as it was asks for another try of what couldn't be built.
            if not self._notice(content) and (drawing_too or self._building.problem is not None):
                self._rebuild()

    def _signatures(self) -> tuple[object, ...]:
        return signature(self.path), self.drawing, self.drawing and signature(self.drawing)

    def _rebuild(self) -> None:
        self._building.begin(self._now.config)
        self._bump()

    def _bump(self) -> int:
        self._revision += 1
        for news in self._waiting:
            news.set()
        return self._revision
