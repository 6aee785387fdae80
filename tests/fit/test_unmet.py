"""What is told of a drawing that can't be made fit: its remedies are taken, and help."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from wrapit.config import Config
from wrapit.config.texts.reading import read_yaml
from wrapit.drawing.model import Drawing
from wrapit.drawing.stage import trace
from wrapit.errors import Finding
from wrapit.fit.stage import make_fit

# A rim with a way across, three stubs, and a feeler that curls more tightly than 1 mm wire bends.
LINES = (
    "M 10 30 C 10 5 50 5 50 30 C 50 55 10 55 10 30",
    "M 10 30 C 20 22 40 38 50 30",
    "M 20 13.8 L 19 12",
    "M 30 11.25 L 30 9.5 M 40 13.8 L 41 12",
    "M 50 30 C 55 30 58 28 58 26.6 C 58 25.6 56.9 25.6 56.9 26.6",
)


@pytest.fixture(scope="module")
def drawing(tmp_path_factory: pytest.TempPathFactory) -> Drawing:
    path = tmp_path_factory.mktemp("unmet") / "piece.svg"
    lines = "".join(f'<path d="{data}"/>' for data in LINES)
    group = f'<g fill="none" stroke="black">{lines}</g>'
    path.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 60 60">{group}</svg>')
    tracing = Config.model_validate({"drawing": "x.svg", "tracing": {"shortest_segment": "0 mm"}}).tracing
    return trace(Path(path), tracing, 50.0)[0]


def unfit(drawing: Drawing, **said: object) -> list[Finding]:
    config = Config.model_validate({"drawing": "x.svg", "fit": "gentle", **said})
    return [each for each in make_fit(drawing, config)[1] if each.code == "unfit"]


@settings(max_examples=25, deadline=None)
@given(data=st.data())
def test_what_a_remedy_says_is_taken_and_helps(drawing: Drawing, data: st.DataObject) -> None:
    numbers = [segment.id for segment in drawing.segments]
    keep = data.draw(st.lists(st.sampled_from(numbers), unique=True, min_size=1))
    drop = data.draw(st.lists(st.sampled_from(numbers), unique=True, max_size=2))
    drop = [each for each in drop if each not in keep]
    found = unfit(drawing, keep=keep, drop=drop)
    for finding in found:
        (key, value), *more = re.findall(r"\b(keep|drop): (\[[\d, ]*\])", finding.remedy)
        assert not more
        wishes = {"keep": keep, "drop": drop, key: read_yaml(f"x: {value}", "")["x"]}
        assert finding not in unfit(drawing, **wishes), finding.remedy
        assert set(drop) <= set(wishes["drop"])


def test_what_is_kept_stays_and_is_told(drawing: Drawing) -> None:
    assert unfit(drawing) == []
    every = [segment.id for segment in drawing.segments]
    found = unfit(drawing, keep=every)
    assert sum("shorter than can be bent" in each.message for each in found) == 3
    assert all("\n" not in f"{each.message}{each.remedy}" for each in found)
    stub = next(each for each in found if "shorter" in each.message)
    number = (set(every) - set(read_yaml(stub.remedy.split("with ")[1].split(", or")[0], "")["keep"])).pop()
    x, y = drawing.segments[number].curve.sampled(0.1).mean(axis=0)
    place = [float(each) for each in re.findall(r"-?\d+\.\d", stub.where)]
    assert place == pytest.approx([x, y], abs=0.3)
