"""The guide is complete, self-contained, safe, and says what a maker has to do in an order that works."""

from __future__ import annotations

import math
import re
from html.parser import HTMLParser

import numpy as np
import pytest

from tests.exports.pieces_for_tests import arc_chain, drawing_of, eye, solution_of
from tests.jig.sheet.laser import laser_of
from wrapit.config import GuideConfig, WireConfig
from wrapit.errors import Finding
from wrapit.geometry import BezierChain, straight
from wrapit.instructions.binding_order import assembly_order, binding_length_mm, find_ties
from wrapit.instructions.plan import plan_guide
from wrapit.instructions.stage import write_instructions
from wrapit.instructions.wording import joint_phrase, listed, millimetres, shape_phrase, thickness
from wrapit.jig.made import GuidePage, Handling
from wrapit.jig.sheet.gluing_page import plan_laser_page
from wrapit.units import awg_diameter_mm

VOID = {"meta", "link", "br", "img", "input", "hr"}


class Page(HTMLParser):
    """Tags with attributes, and the text outside of style."""

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
        if "style" not in self.open:
            self.words.append(data)

    @property
    def text(self) -> str:
        return " ".join(" ".join(self.words).split())


def guide_of(name: str = "eye") -> str:
    solution, wires = eye()
    return write_instructions(solution, wires, GuideConfig(), WireConfig(), name=name)


def test_the_page_stands_alone() -> None:
    html = guide_of()
    page = Page(html)
    assert "<script" not in html
    assert "http" not in html.replace("http-equiv", "")
    for tag, attributes in page.tags:
        assert tag not in ("link", "img", "iframe", "object")
        assert "src" not in attributes
        assert (attributes.get("href") or "#").startswith("#")
    assert "url(" not in html
    assert "@import" not in html


def test_links_lead_somewhere_and_pictures_have_words() -> None:
    page = Page(guide_of())
    ids = {attributes["id"] for _, attributes in page.tags if "id" in attributes}
    assert {(a["href"] or "")[1:] for tag, a in page.tags if tag == "a"} <= ids
    pictures = [attributes for tag, attributes in page.tags if tag == "svg"]
    assert all(len(picture["aria-label"] or "") > 10 for picture in pictures)
    # Title, one overview for each wire, one picture for each step, the map of ties.
    assert len(pictures) == 1 + 2 + (6 + 1) + 1


def test_names_are_escaped() -> None:
    html = guide_of("<b>&\"'</b><script>alert(1)</script>")
    assert "<script" not in html
    assert "<b>&\"'</b>" in Page(html).text


def test_same_input_same_text() -> None:
    assert guide_of() == guide_of()


def test_numbers_are_those_of_the_wires() -> None:
    solution, wires = eye()
    text = Page(guide_of()).text
    for wire in wires:
        assert f"Cut {millimetres(wire.cut_length_mm)}" in text
    total = sum(wire.cut_length_mm for wire in wires)
    guide = plan_guide(solution, wires, GuideConfig(), WireConfig(), name="eye")
    frame, binding = guide.materials
    assert frame.length_mm == pytest.approx(total)
    assert frame.mass_g == pytest.approx(8.96e-3 * math.pi / 4 * 1.02**2 * total, rel=1e-6)
    assert binding.length_mm == pytest.approx(sum(tie.binding_mm for tie in guide.ties))


def test_steps_run_along_the_whole_wire_and_say_which_way() -> None:
    solution, wires = eye()
    sheet = plan_guide(solution, wires, GuideConfig(), WireConfig(), name="eye").sheets[0]
    assert [step.start_mm for step in sheet.steps[1:]] == [step.end_mm for step in sheet.steps[:-1]]
    assert sheet.steps[0].start_mm == 0
    assert sheet.steps[-1].end_mm == pytest.approx(sheet.wire.length_mm)
    actions = [step.action for step in sheet.steps]
    assert actions[0].startswith("From the start mark, keep it straight for 12 mm")
    assert actions[1].startswith("Bend to the right, about 65°, then make a wide curve to the left")
    assert "back close along" in actions[-1]
    assert "point A" in sheet.steps[1].arrival
    assert "wire 2" in sheet.steps[1].arrival
    assert "ends here" in sheet.steps[-1].arrival


def test_present_stretch_is_drawn_over_what_is_done() -> None:
    html = guide_of()
    steps = re.findall(r"<li>\s*<svg.*?</svg>", html, flags=re.DOTALL)
    assert len(steps) == 7
    counts = [len(re.findall(r"<path", step)) for step in steps]
    assert counts == [4, 5, 5, 5, 5, 5, 4]  # the first step of a wire has nothing behind it


def test_binding_law_for_two_passes() -> None:
    frame, thin = 1.02, 0.32
    expected = 5 * (math.pi * (frame + thin) + 2 * frame) + 80
    assert binding_length_mm(frame, thin, 5) == pytest.approx(expected)
    assert binding_length_mm(frame, thin, 5, passes=3) == pytest.approx(expected + 10 * frame)


def star(count: int) -> tuple[object, tuple]:
    """Wires out of one centre, each its own, and a chain of two more at the tip of the last."""
    rays = [straight((0, 0), (20 * math.cos(k), 20 * math.sin(k) * (1 + 0.01 * k))) for k in range(count)]
    tip = rays[-1].end
    rays.append(straight(tip, tip + np.array([5.0, 5.0])))
    return solution_of(drawing_of(rays), [[(index, False)] for index in range(len(rays))])


def test_ties_are_made_once_when_all_their_wires_lie() -> None:
    _, wires = star(5)
    ties = find_ties(wires, 0.32, 5)
    assert sorted(len(tie.wires) for tie in ties) == [2, 5]
    placed: set[int] = set()
    made: list[str] = []
    for placement in assembly_order(wires, ties):
        assert set(placement.joins) <= placed
        placed.add(placement.wire)
        assert all(set(tie.wires) <= placed for tie in placement.ties)
        made += [tie.letter for tie in placement.ties]
    assert placed == set(range(1, len(wires) + 1))
    assert sorted(made) == sorted(tie.letter for tie in ties)


def test_a_wire_without_ties_is_said_so() -> None:
    solution, wires = solution_of(
        drawing_of([straight((0, 0), (20, 0)), straight((0, 5), (10, 5))]), [[(0, False)], [(1, False)]]
    )
    html = write_instructions(solution, wires, GuideConfig(), WireConfig())
    assert "touches no wire that lies there yet" in Page(html).text
    assert "binding wire," not in Page(html).text


def test_many_wires_get_double_letters() -> None:
    rungs = [straight((0, float(y)), (10, float(y))) for y in range(30)]
    posts = [straight((10, float(y)), (20, float(y) + 0.3)) for y in range(30)]
    _, wires = solution_of(drawing_of(rungs + posts), [[(index, False)] for index in range(60)])
    letters = [tie.letter for tie in find_ties(wires, 0.32, 5)]
    assert letters[:2] + letters[24:28] == ["A", "B", "Y", "Z", "AA", "AB"]
    assert len(set(letters)) == 30


def test_text_contrast_is_sufficient() -> None:
    css = guide_of().split("<style>")[1].split("</style>")[0]
    colours = re.findall(r"[{;] ?color: (#[0-9a-f]{6})", css)
    assert len(colours) >= 4
    assert all(contrast(colour, "#ffffff") >= 4.5 for colour in colours)


def contrast(a: str, b: str) -> float:
    def luminance(colour: str) -> float:
        parts = [int(colour[index : index + 2], 16) / 255 for index in (1, 3, 5)]
        linear = [part / 12.92 if part <= 0.03928 else ((part + 0.055) / 1.055) ** 2.4 for part in parts]
        return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]

    bright, dark = sorted((luminance(a), luminance(b)), reverse=True)
    return (bright + 0.05) / (dark + 0.05)


def s_curve() -> BezierChain:
    first = arc_chain((0, 0), 5, math.pi, -math.pi).points
    second = arc_chain((10, 0), 5, math.pi, math.pi).points.copy()
    second[0, 0] = first[-1, 3]
    return BezierChain(np.concatenate([first, second]))


@pytest.mark.parametrize(
    ("chain", "words"),
    [
        (straight((0, 0), (12, 0)), "keep it straight for 12 mm"),
        (arc_chain((0, 0), 3, 0, math.pi), "make a tight curve to the left, about 180° in all, over 9.5 mm"),
        (arc_chain((0, 0), 8, 0, -math.pi / 2), "make a round curve to the right"),
        (arc_chain((0, 0), 4, 0, 2 * math.pi), "make a full loop to the left"),
        (arc_chain((0, 0), 4, 0, -5 * math.pi), "wind a spiral to the right, about 2.5 turns"),
        (s_curve(), "make an S: first to the right (about 180°), then to the left (about 180°)"),
    ],
)
def test_shapes_have_words(chain: BezierChain, words: str) -> None:
    assert shape_phrase(chain).startswith(words)


def test_words_of_the_craft() -> None:
    assert joint_phrase(math.radians(3)) == "Go straight on"
    assert joint_phrase(math.radians(-92)) == "Bend sharply to the right, about 90°"
    assert joint_phrase(math.pi) == "Fold the wire back on itself"
    assert thickness(awg_diameter_mm(18)) == "18 AWG (1.02 mm)"
    assert thickness(1.219) == "18 SWG (1.22 mm)"
    assert thickness(0.95) == "0.95 mm"
    assert listed(["1", "2", "3"]) == "1, 2 and 3"
    assert (millimetres(12.26), millimetres(123.4)) == ("12.5 mm", "123 mm")


def test_springback_is_told() -> None:
    solution, wires = eye()
    from dataclasses import replace

    from wrapit.wires.model import Turn

    bent = replace(wires[0], turns=(Turn("wire-01", 10.0, 20.0, "left", 0.1),))
    guide = plan_guide(solution, (bent, wires[1]), GuideConfig(), WireConfig(temper="hard"), name="eye")
    loss = 3.395 * 300 / (117e3 * 1.02)
    assert f"radius of 10 mm about {round(90 * loss / 0.1)}° further" in guide.sheets[0].overbend
    soft = replace(bent, turns=(Turn("wire-01", 10.0, 20.0, "left", 5.0),))
    gentle = plan_guide(solution, (soft, wires[1]), GuideConfig(), WireConfig(), name="eye")
    assert "radius of 5 mm about 1°" in gentle.sheets[0].overbend
    straight_wire = replace(wires[1], turns=())
    guide = plan_guide(solution, (bent, straight_wire), GuideConfig(), WireConfig(), name="eye")
    assert guide.sheets[1].overbend == ""
    overbent = Handling({}, overbent=True)
    guide = plan_guide(solution, (bent,), GuideConfig(), WireConfig(), name="eye", handling=overbent)
    assert "let it go" in guide.sheets[0].overbend


def test_the_laser_cut_jig_has_its_page() -> None:
    from wrapit.config import JigConfig, PlateConfig

    # With all turns held on their inside a wall goes round another: something lies inside a part.
    solution, wires = eye()
    laser, _ = laser_of(wires, PlateConfig(), JigConfig(support="turns"))
    shown = GuidePage("laser", "Glue it", "sheet/page.html.jinja", plan_laser_page(laser))
    html = write_instructions(solution, wires, GuideConfig(), WireConfig(), name="eye", pages=[shown])
    page = Page(html)
    ids = {attributes["id"] for _, attributes in page.tags if "id" in attributes}
    assert {(a["href"] or "")[1:] for tag, a in page.tags if tag == "a"} <= ids
    section = html.split('<section id="laser">')[1].split("</section>")[0]
    for part in laser.parts:
        assert f"<strong>{part.label}</strong>" in section
    steps = [
        re.findall(r"<strong>([^<]+)</strong>", item) for item in re.findall(r"<li>Glue.*?</li>", section)
    ]
    glued: list[str] = []
    for item, labels in zip(re.findall(r"<li>Glue.*?</li>", section), steps, strict=True):
        # What lies inside another part is glued after it.
        if "inside" in item:
            assert labels.pop() in glued
        glued += labels
    assert sorted(glued) == sorted(part.label for part in laser.parts if part.role in ("wall", "island"))
    assert any("inside" in item for item in re.findall(r"<li>Glue.*?</li>", section))
    assert "6 mm" in section
    assert "3.0 mm above the plate" in section
    assert 'id="laser"' not in guide_of()


def test_the_map_of_each_stack_shows_its_own_wires() -> None:
    from wrapit.config import JigConfig, PlateConfig
    from wrapit.jig.sheet.stage import laser_jig, plan_stack

    _, wires = eye()
    apart = {f"jig-{wire.name}": plan_stack((wire,), JigConfig(), PlateConfig())[0] for wire in wires}
    laser, _ = laser_jig(apart, (), JigConfig(), PlateConfig())
    shown = {stack.jig: [colour for _, colour in stack.wires] for stack in plan_laser_page(laser).stacks}
    assert shown == {f"jig-{wire.name}": [wire.colour] for wire in wires}


def test_what_the_jig_leaves_to_the_hand_is_said_at_its_wire() -> None:
    solution, wires = eye()

    def of(wire: str, code: str, message: str, *places_mm: float) -> Finding:
        return Finding("warning", code, "there", message, "set jig.split", wire=wire, places_mm=places_mm)

    found = [
        of("wire-02", "strays", "it cuts the corner by 1.1 mm", 41.2),
        of("wire-02", "hemmed", "walls on both sides over 5 mm", 7.0),
        of("wire-01", "turn-without-wall", "2 of 3 turns leave no room", 5.0, 41.0),
        Finding("note", "split", "wire-01", "there are 2 jigs"),
        Finding("note", "small-wall", "(3.0, 4.0) mm", "1 wall is left out"),
    ]
    guide = plan_guide(solution, wires, GuideConfig(), WireConfig(), name="eye", findings=found)
    first, second = guide.sheets[0].cautions, guide.sheets[1].cautions
    assert len(first) == 1
    assert first[0].startswith("At 5 and 41 mm: 2 of 3 turns")
    assert [text.split(":")[0] for text in second] == ["At 7 mm", "At 41 mm"]
    assert "thumb" in second[1]
    # What to change in the config is no help at the bench.
    assert "jig.split" not in "".join(second)
    html = write_instructions(solution, wires, GuideConfig(), WireConfig(), name="eye", findings=found)
    assert html.count('class="cautions"') == 2
