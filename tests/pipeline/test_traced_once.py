"""A drawing that was traced serves other readings where these would give the same."""

from __future__ import annotations

from pathlib import Path

import pytest

from wrapit.config import Config, TracingConfig
from wrapit.drawing.json_file import drawing_json
from wrapit.drawing.stage import trace
from wrapit.pipeline.trying import tried as trials
from wrapit.pipeline.trying.tried import Traced, read

SVG = (
    '<svg xmlns="http://www.w3.org/2000/svg" width="60mm" height="60mm" viewBox="0 0 60 60">'
    '<path d="M 5 30 C 5 5 55 5 55 30 C 55 55 5 55 5 30" fill="none" stroke="black"/>{}</svg>'
)
INSIDE = '<path d="M 15 30 C 20 22 40 38 45 30" fill="none" stroke="black"/>'
MODES = ("largest", "join", "weigh")


def _reading(components: str) -> TracingConfig:
    return TracingConfig(components=components)


@pytest.mark.parametrize("more", ["", INSIDE], ids=["one piece", "two pieces"])
@pytest.mark.parametrize("known", MODES)
@pytest.mark.parametrize("asked", MODES)
def test_what_serves_is_what_is_read_anew(tmp_path: Path, more: str, known: str, asked: str) -> None:
    path = tmp_path / "ring.svg"
    path.write_text(SVG.format(more), encoding="utf-8")
    drawing, _ = trace(path, _reading(known), 50.0)
    anew, _ = trace(path, _reading(asked), 50.0)
    serves = Traced(drawing, _reading(known)).serves(_reading(asked))
    assert not serves or drawing_json(drawing) == drawing_json(anew)
    assert serves == (known == asked or (known == "largest" and not more))


def test_another_tolerance_is_another_reading(tmp_path: Path) -> None:
    path = tmp_path / "ring.svg"
    path.write_text(SVG.format(""), encoding="utf-8")
    drawing, _ = trace(path, _reading("largest"), 50.0)
    other = TracingConfig(components="weigh", tolerance=0.1)
    assert not Traced(drawing, _reading("largest")).serves(other)


def test_a_known_drawing_is_not_traced_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "ring.svg"
    path.write_text(SVG.format(""), encoding="utf-8")
    config = Config(drawing=path.name)
    drawing, _ = trace(path, config.reading, 50.0)
    monkeypatch.setattr(trials, "_traced", None)
    assert read(config, path, Traced(drawing, config.reading))[0] is drawing
