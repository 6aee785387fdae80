"""The studio's page in a real browser: what is clicked there is written into the config, and seen."""

from __future__ import annotations

import re
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Browser, Page, Route, expect, sync_playwright

from tests.clients.browser import started
from tests.conftest import CONFIGS
from tests.studio.running import Studio

pytestmark = pytest.mark.client

CONFIG = (
    "# mine\nname: leaf\ndrawing: leaf.svg\nsize: 60 mm  # of the stem too\n"
    "jigs: [sheet]\noutputs: [html, svg]\n"
)
# Half a crab: shell, a line across it, claw, two legs, and a feeler that curls
# more tightly than 1 mm wire bends. The whole has its mirror image too.
HALF = (
    "M 30 16 C 46 16 50 26 50 32 C 50 44 40 48 30 48",
    "M 30 28 C 36 28 44 28 49 28",
    "M 47 24 C 54 20 54 12 50 8 L 48 12 L 46 9 C 44 14 44 18 45.6 21.9",
    "M 49.5 35 L 56 38 L 55 41 L 49 37.5",
    "M 47.5 40.5 L 53 46 L 51 48 L 45.6 43",
    "M 36 16.5 C 37 10 38 8 39.5 8 C 40.7 8 40.7 9.1 39.5 9.1",
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


@pytest.fixture(scope="module")
def cache(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("studio") / "cache"


@pytest.fixture
def studio(tmp_path: Path, cache: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Studio]:
    monkeypatch.setenv("WRAPIT_CACHE", str(cache))  # as people have one
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
    assert [each for each in said if "422" not in each and "409" not in each] == []
    # The page asks on and on: an answer that a test makes may be under way still.
    page.unroute_all(behavior="ignoreErrors")
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


def test_every_control_can_be_reached_with_the_mouse(page: Page) -> None:
    page.locator("#settings details").evaluate_all("all => all.forEach((each) => (each.open = true))")
    controls = page.locator("#settings :is(input, select, textarea, button):visible:enabled")
    assert controls.count() > 25
    for control in controls.all():
        control.click(trial=True, timeout=5_000)


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


def shape(page: Page, selector: str) -> str | None:
    return page.locator(f"#canvas {selector}").get_attribute("d")


def fits_and_is_open_to_all(page: Page) -> None:
    for width in (400, 1400):
        page.set_viewport_size({"width": width, "height": 900})
        assert page.evaluate("document.documentElement.scrollWidth") <= width, width
        found = Axe().run(page, options={"iframes": False})
        assert found.violations_count == 0, found.generate_report()


def test_a_line_is_left_out_by_a_click_and_comes_back(page: Page, studio: Studio) -> None:
    leave = page.get_by_role("button", name="Leave this line out")
    expect(page.locator("#sides")).to_be_hidden()
    expect(page.locator("#fit-for-wire")).to_be_empty()
    was, lines = shape(page, '[data-segment="1"]'), page.locator("[data-segment]").count()
    page.locator('[data-segment="1"]').focus()
    page.keyboard.press("Enter")
    expect(page.get_by_role("button", name="Keep this line")).to_have_count(0)  # nothing would take it
    leave.focus()
    page.keyboard.press("Enter")
    left_out = page.locator('#canvas [data-original="1"]')
    expect(left_out).to_have_attribute(
        "aria-pressed", "true", timeout=PATIENCE_MS
    )  # it is still the chosen one
    all_made(page)
    assert studio.config.read_text("utf-8") == CONFIG.replace("jigs:", "drop: [1]\njigs:")
    assert shape(page, ".original.out") == shape(page, '[data-original="1"]') == was
    assert page.locator("[data-segment]").count() < lines
    expect(page.locator("#wishes li")).to_contain_text("line 1, as it was read, is left out")
    expect(page.locator("#fit-for-wire tbody tr").first).to_have_text(f"Segments{lines}{lines - 1}")
    expect(page.locator("#fit-for-wire .places li")).to_have_count(1)
    fits_and_is_open_to_all(page)
    # Clicked once more, it comes back; so it does by an undo, and out of the list.
    expect(leave).to_have_attribute("aria-pressed", "true")
    leave.click()
    expect(page.locator('[data-segment="1"]')).to_have_attribute("aria-pressed", "true", timeout=PATIENCE_MS)
    expect(left_out).to_have_count(0)
    assert studio.config.read_text("utf-8") == CONFIG
    for back in ("Undo", "take away"):
        leave.click()
        expect(page.locator("#wishes li")).to_have_count(1)
        page.get_by_role("button", name=back).click()
        expect(page.locator("#wishes li")).to_have_count(0)
        assert studio.config.read_text("utf-8") == CONFIG
        expect(leave).to_have_attribute("aria-pressed", "false")
    all_made(page)


def test_a_line_goes_by_the_number_that_it_had(page: Page, studio: Studio) -> None:
    """Lines that stay are numbered anew, and one may be several of those that were read."""
    read = studio.state()["shown"]["drawing"]["segments"]
    last = len(read) - 1
    was = shape(page, f'[data-segment="{last}"]')
    studio.post("/change", {"add": {"drop": [0]}})
    expect(page.locator("[data-original]")).to_have_count(1, timeout=PATIENCE_MS)
    fit = studio.state()["shown"]["fit"]
    index = next(index for index, numbers in enumerate(fit["origins"]) if last in numbers)
    assert index != last
    page.locator(f'[data-segment="{index}"]').focus()
    page.keyboard.press("Enter")
    page.get_by_role("button", name="Leave this line out").click()
    expect(page.locator("[data-original]")).to_have_count(1 + len(fit["origins"][index]), timeout=PATIENCE_MS)
    assert shape(page, f'[data-original="{last}"]') == was
    assert studio.state()["drop"] == [0, *fit["origins"][index]]


def test_before_and_after_and_what_was_changed(page: Page, studio: Studio) -> None:
    """A line that was left out of its own accord is kept by a click on it, or on what is told of it."""
    studio.config.write_text(CONFIG.replace("jigs:", "fit: gentle  # for the hand\njigs:"), encoding="utf-8")
    expect(page.get_by_label("Fit for wire", exact=True)).to_have_value("gentle", timeout=PATIENCE_MS)
    all_made(page)
    change = {"what": "dropped", "length_mm": 12.0, "reason": "too near", "line": 0}

    def answer(route: Route) -> None:
        state = route.fetch().json()
        fit, first = state["shown"]["fit"], state["shown"]["fit"]["original"]["segments"][0]
        at = first["beziers"][0][0]
        fit |= {
            "left_out": [0],
            "changes": [change | {"at": at}, change | {"what": "faired", "line": None, "at": at}],
        }
        fit["origins"] = [[each for each in numbers if each != 0] for numbers in fit["origins"]]
        fit["beads"] = [{"at": at, "diameter_mm": 4.0}]
        route.fulfill(json=state)

    page.route("**/state", answer)
    page.reload()
    all_made(page)
    wires, reads = page.locator("#canvas .wire"), page.locator("#canvas .original")
    lines = studio.state()["shown"]["fit"]["original"]["segments"]
    expect(reads).to_have_count(len(lines))
    expect(page.locator("#canvas .bead")).to_have_count(1)
    # Grey lies beneath: what comes later is painted over it.
    beneath = "last => last.compareDocumentPosition(document.querySelector('#canvas .wire')) & 4"
    assert reads.last.evaluate(beneath)
    page.get_by_role("radio", name="both").focus()
    for side, shown, read in (("before", False, True), ("after", True, False), ("both", True, True)):
        page.keyboard.press("ArrowRight")
        expect(page.get_by_role("radio", name=side)).to_be_checked()
        assert (wires.count() > 0, reads.count() > 0) == (shown, read)
        expect(page.locator("[data-original]")).to_have_count(
            len(lines) * (side == "before") + (side == "both")
        )
    fits_and_is_open_to_all(page)
    page.get_by_role("radio", name="after").check()
    page.locator('[data-change="1"]').click()
    expect(page.locator("#canvas circle.change")).to_have_count(1)
    page.locator('[data-change="0"]').click()
    expect(page.get_by_role("radio", name="both")).to_be_checked()
    expect(page.locator('[data-original="0"]')).to_be_focused()
    expect(page.locator("#fit-for-wire li.shown")).to_contain_text("too near")
    keep = page.get_by_role("button", name="Keep this line")
    keep.click()
    expect(keep).to_have_attribute("aria-pressed", "true")
    said = studio.config.read_text("utf-8")
    assert said == CONFIG.replace("jigs:", "fit: gentle  # for the hand\nkeep: [0]\njigs:")
    page.get_by_role("button", name="Leave this line out").click()
    expect(page.locator("#wishes li")).to_contain_text("is left out")
    assert studio.config.read_text("utf-8") == said.replace("keep", "drop")
    page.get_by_role("button", name="Undo").click()
    expect(keep).to_have_attribute("aria-pressed", "true")
    keep.click()
    expect(page.locator("#wishes li")).to_have_count(0)
    assert studio.config.read_text("utf-8") == CONFIG.replace("jigs:", "fit: gentle  # for the hand\njigs:")


def crab() -> str:
    half = "".join(f'<path d="{data}"/>' for data in HALF)
    whole = f'<g fill="none" stroke="black">{half}<g transform="matrix(-1 0 0 1 60 0)">{half}</g></g>'
    return f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 60 60">{whole}</svg>'


def test_a_crab_is_made_fit_by_a_button_and_keeps_its_leg(page: Page, studio: Studio, tmp_path: Path) -> None:
    (tmp_path / "crab.svg").write_text(crab(), encoding="utf-8")
    start = CONFIG.replace("leaf", "crab").replace("60 mm", "50 mm")
    studio.config.write_text(start, encoding="utf-8")
    expect(page.get_by_label("Size", exact=True)).to_have_value("50 mm", timeout=PATIENCE_MS)
    gentle = page.get_by_role("button", name="Make it fit: gentle").first
    expect(gentle).to_be_visible(timeout=PATIENCE_MS)
    all_made(page)
    before, read_first = drawn(page), studio.state()["shown"]["drawing"]
    expect(page.locator("#sides")).to_be_hidden()
    gentle.click()
    expect(page.get_by_label("Fit for wire", exact=True)).to_have_value("gentle", timeout=PATIENCE_MS)
    all_made(page)
    made = studio.config.read_text("utf-8")
    assert made == start.replace("jigs:", "fit: gentle\njigs:")
    fit = studio.state()["shown"]["fit"]
    assert fit["before"]["tight_bends"] > fit["after"]["tight_bends"] == 0
    expect(page.get_by_role("button", name="Make it fit: gentle")).to_have_count(0)
    assert drawn(page) != before
    read, wires = fit["original"]["segments"], studio.state()["shown"]["wires"]
    for side, selector, lines in (("before", ".original", read), ("after", ".wire", wires)):
        page.get_by_role("radio", name=side).check()
        expect(page.locator(f"#canvas {selector}")).to_have_count(len(lines))
    page.get_by_role("radio", name="both").check()
    leg = fit["left_out"][0]
    page.locator(f'[data-original="{leg}"]').focus()
    page.keyboard.press("Enter")
    keep = page.get_by_role("button", name="Keep this line")
    keep.click()
    expect(page.locator("#wishes li")).to_contain_text(f"line {leg}, as it was read, is kept")
    all_made(page)
    assert studio.config.read_text("utf-8") == made.replace("jigs:", f"keep: [{leg}]\njigs:")
    assert leg not in studio.state()["shown"]["fit"]["left_out"]
    expect(page.locator(f'[data-original="{leg}"]')).to_have_count(0)
    for text in (made, start):
        page.get_by_role("button", name="Undo").click()
        expect(page.locator("#wishes li")).to_have_count(0)
        all_made(page)
        assert studio.config.read_text("utf-8") == text
    expect(page.locator("#sides")).to_be_hidden(timeout=PATIENCE_MS)
    assert studio.state()["shown"]["drawing"] == read_first


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


def test_fewer_wires_are_taken_by_keyboard(page: Page, studio: Studio) -> None:
    lines = CONFIG + "decomposition:  # ours\n  seed: 2  # lucky\n"
    studio.config.write_text(lines, encoding="utf-8")
    page.get_by_text("How it is divided").click()
    slider = page.get_by_label("Fewest wires", exact=True)
    expect(slider).to_be_disabled()
    look = page.get_by_role("button", name="Show what fewer wires cost")
    look.focus()
    page.keyboard.press("Enter")
    rows = page.locator(".costs tbody tr")
    expect(rows).to_have_count(3, timeout=PATIENCE_MS)
    expect(look).to_be_hidden()
    expect(slider).to_be_focused()
    costs = studio.state()["fewer_wires"]
    assert [each["max_wires"] for each in costs] == [None, 2, 1]
    expect(slider).to_have_attribute("aria-valuetext", re.compile("^3 wires, 0 mm run twice, bends "))
    page.keyboard.press("Home")
    expect(slider).to_have_attribute(
        "aria-valuetext", re.compile(f"^1 wire, {costs[2]['doubled_mm']:.0f} mm")
    )
    expect(page.locator("#numbers h2")).to_have_text("1 wire", timeout=PATIENCE_MS)
    assert studio.config.read_text("utf-8") == lines + "  max_wires: 1\n"
    expect(slider).to_have_value("0")
    expect(rows.locator("nth=0")).to_have_attribute("aria-current", "true")
    page.keyboard.press("ArrowRight")
    expect(page.locator("#numbers h2")).to_have_text("2 wires", timeout=PATIENCE_MS)
    assert studio.config.read_text("utf-8") == lines + "  max_wires: 2\n"
    for width in WIDTHS:
        page.set_viewport_size({"width": width, "height": 900})
        assert page.evaluate("document.documentElement.scrollWidth") <= width, width
    for scheme in ("light", "dark"):
        page.emulate_media(color_scheme=scheme)
        found = Axe().run(page, options={"iframes": False})
        assert found.violations_count == 0, (scheme, found.generate_report())
    page.get_by_role("button", name="Undo").click()
    expect(slider).to_have_value("0")
    page.get_by_role("button", name="Undo").click()
    expect(slider).to_have_value("2")
    assert studio.config.read_text("utf-8") == lines


def test_a_text_under_way_is_kept_until_one_is_chosen(page: Page, studio: Studio) -> None:
    crlf = CONFIG.replace("\n", "\r\n")
    studio.config.write_bytes(crlf.encode())
    page.get_by_role("tab", name="Text").click()
    area, other = page.locator("#yaml"), page.locator("#yaml-other")
    for size in ("61", "62"):  # what nobody touched follows the file
        studio.config.write_bytes(crlf.replace("60 mm", f"{size} mm").encode())
        expect(area).to_have_value(CONFIG.replace("60 mm", f"{size} mm"), timeout=PATIENCE_MS)
    mine = CONFIG.replace("60 mm", "70 mm")
    area.fill(mine)
    expect(other).to_be_hidden()
    studio.config.write_bytes(crlf.replace("60 mm", "63 mm").encode())
    expect(other).to_be_visible(timeout=PATIENCE_MS)
    expect(area).to_have_value(mine)
    page.locator("#save-text").click()
    expect(page.locator("#yaml-wrong")).to_contain_text("changed meanwhile")
    assert b"63 mm" in studio.config.read_bytes()
    page.locator("#overwrite-text").click()
    expect(other).to_be_hidden()
    expect(page.get_by_label("Size", exact=True)).to_have_value("70 mm")
    assert studio.config.read_bytes() == mine.replace("\n", "\r\n").encode()
    area.fill(mine.replace("70", "71"))
    page.locator("#drop-text").click()
    expect(area).to_have_value(mine)


def test_the_keyboard_goes_through_the_picture(page: Page) -> None:
    stops = page.locator('#canvas [tabindex="0"]')
    expect(stops).to_have_count(1)
    page.locator('[data-segment="0"]').focus()
    focus = "JSON.stringify({...document.activeElement.dataset})"
    lines = page.locator("[data-segment]").count()
    page.keyboard.press("ArrowRight")
    assert page.evaluate(focus) == '{"segment":"1"}'
    page.keyboard.press("Enter")  # the picture is drawn anew, and the keyboard stays where it was
    assert page.evaluate(focus) == '{"segment":"1"}'
    expect(page.locator('[data-segment="1"]')).to_have_attribute("aria-pressed", "true")
    page.keyboard.press("End")
    assert page.evaluate(focus) == f'{{"segment":"{lines - 1}"}}'
    page.keyboard.press("ArrowRight")
    assert page.evaluate(focus) == '{"segment":"0"}'
    page.keyboard.press("ArrowDown")
    assert "junction" in page.evaluate(focus)
    expect(stops).to_have_count(1)
    page.keyboard.press("Tab")
    assert not page.evaluate("document.querySelector('#canvas').contains(document.activeElement)")
    page.keyboard.press("Shift+Tab")
    assert "junction" in page.evaluate(focus)


SEEN = """(seen) => {
  Object.defineProperty(document, "hidden", { value: !seen, configurable: true });
  document.dispatchEvent(new Event("visibilitychange"));
}"""


def test_a_tab_that_nobody_sees_holds_no_line(page: Page, studio: Studio) -> None:
    """Browsers open six lines to a server for all tabs together: a seventh tab would show nothing."""
    others = [page.context.new_page() for _ in range(7)]
    for each in others:
        each.goto(studio.origin)
        all_made(each)
        each.evaluate(SEEN, False)
    page.get_by_label("Size", exact=True).fill("80 mm")
    page.get_by_label("Size", exact=True).press("Enter")
    all_made(page)
    expect(others[0].get_by_label("Size", exact=True)).to_have_value("60 mm")
    others[0].evaluate(SEEN, True)
    expect(others[0].get_by_label("Size", exact=True)).to_have_value("80 mm")
    for each in others:
        each.close()


def test_a_state_of_any_kind_is_shown(page: Page) -> None:
    """What can't be built, and a search for alternatives that failed, are said."""
    error = {"code": "stopped", "problem": "it ended", "where": "", "remedy": "try again", "fixes": []}
    changed = {"alternatives": {"error": error}, "problem": error, "again": True}
    changed["building"] = {"stage": "starting", "done": [], "stages": []}

    def answer(route: Route) -> None:
        state = route.fetch().json()
        state["revision"] += 1000
        route.fulfill(json=state | changed)

    page.route("**/state", answer)
    page.reload()
    expect(page.locator("#problem")).to_contain_text("it ended")
    page.get_by_role("tab", name="Ways").click()
    expect(page.locator("#view-ways")).to_contain_text("it ended")
    with page.expect_request("**/again"):
        page.get_by_role("button", name="Try again").click()
