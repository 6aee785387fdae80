"""The guide's page in a real browser: leafed through, narrow and wide, dark, printed, without scripts."""

from __future__ import annotations

import re
import shutil
import subprocess
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Browser, Page, sync_playwright

from tests.clients.browser import PHONE, Fingers, Guide, letters_px, opened, overhang, started, state
from tests.conftest import CONFIGS, OPENED
from wrapit.pipeline.build import Build, build

pytestmark = pytest.mark.client

GALLERY = [*OPENED, "German"]
# Looked at closely: a printed jig's, and one of flat jigs in German.
CLOSELY = ["leaf", "German"]
WIDTHS = [360, 414, 768, 1024, 1400]
# What letters in pictures have at least.
LEAST_PX = 11
READY = {"en": "Get ready", "de": "Vorbereiten"}
OF = {"en": "of", "de": "von"}

Guides = Callable[[str], Guide]


@pytest.fixture(scope="module")
def browser(program: Callable[[str], str]) -> Iterator[Browser]:
    path = program("chromium")
    with sync_playwright() as playwright:
        browser = started(playwright, path)
        yield browser
        browser.close()


@pytest.fixture(scope="module")
def german(tmp_path_factory: pytest.TempPathFactory) -> Build:
    """A guide with pages of two kinds of jig and with long words; it needs no kernel."""
    name = "Kirschblütenzweigohrringanhängerpaar"
    overrides = ["outputs=[html]", "jigs=[sheet, pegs]", "guide.language=de", f"name={name}"]
    return build(CONFIGS / "leaf.yaml", tmp_path_factory.mktemp("german") / "leaf", overrides)


@pytest.fixture
def guides(piece: Callable[[str], Build], request: pytest.FixtureRequest) -> Guides:
    def guide(name: str) -> Guide:
        build = request.getfixturevalue("german") if name == "German" else piece(name)
        assert build.folder is not None
        return Guide.read(build.folder / "guide.html")

    return guide


def expect(page: Page, guide: Guide, at: int) -> dict[str, Any]:
    """Card number `at` is the present one and the only one to be seen, and the page says so everywhere."""
    seen = state(page)
    card = guide.cards[at]
    assert seen["now"] == seen["shown"] == [card]
    assert seen["marked"] == 1
    assert seen["hash"] == card
    last = len(guide.cards) - 1
    assert seen["progress"] == [at, last]
    assert seen["dead"] == [button for button, end in (("back", 0), ("next", last)) if at == end]
    step = guide.steps.index(card) + 1 if card in guide.steps else 0
    assert seen["where"] == (
        f"{step} {OF[guide.language]} {len(guide.steps)}" if step else READY[guide.language]
    )
    return seen


def walk(page: Page, guide: Guide, on: Callable[[], None], back: Callable[[], None]) -> None:
    """From the first card to the last and back; each is shown from its top and has the focus."""
    last = len(guide.cards) - 1
    expect(page, guide, 0)
    for turn, places in ((on, range(1, last + 1)), (back, range(last - 1, -1, -1))):
        for at in places:
            turn()
            seen = expect(page, guide, at)
            assert (seen["focus"], seen["top"]) == (guide.cards[at], 0)


@pytest.mark.parametrize("name", GALLERY)
def test_a_guide_is_walked_by_keys(browser: Browser, guides: Guides, name: str) -> None:
    guide = guides(name)
    with opened(browser, guide.path) as page:
        press = page.keyboard.press
        walk(page, guide, lambda: press("ArrowRight"), lambda: press("ArrowLeft"))
        press("ArrowLeft")
        expect(page, guide, 0)
        press("End")
        expect(page, guide, len(guide.cards) - 1)
        press("ArrowRight")
        expect(page, guide, len(guide.cards) - 1)
        press("Home")
        expect(page, guide, 0)


@pytest.mark.parametrize("name", CLOSELY)
def test_a_guide_is_walked_by_buttons(browser: Browser, guides: Guides, name: str) -> None:
    guide = guides(name)
    with opened(browser, guide.path, viewport={"width": 768, "height": 1024}) as page:
        on, back = page.locator("#next"), page.locator("#back")
        walk(page, guide, on.click, back.click)


def test_buttons_are_reached_by_keys(browser: Browser, guides: Guides) -> None:
    guide = guides("German")
    with opened(browser, guide.path, "#step-2") as page:
        at = guide.cards.index("step-2")
        for key in ("Enter", "Space"):
            # From the card on, whose focus the first turn leaves there.
            page.locator("#step-2, #step-3").locator("visible=true").focus()
            for button in ("back", "next"):
                page.keyboard.press("Tab")
                assert state(page)["focus"] == button
            page.keyboard.press(key)
            at += 1
            expect(page, guide, at)


def test_a_guide_is_walked_by_touch(browser: Browser, guides: Guides) -> None:
    guide = guides("leaf")
    with opened(browser, guide.path, **PHONE) as page:
        fingers = Fingers(page)
        on, back = ((300, 400), (80, 410)), ((60, 400), (280, 390))
        walk(page, guide, lambda: fingers.swipe(on), lambda: fingers.swipe(back))
        fingers.swipe(back)
        expect(page, guide, 0)
        page.locator("#next").tap()
        expect(page, guide, 1)


def test_what_is_no_swipe_turns_no_page(browser: Browser, guides: Guides) -> None:
    guide = guides("German")
    with opened(browser, guide.path, "#step-2", **PHONE) as page:
        fingers, at = Fingers(page), guide.cards.index("step-2")
        for path in (
            ((200, 600), (200, 200)),  # up
            ((200, 200), (190, 600)),  # down
            ((300, 500), (200, 400)),  # aslant
            ((200, 400), (170, 400)),  # too short to be meant
            ((200, 400), (200, 400)),  # a touch
        ):
            fingers.swipe(path)
            expect(page, guide, at)
        # Two fingers that go the same way, that go apart, and that meet.
        for other in ((100, 600), (80, 600)), ((60, 600), (10, 600)), ((20, 600), (100, 600)):
            fingers.swipe(((300, 300), (120, 300)), other)
            expect(page, guide, at)
        # While the page is zoomed a finger moves it about, also once it has come to the page's side.
        fingers.wire.send("Emulation.setPageScaleFactor", {"pageScaleFactor": 2})
        for _ in range(3):
            fingers.swipe(((300, 400), (80, 400)))
            expect(page, guide, at)
        fingers.wire.send("Emulation.setPageScaleFactor", {"pageScaleFactor": 1})
        fingers.swipe(((300, 400), (80, 400)))
        expect(page, guide, at + 1)


def test_keys_of_the_browser_stay_its_own(browser: Browser, guides: Guides) -> None:
    guide = guides("German")
    with opened(browser, guide.path, "#step-2") as page:
        at = guide.cards.index("step-2")
        for held in ("Control", "Alt", "Meta", "Shift"):
            # With Alt the browser goes back to an earlier page, and here there is none.
            for key in ("ArrowRight", "ArrowLeft", "Home", "End"):
                page.keyboard.press(f"{held}+{key}")
                expect(page, guide, at)
        for key in ("ArrowDown", "ArrowUp", "PageDown", "a", "Enter"):
            page.keyboard.press(key)
            expect(page, guide, at)


def test_the_place_is_kept(browser: Browser, guides: Guides) -> None:
    guide = guides("German")
    with opened(browser, guide.path) as page:
        for _ in range(5):
            page.keyboard.press("ArrowRight")
        page.reload()
        expect(page, guide, 5)
    with opened(browser, guide.path, f"#{guide.cards[-1]}") as page:
        expect(page, guide, len(guide.cards) - 1)
        # A link that somebody sends may be of an older guide.
        page.evaluate("location.hash = 'step-9999'")
        page.locator("#cover:focus").wait_for()
        expect(page, guide, 0)


@pytest.mark.parametrize("name", CLOSELY)
def test_contents_lead_to_their_cards(browser: Browser, guides: Guides, name: str) -> None:
    guide = guides(name)
    pages = [card for card in guide.cards[1:] if card not in guide.steps]
    with opened(browser, guide.path) as page:
        links = page.locator(".contents a")
        targets = [(link.get_attribute("href") or "")[1:] for link in links.all()]
        assert targets[: len(pages)] == pages
        assert targets[len(pages)] == "step-1"
        for index, target in enumerate(targets):
            links.nth(index).click()
            page.locator(f"#{target}:focus").wait_for()
            expect(page, guide, guide.cards.index(target))
            page.go_back()
            page.locator("#cover:focus").wait_for()
            expect(page, guide, 0)


@pytest.mark.parametrize("name", CLOSELY)
def test_all_steps_and_back(browser: Browser, guides: Guides, name: str) -> None:
    guide = guides(name)
    with opened(browser, guide.path, "#step-3") as page:
        button = page.locator("#mode")
        all_steps = button.inner_text()
        button.click()
        seen = state(page)
        assert seen["shown"] == list(guide.cards)
        assert seen["now"] == ["step-3"]
        assert button.inner_text() not in ("", all_steps)
        # The present step is in sight, and the keys go on from there.
        for at in (3, 4):
            top, bottom = page.evaluate(
                "id => { const box = document.getElementById(id).getBoundingClientRect();"
                " return [box.top, box.bottom - innerHeight]; }",
                f"step-{at}",
            )
            assert top >= -1
            assert bottom < 0 or top <= 1
            page.keyboard.press("ArrowRight")
        assert state(page)["now"] == ["step-5"]
        button.click()
        assert button.inner_text() == all_steps
        expect(page, guide, guide.cards.index("step-5"))


def test_a_page_alone_in_an_odd_folder(browser: Browser, guides: Guides, tmp_path: Path) -> None:
    folder = tmp_path / "Süße Blätter & Ohrringe #1 100 %"
    folder.mkdir()
    guide = guides("German")
    moved = Guide.read(Path(shutil.copy(guide.path, folder / "Anleitung für Zoë.html")))
    assert moved.cards == guide.cards
    with opened(browser, moved.path, offline=True) as page:
        for at in range(len(moved.cards) - 1):
            expect(page, moved, at)
            page.keyboard.press("ArrowRight")
        page.reload()
        expect(page, moved, len(moved.cards) - 1)


@pytest.mark.parametrize("width", WIDTHS)
@pytest.mark.parametrize("name", CLOSELY)
def test_nothing_reaches_over_the_sides(browser: Browser, guides: Guides, name: str, width: int) -> None:
    guide = guides(name)
    with opened(browser, guide.path, viewport={"width": width, "height": 740}) as page:
        assert overhang(page, paged=True) == []
        assert state(page)["now"] == [guide.cards[-1]]
        page.locator("#mode").click()
        assert overhang(page, paged=False) == []


@pytest.mark.parametrize("name", GALLERY)
def test_letters_in_pictures_can_be_read(browser: Browser, guides: Guides, name: str) -> None:
    guide = guides(name)
    for width, height in ((360, 640), (1400, 800)):
        with opened(browser, guide.path, viewport={"width": width, "height": height}) as page:
            for paged in (True, False):
                if not paged:
                    page.locator("#mode").click()
                letters = letters_px(page, paged)
                assert len(letters) >= len(guide.steps) // 2
                assert [(size, where) for size, where in letters if size < LEAST_PX] == []


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("name", CLOSELY)
def test_axe_has_no_complaints(browser: Browser, guides: Guides, name: str, scheme: str) -> None:
    guide = guides(name)
    pages = [card for card in guide.cards if card not in guide.steps]
    steps = [guide.steps[0], guide.steps[len(guide.steps) // 2], guide.steps[-1]]
    with opened(browser, guide.path, color_scheme=scheme, **PHONE) as page:
        for card in [*pages, *steps]:
            page.evaluate("id => { location.hash = id; }", card)
            page.locator(f"#{card}[aria-current]").wait_for()
            assert complaints(page) == [], card
        page.locator("#mode").click()
        assert complaints(page) == []


def complaints(page: Page) -> list[tuple[str, str]]:
    found = Axe().run(page).response["violations"]
    return [(each["id"], node["html"]) for each in found for node in each["nodes"]]


@pytest.mark.parametrize("name", GALLERY)
def test_all_is_there_without_scripts(browser: Browser, guides: Guides, name: str) -> None:
    guide = guides(name)
    with opened(browser, guide.path, java_script_enabled=False) as page:
        seen = state(page)
        assert seen["shown"] == list(guide.cards)
        assert seen["now"] == []
        assert page.locator(".pager:visible, button:visible, progress:visible").count() == 0
        numbers = page.locator(".step h3 .number:visible").all_inner_texts()
        assert numbers == [str(number) for number in range(1, len(guide.steps) + 1)]
        tops = [card.bounding_box() for card in page.locator(".step").all()]
        places = [(round(box["y"]), round(box["x"])) for box in tops if box is not None]
        assert places == sorted(places)
        assert len(set(places)) == len(guide.steps)


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("name", CLOSELY)
def test_all_is_printed(
    browser: Browser, guides: Guides, program: Callable[[str], str], name: str, scheme: str
) -> None:
    guide = guides(name)
    with opened(browser, guide.path, "#step-2", color_scheme=scheme) as page:
        headings = page.locator(".step h3").all_text_contents()
        page.emulate_media(media="print")
        assert state(page)["shown"] == list(guide.cards)
        assert page.locator(".pager:visible, button:visible").count() == 0
        assert (
            page.evaluate("getComputedStyle(document.documentElement).backgroundColor")
            == "rgb(255, 255, 255)"
        )
        printed = page.pdf(format="A4")
        page.emulate_media(media="screen")
        expect(page, guide, guide.cards.index("step-2"))
    told = subprocess.run([program("pdftotext"), "-", "-"], input=printed, capture_output=True, check=True)
    text = squeezed(told.stdout.decode())
    for heading in headings:
        assert squeezed(heading) in text, heading
    assert len(headings) == len(guide.steps)


def squeezed(text: str) -> str:
    """Without spaces and line breaks, which a print sets as it likes."""
    return re.sub(r"\s+", "", text)
