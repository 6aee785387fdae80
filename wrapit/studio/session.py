"""One piece on the page: its config's file, what was built of it, and who wants to hear of changes."""

from __future__ import annotations

import asyncio
import functools
import hashlib
import json
from collections.abc import AsyncIterator, Callable
from pathlib import Path
from typing import Any, Final

from wrapit.errors import ConfigError, WrapItError
from wrapit.studio.bench import Bench, Message, told
from wrapit.studio.config_file import Judged, content_of, judged, text_of, write
from wrapit.studio.controls import constraint_entries, controls, from_page
from wrapit.studio.editing import Change, change_from, edited
from wrapit.studio.fixes import fixes
from wrapit.studio.history import History
from wrapit.studio.values import BOM

WATCH_S: Final = 0.25
"""Between two looks at the files: at once for a person, nothing for a disk, even over a network."""
SETTLE_S: Final = 0.05
"""Between two readings that have to agree before an editor's change is taken: some write in two steps."""
GATHER_S: Final = 0.1
"""Changes so near to each other are built together, as while a slider is drawn."""
ALIVE_S: Final = 15.0
"""Between signs of life on a line of events, so that nobody between takes it for dead."""
MOST_ALTERNATIVES: Final = 12
"""As many as `wrapit build --alternatives` takes."""


class Refused(Exception):
    """A request that can't be done; `status` is HTTP's, `error` what the page shows."""

    def __init__(self, status: int, error: WrapItError) -> None:
        super().__init__(status, error)
        self.status, self.error = status, told(error)


class Session:
    """The state of the page and what changes it; all of it in the event loop's thread."""

    def __init__(self, path: Path, output: Path | None) -> None:
        self.path = path.absolute()
        self._output = output.absolute() if output is not None else None
        self._judge = functools.lru_cache(maxsize=64)(lambda content: judged(content, self.path))
        self._now: Judged = self._judge(content_of(self.path))
        self._history = History(self._now.content, lambda content: self._judge(content).config is not None)
        self._revision = 1
        self._waiting: set[asyncio.Event] = set()
        self._ended = False
        self._problem: Message | None = None
        self._building: Message | None = None
        self._fresh = False
        self._shown: Message = {"drawing": None, "wires": [], "energy": None, "optimal": None}
        self._shown |= {"report": None, "files": {}, "stage": None, "timings_s": {}}
        self._findings: list[Message] = []
        self._alternatives: Any = None
        self._alternatives_of = ""
        self.folder: Path | None = None
        self._builder = Bench(self._hear)
        self._chooser = Bench(self._hear_alternatives)
        self._soon: asyncio.TimerHandle | None = None
        self._watching: asyncio.Task[None] | None = None

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
        if self._soon is not None:
            self._soon.cancel()
        self._builder.end()
        self._chooser.end()

    # What the page sees

    def state(self) -> Message:
        """All that the page shows."""
        now, data = self._now, self._now.data
        size = ((self._shown["report"] or {}).get("drawing") or {}).get("size_mm")
        buttons = functools.partial(fixes, data=data, size_mm=max(size) if size else None)
        problem = told(now.problem) if now.problem is not None else self._problem
        return {
            "revision": self._revision,
            "name": now.config.name if now.config is not None else self.path.stem,
            "config": self.path.name,
            "text": now.text,
            "text_sha256": now.sha256,
            "problem": problem and problem | {"fixes": buttons(problem["remedy"], problem["where"])},
            "building": self._building,
            "fresh": self._fresh,
            "can_undo": self._history.before() is not None,
            "can_redo": self._history.after() is not None,
            "controls": controls(data),
            "constraints": constraint_entries(data),
            "shown": self._shown,
            "findings": [each | {"fixes": buttons(each["remedy"], each["where"])} for each in self._findings],
            "alternatives": self._alternatives,
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
    def files(self) -> dict[str, str]:
        """Names of the files of the last good build."""
        return dict(self._shown["files"])

    # What the page asks for; each raises Refused

    def change(self, document: object) -> int:
        """Applies a change to the text as it is now on the disk."""

        def changed(text: str) -> str:
            asked = change_from(document)
            values = {key: from_page(key, value) for key, value in asked.set.items()}
            gone = [key for key, value in values.items() if value is None]
            kept = {key: value for key, value in values.items() if value is not None}
            return edited(text, Change(kept, [*asked.unset, *gone], asked.constrain, asked.release))

        return self._rewrite(changed)

    def replace(self, text: str, base: str) -> int:
        """Puts another text in place of the one with the hash `base`; line ends stay what they were."""

        def replaced(old: str) -> str:
            if self._now.sha256 != base:
                problem = "the file has been changed meanwhile"
                raise Refused(409, ConfigError(problem, self.path.name, "look at it, and change it again"))
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

    def find_alternatives(self, count: int) -> int:
        """Begins to look for so many of the best ways to divide the drawing."""
        if not 1 <= count <= MOST_ALTERNATIVES:
            remedy = f"choose between 1 and {MOST_ALTERNATIVES}"
            raise Refused(422, ConfigError(f"{count} alternatives can't be shown", "count", remedy))
        self._notice(content_of(self.path))
        if self._now.problem is not None:
            raise Refused(422, self._now.problem)
        self._alternatives = {"building": True}
        self._alternatives_of = self._foundation()
        self._chooser.order("find_alternatives", self.path, count)
        return self._bump()

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
            raise Refused(422, error) from None
        self._history.add(new.content)
        self._take(new)
        return self._revision

    def _travel(self, there: Callable[[], bytes | None], go: Callable[[], None], what: str) -> int:
        content = content_of(self.path)
        if self._notice(content):
            problem = "the file has just been changed in an editor"
            raise Refused(409, ConfigError(problem, self.path.name, f"look at it, and {what} again"))
        target = there()
        if target is None:
            raise Refused(409, ConfigError(f"there is nothing to {what}", self.path.name))
        try:
            self._write(target.decode("utf-8"), content)
        except ConfigError as error:
            raise Refused(422, error) from None
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
            self._rebuild()

    async def _watch(self) -> None:
        seen = self._signatures()
        while True:
            await asyncio.sleep(WATCH_S)
            signatures = self._signatures()
            if signatures == seen:
                continue
            content = content_of(self.path)
            await asyncio.sleep(SETTLE_S)
            if content != content_of(self.path) or signatures != self._signatures():
                continue  # it is being written; the next look sees all of it
            config_only = signatures[1:] == seen[1:]
            seen = signatures
            if not self._notice(content) and not config_only:
                self._rebuild()

    def _signatures(self) -> tuple[object, ...]:
        return _signature(self.path), self.drawing, self.drawing and _signature(self.drawing)

    # Building

    def _rebuild(self) -> None:
        self._fresh, self._problem, self._building = False, None, None
        if self._soon is not None:
            self._soon.cancel()
        if self._builder.is_busy:
            self._builder.stop()
        if self._alternatives is not None and self._alternatives_of != self._foundation():
            self._alternatives = None
            self._chooser.stop()
        if self._now.problem is None:
            self._building = {"stage": "starting", "done": [], "stages": []}
            self._builder.warm_up()
            self._soon = asyncio.get_running_loop().call_later(GATHER_S, self._build)
        self._bump()

    def _build(self) -> None:
        self._builder.order("build_piece", self.path, self._output)

    def _hear(self, message: Message) -> None:
        if "ended" in message:
            self._building, self._problem = None, message["ended"]
            self._fresh = self._problem is None
        building = self._building
        if building is not None and "building" in message:
            self._building = building | {"stage": message["building"], "stages": message["stages"]}
        if building is not None and "done" in message:
            self._building = building | {"done": [*building["done"], message["done"]]}
        self._shown = self._shown | message.get("shown", {})
        self._findings = message.get("findings", self._findings)
        if "folder" in message:
            self.folder = Path(message["folder"])
        self._bump()

    def _hear_alternatives(self, message: Message) -> None:
        if message.get("ended") is not None:
            self._alternatives = {"error": message["ended"]}
        self._alternatives = message.get("alternatives", self._alternatives)
        self._bump()

    def _foundation(self) -> str:
        """What alternatives depend upon, as a hash."""
        config, drawing = self._now.config, self.drawing
        if config is None or drawing is None:
            return ""
        parts = config.model_dump(
            mode="json", include={"drawing", "size", "tracing", "decomposition", "wire"}
        )
        parts["decomposition"].pop("choice", None)  # choosing one of them changes none of them
        text = json.dumps([parts, _signature(drawing)], sort_keys=True)
        return hashlib.sha256(text.encode()).hexdigest()

    def _bump(self) -> int:
        self._revision += 1
        for news in self._waiting:
            news.set()
        return self._revision


def _signature(path: Path) -> tuple[int, ...] | None:
    """What changes when a file is written, also by a file of the same size in its place."""
    try:
        status = path.stat()
    except OSError:
        return None
    return status.st_mtime_ns, status.st_ctime_ns, status.st_size, status.st_ino
