"""The studio's page in a real browser: what is clicked there is written into the config, and seen."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Browser, Page, expect, sync_playwright

from tests.clients.browser import started
from tests.conftest import CONFIGS
from tests.studio.running import Studio

pytestmark = pytest.mark.client

CONFIG = (
    "# mine\nname: leaf\ndrawing: leaf.svg\nsize: 60 mm  # of the stem too\n"
    "jigs: [sheet]\noutputs: [html, svg]\n"
)
# A busy machine builds a second's work in many.
PATIENCE_MS = 120_000
WIDTHS = (360, 768, 1000, 1400)


@pytest.fixture(scope="module")
def browser(program: Callable[[str], str]) -> Iterator[Browser]:
    with sync_playwright() as playwright:
        browser = started(playwright, program("chromium"))
        yield browser
        browser.close()


@pytest.fixture
def studio(tmp_path: Path) -> Iterator[Studio]:
    shutil.copy2(CONFIGS / "leaf.svg", tmp_path / "leaf.svg")
    (tmp_path / "leaf.yaml").write_text(CONFIG, encoding="utf-8")
    studio = Studio(tmp_path, "leaf.yaml")
    yield studio
    studio.stop()


@pytest.fixture
def page(browser: Browser, studio: Studio) -> Iterator[Page]:
    window = browser.new_context(viewport={"width": 1400, "height": 1000})
    page = window.new_page()
    page.set_default_timeout(PATIENCE_MS)
    said: list[str] = []
    page.on("console", lambda message: said.append(message.text))
    page.on("pageerror", lambda error: said.append(str(error)))
    page.on("request", lambda request: said.append(request.url) if not of(studio, request.url) else None)
    page.goto(studio.line.removeprefix("studio: ").strip())
    all_made(page)
    yield page
    # A change that is refused is an answer too, of which browsers make a message.
    assert [each for each in said if "422" not in each] == []
    window.close()


def of(studio: Studio, url: str) -> bool:
    return url.startswith((studio.origin, "data:"))


def all_made(page: Page) -> None:
    expect(page.get_by_role("status")).to_contain_text("All made", timeout=PATIENCE_MS)


def drawn(page: Page) -> list[str]:
    lines = page.locator("#canvas .wire")
    return lines.evaluate_all("each => each.map((line) => line.getAttribute('points'))")


def test_a_new_size_is_written_and_seen(page: Page, studio: Studio) -> None:
    before = drawn(page)
    assert len(before) == 3
    page.get_by_label("Size", exact=True).fill("80 mm")
    page.get_by_label("Size", exact=True).press("Enter")
    expect(page.locator("#numbers")).to_contain_text("80 mm", timeout=PATIENCE_MS)
    all_made(page)
    assert studio.config.read_text("utf-8") == CONFIG.replace("60 mm", "80 mm")
    assert drawn(page) != before
    page.get_by_role("button", name="Undo").click()
    expect(page.get_by_label("Size", exact=True)).to_have_value("60 mm")
    assert studio.config.read_text("utf-8") == CONFIG
    all_made(page)
    assert drawn(page) == before


def test_what_makes_no_sense_is_said_where_it_was_written(page: Page, studio: Studio) -> None:
    page.get_by_label("Size", exact=True).fill("60 potatoes")
    page.get_by_label("Size", exact=True).press("Enter")
    expect(page.locator("#size-wrong")).to_contain_text("unknown unit")
    expect(page.get_by_label("Size", exact=True)).to_have_value("60 potatoes")
    assert studio.config.read_text("utf-8") == CONFIG


def test_a_wish_is_clicked_heeded_and_taken_away(page: Page, studio: Studio) -> None:
    document = studio.state()["shown"]
    carrier = {segment: wire["name"] for wire in document["wires"] for segment, _ in wire["segments"]}
    first = 0
    other = next(segment for segment in carrier if carrier[segment] != carrier[first])
    for segment in (first, other):
        page.locator(f'[data-segment="{segment}"]').focus()
        page.keyboard.press("Enter")
    page.get_by_role("button", name="Same wire").click()
    expect(page.locator("#wishes li")).to_have_count(1)
    all_made(page)
    assert f"same_wire: [{first}, {other}]" in studio.config.read_text("utf-8")
    wires = studio.state()["shown"]["wires"]
    assert any({first, other} <= {segment for segment, _ in wire["segments"]} for wire in wires)
    # The opposite wish takes the place of the first one.
    page.get_by_role("button", name="Different wires").click()
    expect(page.locator("#wishes li")).to_have_count(1)
    chosen = page.get_by_role("button", name="Different wires", exact=True)
    expect(chosen).to_have_attribute("aria-pressed", "true")
    chosen.click()
    expect(page.locator("#wishes li")).to_have_count(0)
    chosen.click()
    page.get_by_role("button", name="take away").click()
    expect(page.locator("#wishes li")).to_have_count(0)
    assert "wire: [" not in studio.config.read_text("utf-8")


def test_a_junction_and_an_end_are_asked_about(page: Page, studio: Studio) -> None:
    drawing = studio.state()["shown"]["drawing"]
    ends = [segment[key] for segment in drawing["segments"] for key in ("start", "end")]
    crossing = next(junction for junction in ends if ends.count(junction) == 3)
    page.locator(f'[data-junction="{crossing}"]').click()
    expect(page.locator("#chosen .pair")).to_have_count(3)
    page.get_by_role("button", name="All wires end here").click()
    expect(page.locator("#wishes li")).to_have_count(1)
    assert f"cut_at: {crossing}" in studio.config.read_text("utf-8")
    starting = page.get_by_role("button", name="A wire starts here")
    starting.click()
    expect(starting).to_have_attribute("aria-pressed", "true")
    expect(page.locator("#wishes li")).to_have_count(1)
    assert f"start_at: {crossing}" in studio.config.read_text("utf-8")
    all_made(page)


def test_one_of_several_ways_is_taken(page: Page, studio: Studio) -> None:
    before = drawn(page)
    page.get_by_role("tab", name="Ways").click()
    page.get_by_role("button", name="Show six ways").click()
    second = page.locator('[data-way="2"]')
    expect(second).to_have_attribute("aria-pressed", "false", timeout=PATIENCE_MS)
    second.click()
    expect(page.locator('[data-way="2"]')).to_have_attribute("aria-pressed", "true")
    all_made(page)
    assert "choice: 2" in studio.config.read_text("utf-8")
    assert drawn(page) != before


def test_an_editor_and_a_second_tab_see_the_same(page: Page, studio: Studio) -> None:
    with page.context.new_page() as other:
        other.goto(studio.origin)  # the cookie opens it
        all_made(other)
        studio.config.write_text(CONFIG.replace("60 mm", "70 mm"), encoding="utf-8")
        for each in (page, other):
            expect(each.get_by_label("Size", exact=True)).to_have_value("70 mm", timeout=PATIENCE_MS)
        other.get_by_label("Size", exact=True).fill("75 mm")
        other.get_by_label("Size", exact=True).press("Enter")
        expect(page.get_by_label("Size", exact=True)).to_have_value("75 mm")
        all_made(page)


def test_a_text_that_is_broken_leaves_the_last_good_state(page: Page, studio: Studio) -> None:
    before = drawn(page)
    studio.config.write_text("size: [", encoding="utf-8")
    expect(page.get_by_role("alert").first).to_contain_text("YAML")
    assert drawn(page) == before
    page.get_by_role("tab", name="Text").click()
    page.locator("#yaml").fill(CONFIG.replace("60", "65"))
    page.get_by_role("button", name="Save").click()
    expect(page.get_by_label("Size", exact=True)).to_have_value("65 mm")
    all_made(page)
    assert studio.config.read_text("utf-8") == CONFIG.replace("60", "65")


def test_a_remedy_is_a_button(page: Page, studio: Studio) -> None:
    page.get_by_label("Size", exact=True).fill("20 mm")
    page.get_by_label("Size", exact=True).press("Enter")
    expect(page.locator("#numbers")).to_contain_text("20 mm", timeout=PATIENCE_MS)
    all_made(page)
    larger = page.locator("#findings").get_by_role("button", name="Make it").first
    label = larger.inner_text()
    larger.click()
    size = label.removeprefix("Make it ")
    expect(page.get_by_label("Size", exact=True)).to_have_value(size)
    assert f"size: {size}  # of the stem too" in studio.config.read_text("utf-8")
    all_made(page)


def test_the_guide_is_walked_through_inside_the_page(page: Page) -> None:
    page.get_by_role("tab", name="Guide").click()
    guide = page.frame_locator("iframe")
    expect(guide.locator(".card[aria-current]")).to_have_id("cover")
    guide.locator("#next").click()
    expect(guide.locator(".card[aria-current]")).not_to_have_id("cover")


def test_every_part_fits_every_screen_and_is_open_to_all(page: Page) -> None:
    axe = Axe()
    for name in ("Wires", "Jig", "Guide", "Ways", "Text", "Files"):
        page.get_by_role("tab", name=name).click()
        for width in WIDTHS:
            page.set_viewport_size({"width": width, "height": 900})
            assert page.evaluate("document.documentElement.scrollWidth") <= width, (name, width)
        for scheme in ("light", "dark"):
            page.emulate_media(color_scheme=scheme)
            found = axe.run(page, options={"iframes": False})
            assert found.violations_count == 0, (name, scheme, found.generate_report())
