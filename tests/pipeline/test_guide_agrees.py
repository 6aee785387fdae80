"""The guide and the report of one build say the same: lengths, files, findings, ties."""

from __future__ import annotations

import html as markup
import re
from pathlib import Path

import pytest

from wrapit.instructions.order.wire_steps import BY_HAND
from wrapit.instructions.words.quantities import half_millimetres
from wrapit.pipeline.build import Build, build

pytestmark = pytest.mark.usefixtures("kernel_here")

ROOT = Path(__file__).parents[2]
# In several jigs, in one of sheet, a pair, and in German.
PIECES = {
    "leaf": "{drawing: leaf.svg, size: 60 mm, jigs: [printed]}",
    "butterfly": "{drawing: butterfly.svg, size: 60 mm, jigs: [sheet]}",
    "pair": "{drawing: leaf.svg, size: 60 mm, jigs: [printed, sheet], pair: true}",
    "german": "{drawing: heart-knot.svg, size: 50 mm, jigs: [sheet, pegs], guide: {language: de}}",
}


@pytest.fixture(scope="module", params=sorted(PIECES))
def made(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Build:
    folder = tmp_path_factory.mktemp(request.param)
    settings = PIECES[request.param].replace("drawing: ", f"drawing: {ROOT / 'configs'}/")
    config = folder / f"{request.param}.yaml"
    config.write_text(settings.removesuffix("}") + ", outputs: [3mf, dxf, html, pdf]}\n")
    return build(config, folder / "out")


@pytest.fixture(scope="module")
def page(made: Build) -> str:
    assert made.folder is not None
    return (made.folder / "guide.html").read_text().replace("\u00a0", " ")


@pytest.fixture(scope="module")
def words(page: str) -> str:
    return markup.unescape(" ".join(re.sub(r"<[^>]+>", " ", page).split()))


def german(page: str) -> bool:
    return '<html lang="de">' in page


def pieces(made: Build) -> int:
    return 2 if made.report["name"] == "pair" else 1


def millimetres(page: str, value: float) -> str:
    said = f"{half_millimetres(value):g} mm"
    return said.replace(".", ",") if german(page) else said


def test_every_wire_is_cut_as_the_report_says(made: Build, page: str, words: str) -> None:
    count = "2 × " if pieces(made) == 2 else ""
    for number, wire in enumerate(made.report["wires"], start=1):
        cut, name = millimetres(page, wire["cut_length_mm"]), "Draht" if german(page) else "Wire"
        assert f"{name} {number} {count}{cut} " in words
        said = f"Schneid {cut} Draht ab" if german(page) else f"Cut {cut} of wire"
        assert words.count(said) >= pieces(made)
    total_mm = pieces(made) * sum(wire["cut_length_mm"] for wire in made.report["wires"])
    assert millimetres(page, total_mm) in words


def test_steps_run_to_the_end_of_each_wire(made: Build, page: str) -> None:
    spans = [markup.unescape(each) for each in re.findall(r'class="span">([^<]+)<', page)]
    for wire in made.report["wires"]:
        assert sum(millimetres(page, wire["length_mm"]) in each for each in spans) >= pieces(made)


def test_every_file_that_it_names_is_there(made: Build, page: str) -> None:
    there = {artifact["path"] for artifact in made.report["artifacts"]}
    named = set(re.findall(r"\b(?:jig|plate|pegs)[\w-]*\.(?:3mf|stl|step|dxf|svg)\b", page))
    assert named <= there
    assert {path for path in there if path.endswith((".3mf", ".dxf"))} <= named


def test_what_is_left_to_the_hand_is_said_at_its_place(made: Build, page: str) -> None:
    cautions = re.findall(r'class="caution">(.*?)</p>', page, flags=re.DOTALL)
    said = {
        float(place) for each in cautions for place in re.findall(r"[\d.]+(?=\s?mm)", each.replace(",", "."))
    }
    first = "" if "jig" in made.report else "laser-cut jig, "
    for finding in made.report["findings"]:
        place = re.fullmatch(rf"(?:{first})wire-\d+ at (\d+) mm", finding["where"])
        if finding["code"] in BY_HAND and place:
            assert any(abs(float(place[1]) - at_mm) <= 1 for at_mm in said)


def test_ties_are_all_made(page: str, words: str) -> None:
    headings = re.findall(r'data-kind="tie">.*?<h3>(.*?)</h3>', page, flags=re.DOTALL)
    letters = [letter for each in headings for letter in re.findall(r"\b[A-Z]{1,2}\b", each)]
    count = re.search(r"(\d+) (?:ties|Bindestellen)", words)
    assert count is not None
    assert len(set(letters)) == int(count[1])
