"""The guide is complete, self-contained, safe, and says what a maker has to do in an order that works."""

from __future__ import annotations

import functools
import math
import re
from dataclasses import replace
from html.parser import HTMLParser

import pytest

from tests.exports.pieces_for_tests import drawing_of, eye, solution_of
from tests.instructions.order.walks import bench_by_hand, planned
from tests.jig.sheet.laser import laser_of
from wrapit.config import GuideConfig, JigConfig, PlateConfig, WireConfig
from wrapit.errors import Finding
from wrapit.geometry import straight
from wrapit.instructions.model import Guide
from wrapit.instructions.plan import Held, plan_guide
from wrapit.instructions.stage import write_page
from wrapit.instructions.words.speaking import UNIT, Speaker
from wrapit.jig.bench.model import Handling
from wrapit.jig.made import GuidePage
from wrapit.jig.sheet.gluing_page import gluing_page
from wrapit.jig.sheet.stage import laser_jig, plan_stack
from wrapit.pages.model import Block, Figure, Length, Mass, Points, Shape, Table, Text
from wrapit.wires.model import JumpRing, Turn, Wire

VOID = {"meta", "link", "br", "img", "input", "hr"}
SPEAKER = Speaker("en", "mm")


class Page(HTMLParser):
    """Tags with attributes, and the text outside of style and script."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags: list[tuple[str, dict[str, str | None]]] = []
        self.open: list[str] = []
        self.words: list[str] = []
        self.feed(text)
        assert not self.open, f"never closed: {self.open}"

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, dict(attrs)))
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, dict(attrs)))

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        if not {"style", "script"} & set(self.open):
            self.words.append(data)

    @property
    def text(self) -> str:
        return " ".join(" ".join(self.words).split())

    def all(self, name: str) -> list[dict[str, str | None]]:
        return [attributes for tag, attributes in self.tags if tag == name]


def planned_guide(
    wires: tuple[Wire, ...] | None = None,
    *,
    name: str = "eye",
    held: Held | None = None,
    pages: tuple[GuidePage, ...] = (),
    ring: JumpRing | None = None,
    wire: WireConfig | None = None,
) -> Guide:
    wires = eye()[1] if wires is None else wires
    return plan_guide(
        wires, GuideConfig(), wire or WireConfig(), name=name, held=held or Held(), pages=pages, ring=ring
    )


@functools.cache
def html_of(name: str = "eye", *, jig: bool = False, language: str = "en", units: str = "mm") -> str:
    config = GuideConfig.model_validate({"language": language, "units": units})
    held = Held(planned("eye")) if jig else Held()
    guide = plan_guide(eye()[1], config, WireConfig(), name=name, held=held)
    return write_page(guide, config)


@pytest.mark.parametrize("jig", [False, True])
def test_the_page_stands_alone(jig: bool) -> None:
    html = html_of(jig=jig)
    page = Page(html)
    assert "http" not in html.replace("http-equiv", "")
    for tag, attributes in page.tags:
        assert tag not in ("link", "img", "iframe", "object")
        assert "src" not in attributes
        assert (attributes.get("href") or "#").startswith("#")
    assert "url(" not in html
    assert "@import" not in html
    (policy,) = (
        each["content"] for each in page.all("meta") if each.get("http-equiv") == "Content-Security-Policy"
    )
    assert (policy or "").startswith("default-src 'none'")


@pytest.mark.parametrize("jig", [False, True])
def test_links_lead_somewhere_and_pictures_have_words(jig: bool) -> None:
    page = Page(html_of(jig=jig))
    ids = [attributes["id"] for _, attributes in page.tags if "id" in attributes]
    assert len(ids) == len(set(ids))
    links = [*page.all("a"), *page.all("use")]
    assert {(link["href"] or "")[1:] for link in links} <= set(ids)
    pictures = [each for each in page.all("svg") if each.get("aria-hidden") != "true"]
    assert all(len(picture["aria-label"] or "") > 10 for picture in pictures)
    # The cover, and one picture for each step.
    steps = [each for each in page.all("li") if "step" in (each.get("class") or "").split()]
    assert len(pictures) == 1 + len(steps)
    assert [each["value"] for each in steps] == [str(number) for number in range(1, len(steps) + 1)]


@pytest.mark.parametrize("language", ["en", "de"])
def test_names_are_escaped(language: str) -> None:
    name = "<b>&\"'</b><script>alert(1)</script></title>{{ 7 * 7 }}{ $wire }"
    html = html_of(name, language=language)
    assert len(Page(html).all("script")) == len(Page(html_of(language=language)).all("script")) == 1
    assert not Page(html).all("b")
    assert html.count(" ".join(name.split())) == 0
    assert " ".join(name.split()) in Page(html).text


def test_names_of_jigs_stay_text() -> None:
    wires = eye()[1]
    benches = tuple(bench_by_hand((wire,), (), f"<i>jig {wire.number}</i>") for wire in wires)
    html = write_page(planned_guide(held=Held(Handling(benches))), GuideConfig())
    assert not Page(html).all("i")
    assert "Take <i>jig 2</i>." in Page(html).text


def test_same_input_same_text() -> None:
    html_of.cache_clear()
    first = html_of()
    html_of.cache_clear()
    assert html_of() == first


@pytest.mark.parametrize("jig", [False, True])
@pytest.mark.parametrize("units", ["mm", "in"])
@pytest.mark.parametrize("language", ["en", "de"])
def test_both_languages_and_units_say_the_whole_guide(language: str, units: str, jig: bool) -> None:
    text = Page(html_of(jig=jig, language=language, units=units)).text
    assert ("Wire 1 of 2" in text) == (language == "en")
    assert ("Draht 1 von 2" in text) == (language == "de")
    lengths = re.findall(rf"\d{UNIT}(mm|in)\b", text)
    assert set(lengths) <= {units}
    assert not re.search(r"\b(rad|energy|odd junction|None|nan|inf)\b", text)


def table_of(guide: Guide, key: str) -> Table:
    (found,) = (
        block
        for page in guide.pages
        for block in page.blocks
        if isinstance(block, Table) and block.caption.key == key
    )
    return found


def value(said: Text, name: str = "value") -> object:
    return dict(said.values)[name]


def test_numbers_are_those_of_the_wires() -> None:
    wires = eye()[1]
    text = Page(html_of()).text.replace(UNIT, " ")
    for wire in wires:
        cut = SPEAKER.of("length", value=Length(wire.cut_length_mm)).replace(UNIT, " ")
        assert f"Cut {cut} of wire" in text
    total = sum(wire.cut_length_mm for wire in wires)
    guide = planned_guide()
    frame, binding = table_of(guide, "materials-table").rows
    assert value(frame[2]) == Length(pytest.approx(total))  # type: ignore[arg-type]
    mass = value(frame[3])
    assert isinstance(mass, Mass)
    assert mass.g == pytest.approx(8.96e-3 * math.pi / 4 * 1.02**2 * total, rel=1e-6)
    wanted = sum(tie.binding_mm for tie in guide.ties)
    assert value(binding[2]) == Length(pytest.approx(wanted))  # type: ignore[arg-type]
    cuts = [value(row[1], "length") for row in table_of(guide, "cut-table").rows]
    assert cuts == [Length(wire.cut_length_mm) for wire in wires]


def test_a_pair_takes_twice_the_metal() -> None:
    wires = eye()[1]
    config = GuideConfig(), WireConfig()
    one = plan_guide(wires, *config, name="eye", held=Held())
    two = plan_guide(wires, *config, name="eye", held=Held(), other=Held())
    for row, twice in zip(
        table_of(one, "materials-table").rows, table_of(two, "materials-table").rows, strict=True
    ):
        length, double = value(row[2]), value(twice[2])
        assert isinstance(length, Length)
        assert isinstance(double, Length)
        assert double.mm == pytest.approx(2 * length.mm)
    assert len(two.steps) == 2 * len(one.steps)
    assert two.minutes == pytest.approx(2 * one.minutes)
    assert {value(row[1], "count") for row in table_of(two, "cut-table").rows} == {2}


def test_a_guide_needs_a_wire() -> None:
    with pytest.raises(ValueError, match="at least one wire"):
        planned_guide(())


def test_a_wire_without_ties_is_said_so() -> None:
    _, wires = solution_of(
        drawing_of([straight((0, 0), (20, 0)), straight((0, 5), (10, 5))]), [[(0, False)], [(1, False)]]
    )
    text = Page(write_page(planned_guide(wires), GuideConfig())).text
    assert "Nothing that lies there touches it yet" in text
    assert "binding" not in text


def test_the_ring_comes_last_and_is_shown_on_the_cover() -> None:
    ring = JumpRing((0.0, 0.0), (0.0, 1.0), 0.0, 4.0, 0.8, True)
    guide = planned_guide(ring=ring)
    assert guide.steps[-1].kind == "ring"
    text = Page(write_page(guide, GuideConfig())).text
    assert "Open the jump ring" in text
    assert "The open circle shows" in text
    assert "jump ring" not in Page(html_of()).text


def test_the_present_stretch_is_drawn_over_what_is_done() -> None:
    for step in planned_guide(held=Held(planned("eye"))).steps:
        assert step.figure is not None
        styles = [shape.style for shape in step.figure.picture.shapes if isinstance(shape, Shape)]
        if step.kind in ("start", "shape", "end"):
            assert styles[-3:] == ["edge", "present", "arrow"]
            assert ("earlier" in styles) == (step.start_mm > 1e-3)
            assert styles.count("wall-now") == len(step.walls)


@pytest.mark.parametrize("dark", [False, True])
def test_text_contrast_is_sufficient(dark: bool) -> None:
    css = html_of().split("<style>")[1].split("</style>")[0]
    light_theme, dark_theme = re.findall(r":root \{(.*?)\}", css, re.DOTALL)[:2]
    theme = dict(re.findall(r"--([\w-]+): (#[0-9a-f]{6})", light_theme))
    if dark:
        theme |= dict(re.findall(r"--([\w-]+): (#[0-9a-f]{6})", dark_theme))
    written = set(re.findall(r"[{;] color: var\(--([\w-]+)\)", css))
    assert {"ink", "soft", "link", "paper"} <= written
    # None is written by its number: it would be the same in the dark.
    assert not re.findall(r"[{;] *(?:color|fill): *#", css)
    for name in written - {"paper"}:
        assert min(contrast(theme[name], theme[ground]) for ground in ("paper", "card")) >= 4.5
    # Numbers of steps are paper on ink; letters in pictures lie on discs.
    assert contrast(theme["paper"], theme["ink"]) >= 4.5
    assert min(contrast(theme["ink"], theme[ground]) for ground in ("tie", "disc", "plate")) >= 4.5


def contrast(a: str, b: str) -> float:
    def luminance(colour: str) -> float:
        parts = [int(colour[index : index + 2], 16) / 255 for index in (1, 3, 5)]
        linear = [part / 12.92 if part <= 0.03928 else ((part + 0.055) / 1.055) ** 2.4 for part in parts]
        return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]

    bright, dark = sorted((luminance(a), luminance(b)), reverse=True)
    return (bright + 0.05) / (dark + 0.05)


def test_springback_is_told() -> None:
    first, second = eye()[1]

    def springs(wires: tuple[Wire, ...], held: Held, **metal: str) -> list[str]:
        guide = planned_guide(wires, held=held, wire=WireConfig.model_validate(metal))
        return [SPEAKER.say(each) for s in guide.steps for each in s.texts if each.key.startswith("spring-")]

    bent = replace(first, turns=(Turn("wire-01", 10.0, 20.0, "left", 0.1),))
    straight_wire = replace(second, turns=())
    loss = 3.395 * 300 / (117e3 * 1.02)
    (told,) = springs((bent, straight_wire), Held(), temper="hard")
    assert f"radius of 10{UNIT}mm about {round(90 * loss / 0.1)}° further" in told
    soft = replace(bent, turns=(Turn("wire-01", 10.0, 20.0, "left", 5.0),))
    (told,) = springs((soft, straight_wire), Held())
    assert f"radius of 5{UNIT}mm about 1°" in told
    assert springs((replace(bent, turns=()), straight_wire), Held()) == []
    overbent = replace(planned("eye"), overbent=True)
    (told,) = springs((bent, second), Held(overbent))
    assert "a little further than the piece shows" in told


def test_what_the_jig_leaves_to_the_hand_is_said_at_its_place() -> None:
    def of(wire: str, code: str, *places_mm: float) -> Finding:
        return Finding("warning", code, "there", "it is so", "set jig.split", wire=wire, places_mm=places_mm)

    found = (
        of("wire-02", "strays", 21.2),
        of("wire-02", "hemmed", 7.0),
        of("wire-01", "turn-without-wall", 20.0, 41.0),
        Finding("note", "split", "wire-01", "there are 2 jigs", "set jig.split"),
        Finding("note", "small-wall", "(3.0, 4.0) mm", "1 wall is left out"),
    )
    guide = planned_guide(held=Held(planned("eye"), found))
    told = [(step.wire, SPEAKER.say(each)) for step in guide.steps for each in step.cautions]
    assert [wire for wire, _ in told] == [1, 2, 2]
    assert told[0][1].startswith(f"At 20{UNIT}mm and 41{UNIT}mm: no wall fits")
    assert "thumb" in told[1][1]
    assert told[2][1].startswith(f"At 7{UNIT}mm")
    html = write_page(guide, GuideConfig())
    # What to change in the config is no help at the bench.
    assert "jig.split" not in html
    assert html.count('class="caution"') == 3


def blocks_of(page: GuidePage, kind: type[Block]) -> list[Block]:
    return [block for block in page.blocks if isinstance(block, kind)]


def test_the_laser_cut_jig_has_its_page() -> None:
    # With all turns held on their inside a wall goes round another: something lies inside a part.
    wires = eye()[1]
    laser, _ = laser_of(wires, PlateConfig(), JigConfig(support="turns"))
    shown = gluing_page(laser, {1: ("sheet-1.dxf",)}, pair=False)
    guide = planned_guide(wires, pages=(shown,))
    html = write_page(guide, GuideConfig())
    assert [page.anchor for page in guide.pages] == ["laser", "materials"]
    ids = {attributes["id"] for _, attributes in Page(html).tags if "id" in attributes}
    assert {"laser", "materials"} <= ids
    (steps,) = (block for block in shown.blocks if isinstance(block, Points) and block.numbered)
    glued: list[str] = []
    inside = 0
    for item in steps.items:
        given = dict(item.values)
        if given.get("where") == "in":
            # What lies inside another part is glued after it.
            assert given["inside"] in glued
            inside += 1
        if "parts" in given:
            glued += [str(part) for part in getattr(given["parts"], "items", [given["parts"]])]
    assert sorted(glued) == sorted(part.label for part in laser.parts if part.role in ("wall", "island"))
    assert inside > 0
    text = Page(html).text.replace(UNIT, " ")
    assert "3 mm above the plate" in text
    assert "sheet-1.dxf" in text
    assert 'id="laser"' not in html_of()


def test_the_map_of_each_stack_shows_its_own_wires() -> None:
    wires = eye()[1]
    apart = {f"jig-{wire.name}": plan_stack((wire,), JigConfig(), PlateConfig())[0] for wire in wires}
    laser, _ = laser_jig(apart, (), JigConfig(), PlateConfig())
    maps = [each for each in gluing_page(laser, {}, pair=False).blocks if isinstance(each, Figure)]
    shown = [
        [shape.colour for shape in each.picture.shapes if isinstance(shape, Shape) and shape.style == "wire"]
        for each in maps
    ]
    assert shown == [[wire.colour] for wire in wires]
