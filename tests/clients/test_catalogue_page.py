"""The catalogue in a real browser: pictures, links, narrow and wide, dark, odd names, found and sorted."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterator
from pathlib import Path
from urllib.parse import unquote, urlparse

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Browser, Page, sync_playwright

from tests.batch.catalogues import ring
from tests.clients.browser import overhang, started
from wrapit.batch.index_page import index_page
from wrapit.batch.ledger import INDEX, LEDGER
from wrapit.batch.pricing import read_prices
from wrapit.batch.stage import run_batch

pytestmark = pytest.mark.client

NAMES = ["plain", "zwei drei ü", "100%25 #1", "日本"]
EVIL = "<script>document.title='evil'</script>\"'&"


@pytest.fixture(scope="module")
def browser(program: Callable[[str], str]) -> Iterator[Browser]:
    path = program("chromium")
    with sync_playwright() as playwright:
        browser = started(playwright, path)
        yield browser
        browser.close()


@pytest.fixture(scope="module")
def catalogue(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Pieces that are made, one whose drawing is missing and one whose config says nothing that is known."""
    folder = tmp_path_factory.mktemp("a catalogue #1")
    configs = [ring(folder, f"c{at}", name=re.sub("[%#]", "-", name)) for at, name in enumerate(NAMES)]
    configs[1].write_text(json.dumps({**json.loads(configs[1].read_text()), "size": "60 mm", "pair": True}))
    bad = ring(folder, "bad", drawing=f"{EVIL}.png".replace("/", ""))
    typo = ring(folder, "typo", **{EVIL: 3})
    run_batch([*configs, bad, typo], folder / "out", prices=read_prices(["copper=10 EUR"]))
    return folder / "out" / INDEX


@pytest.fixture
def page(browser: Browser, catalogue: Path) -> Iterator[Page]:
    window = browser.new_context()
    page = window.new_page()
    said: list[str] = []
    page.on("console", lambda message: said.append(message.text))
    page.on("pageerror", lambda error: said.append(str(error)))
    page.goto(catalogue.as_uri())
    yield page
    assert said == []
    window.close()


def test_every_picture_is_seen_and_every_link_leads_somewhere(page: Page, catalogue: Path) -> None:
    pictures = page.locator("img")
    assert pictures.count() == 2 * len(NAMES)
    for at in range(pictures.count()):
        pictures.nth(at).scroll_into_view_if_needed()
        page.wait_for_function("(at) => document.images[at].complete", arg=at)
        assert pictures.nth(at).evaluate("(each) => each.naturalWidth") > 0
    links = page.locator("a").evaluate_all("(all) => all.map((each) => each.href)")
    assert len(links) == 2 * len(NAMES)
    for link in links:
        target = Path(unquote(urlparse(link).path))
        assert target.is_file()
        assert target.is_relative_to(catalogue.parent)


def test_what_failed_is_told_as_it_is(page: Page) -> None:
    assert page.title() == f"Catalogue of {len(NAMES) + 2} pieces"
    failures = page.locator(".failed").all_inner_texts()
    assert len(failures) == 2
    assert all("What helps:" in failure for failure in failures)
    assert "document.title='evil'" in " ".join(failures)


def test_it_is_found_and_sorted(page: Page) -> None:
    headings = page.locator(".piece:visible h3")
    given = headings.all_inner_texts()
    page.select_option("#order", "state")
    assert headings.all_inner_texts() == [*given[-2:], *given[:-2]]
    page.select_option("#order", "cut")
    assert headings.all_inner_texts() == [given[0], *given[2:4], given[1], *given[4:]]
    page.select_option("#order", "given")
    assert headings.all_inner_texts() == given
    page.fill("#find", "DREI")
    assert headings.all_inner_texts() == [given[1]]
    assert page.locator("#told").inner_text() == f"1 of {len(given)} pieces"


@pytest.mark.parametrize("width", [360, 768, 1400])
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_it_fits_and_anybody_can_use_it(browser: Browser, catalogue: Path, width: int, scheme: str) -> None:
    window = browser.new_context(
        viewport={"width": width, "height": 740}, color_scheme=scheme, bypass_csp=True
    )  # type: ignore[arg-type]
    page = window.new_page()
    page.goto(catalogue.as_uri())
    assert overhang(page, paged=False) == []
    found = Axe().run(page)
    assert found.violations_count == 0, found.generate_report()
    window.close()


def test_without_scripts_all_is_there(browser: Browser, catalogue: Path) -> None:
    window = browser.new_context(java_script_enabled=False)
    page = window.new_page()
    page.goto(catalogue.as_uri())
    assert page.locator(".piece:visible").count() == len(NAMES) + 2
    assert not page.locator(".choose").is_visible()
    window.close()


def test_the_same_batch_is_the_same_page(catalogue: Path) -> None:
    document = json.loads((catalogue.parent / LEDGER).read_text(encoding="utf-8"))
    assert index_page(document) == catalogue.read_text(encoding="utf-8")
