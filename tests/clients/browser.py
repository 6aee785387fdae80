"""Opens guides in a real browser, and says what a maker sees there."""

from __future__ import annotations

import contextlib
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from playwright.sync_api import Browser, CDPSession, Page, Playwright

PHONE = {"viewport": {"width": 360, "height": 740}, "has_touch": True, "is_mobile": True}

# What is shown of the page: `shown` are the cards that take up room, `now` those marked as the present one.
STATE = """() => {
  const cards = [...document.querySelectorAll('.card')];
  const progress = document.querySelector('#progress');
  return {
    cards: cards.map((card) => card.id),
    now: cards.filter((card) => card.getAttribute('aria-current') === 'step').map((card) => card.id),
    marked: document.querySelectorAll('[aria-current]').length,
    shown: cards.filter((card) => card.checkVisibility() && card.getBoundingClientRect().height > 0)
      .map((card) => card.id),
    where: document.querySelector('#where').textContent,
    progress: [progress.value, progress.max],
    dead: [...document.querySelectorAll('button')].filter((each) => each.disabled).map((each) => each.id),
    focus: document.activeElement.id,
    top: Math.round(scrollY),
    hash: location.hash.slice(1),
  };
}"""

# For each card (or for all at once) what reaches over the window's sides, or over the picture that it is in.
OVERHANG = """() => {
  const found = [];
  const measure = (where) => {
    const wide = document.documentElement.scrollWidth - innerWidth;
    if (wide > 0) found.push(`${where}: the page is ${wide} px too wide`);
    for (const each of document.querySelectorAll('body *:not(svg *)')) {
      if (!each.checkVisibility()) continue;
      const box = each.getBoundingClientRect();
      if (box.right > innerWidth + 0.5 || box.left < -0.5)
        found.push(`${where}: <${each.localName}> from ${box.left} to ${box.right} px`);
    }
    for (const each of document.querySelectorAll('.picture text')) {
      if (!each.checkVisibility()) continue;
      const [box, frame] = [each.getBoundingClientRect(), each.ownerSVGElement.getBoundingClientRect()];
      if (box.left < frame.left - 0.5 || box.right > frame.right + 0.5
        || box.top < frame.top - 0.5 || box.bottom > frame.bottom + 0.5)
        found.push(`${where}: “${each.textContent}” is cut off by its picture's frame`);
    }
  };
  EACH
  return found;
}"""

# Heights of the letters in pictures as they come out on the screen, with what they say and where.
LETTERS = """() => {
  const found = [];
  const measure = (where) => {
    for (const each of document.querySelectorAll('svg text')) {
      if (!each.checkVisibility()) continue;
      const size = parseFloat(getComputedStyle(each).fontSize) * Math.abs(each.getScreenCTM().d);
      found.push([size, `${where}: “${each.textContent}”`]);
    }
  };
  EACH
  return found;
}"""

ONCE = "measure('all');"
# Leafs through from the first card on.
EACH_CARD = """
  const next = document.querySelector('#next');
  for (let turns = 0; ; turns += 1) {
    measure(document.querySelector('.card[aria-current]').id);
    if (next.disabled || turns > 1000) break;
    next.click();
  }
"""


@dataclass(frozen=True)
class Guide:
    """A page as it stands in its file, read without a browser."""

    path: Path
    language: str
    cards: tuple[str, ...]

    @property
    def steps(self) -> tuple[str, ...]:
        return tuple(card for card in self.cards if card.startswith("step-"))

    @classmethod
    def read(cls, path: Path) -> Guide:
        """Raises AssertionError where the steps aren't numbered in their order."""
        text = path.read_text(encoding="utf-8")
        tags = re.findall(r"<(?:section|li)\b[^>]*>", text)
        cards = [tag for tag in tags if re.search(r'class="card[ "]', tag)]
        language = text.split('<html lang="')[1][:2]
        guide = cls(path, language, tuple(re.findall(r' id="([^"]+)"', " ".join(cards))))
        assert len(guide.cards) == len(cards)
        assert guide.cards[0] == "cover"
        assert guide.steps == tuple(f"step-{number}" for number in range(1, len(guide.steps) + 1))
        assert guide.cards[-len(guide.steps) :] == guide.steps
        return guide


def started(playwright: Playwright, program: str) -> Browser:
    return playwright.chromium.launch(executable_path=program, args=["--no-sandbox", "--disable-gpu"])


@contextlib.contextmanager
def opened(browser: Browser, path: Path, hash_: str = "", **context: Any) -> Iterator[Page]:
    """The page in a window of its own; at the end it must have fetched nothing and said nothing."""
    window = browser.new_context(**context)
    page = window.new_page()
    said: list[str] = []
    fetched: set[str] = set()
    page.on("console", lambda message: said.append(message.text))
    page.on("pageerror", lambda error: said.append(str(error)))
    page.on("request", lambda request: fetched.add(request.url.split("#")[0]))
    try:
        page.goto(path.as_uri() + hash_)
        yield page
        assert said == []
        assert fetched == {path.as_uri()}
    finally:
        window.close()


def state(page: Page) -> dict[str, Any]:
    return page.evaluate(STATE)


def overhang(page: Page, paged: bool) -> list[str]:
    """What can be seen only by moving sideways, or not at all."""
    return page.evaluate(OVERHANG.replace("EACH", EACH_CARD if paged else ONCE))


def letters_px(page: Page, paged: bool) -> list[tuple[float, str]]:
    return page.evaluate(LETTERS.replace("EACH", EACH_CARD if paged else ONCE))


class Fingers:
    """Fingers on the screen of a phone."""

    def __init__(self, page: Page) -> None:
        self.wire: CDPSession = page.context.new_cdp_session(page)

    def swipe(self, *paths: tuple[tuple[float, float], tuple[float, float]]) -> None:
        """Each finger goes from its first place to its second, all at the same time."""
        moves = 3
        for part in range(moves + 1):
            share = part / moves
            places = [
                {
                    "x": start[0] + share * (end[0] - start[0]),
                    "y": start[1] + share * (end[1] - start[1]),
                    "id": finger,
                }
                for finger, (start, end) in enumerate(paths)
            ]
            self._touch("touchMove" if part else "touchStart", places)
        self._touch("touchEnd", [])

    def _touch(self, kind: str, places: list[dict[str, float]]) -> None:
        self.wire.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": places})
