"""What was read lies beside what is made of it, and a button that promises fit was tried."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from shapely import LineString, Point

from tests.studio.running import CONFIG, PICTURE, Studio, running, with_piece
from wrapit.config import Config, load_config
from wrapit.drawing.json_file import drawing_json
from wrapit.drawing.model import Drawing
from wrapit.errors import ConfigError, Finding
from wrapit.fit.model import Fitted
from wrapit.fit.stage import make_fit
from wrapit.pipeline.stages import run_stages
from wrapit.pipeline.work import Work
from wrapit.studio import comparing
from wrapit.studio.comparing import fit_document, helped_by_fit
from wrapit.studio.session import Session
from wrapit.studio.showing import shown_after

Fit = tuple[Fitted, tuple[Finding, ...]]
LINES = 2
"""Of the picture: a ring and a stem."""


def worked(folder: Path, more: str = "", picture: str = PICTURE) -> Work:
    with_piece(folder, CONFIG + more)
    (folder / "leaf.svg").write_text(picture)
    work = Work(load_config(folder / "leaf.yaml"), folder / "leaf.svg", "wires", lambda stage: None, 0)
    run_stages(work, None)
    return work


@pytest.mark.parametrize("number", range(LINES))
def test_a_line_that_is_left_out_is_still_shown(tmp_path: Path, number: int) -> None:
    whole = worked(tmp_path).drawing
    assert whole is not None
    assert len(whole.segments) == LINES
    work = worked(tmp_path, f"drop: [{number}]\n")
    shown = shown_after("drawing", work)["shown"]
    fit = json.loads(json.dumps(shown["fit"]))
    assert fit["original"] == json.loads(drawing_json(whole))
    assert fit["left_out"] == [number]
    assert sorted(each for origin in fit["origins"] for each in origin) == [
        each for each in range(LINES) if each != number
    ]
    assert len(fit["origins"]) == len(shown["drawing"]["segments"])
    assert fit["before"]["segments"] == LINES
    assert fit["costs"]["left_out"] == pytest.approx(
        whole.segments[number].curve.length / whole.length_mm, rel=1e-3
    )
    [change] = fit["changes"]
    assert change["line"] == number
    line = LineString(whole.segments[number].curve.sampled(0.01))
    assert line.distance(Point(*change["at"])) < 0.05


@pytest.mark.parametrize("more", ["", "fit: off\nkeep: [0]\n"])
def test_where_nothing_is_asked_for_there_is_one_drawing(tmp_path: Path, more: str) -> None:
    assert shown_after("drawing", worked(tmp_path, more))["shown"]["fit"] is None


def test_a_change_that_leaves_no_line_out_names_none(tmp_path: Path) -> None:
    work = worked(tmp_path, "drop: [1]\n")
    fitted = work.fitted
    assert fitted is not None
    others = tuple(dataclasses.replace(each, what="faired") for each in fitted.drawing.removed)
    changed = dataclasses.replace(fitted, drawing=dataclasses.replace(fitted.drawing, removed=others))
    document = fit_document(changed, work.config)
    assert document is not None
    assert [each["line"] for each in document["changes"]] == [None]


# Codes that a build told, one of them against which fit may help.
TIGHT = {"tight-bend", "scale"}
HELD = {"unheld", "unheld-wire"}


def with_fewer_bends(drawing: Drawing, config: Config) -> Fit:
    """As the real one, which gentle has one tight bend less than off."""
    fitted, findings = make_fit(drawing, config)
    bends = 3 - (config.fit == "gentle")
    return dataclasses.replace(fitted, after=dataclasses.replace(fitted.after, tight_bends=bends)), findings


def refusing(*_: object) -> Fit:
    raise ConfigError("nothing would be left of the drawing", "fit", "draw larger")


@pytest.mark.parametrize(
    ("make", "more", "codes", "helped"),
    [
        (with_fewer_bends, "", TIGHT, ["tight-bend"]),
        (with_fewer_bends, "", {"weak-wire"}, []),
        (with_fewer_bends, "fit: gentle\n", TIGHT, []),
        (with_fewer_bends, "fit: bold\n", TIGHT, []),
        (with_fewer_bends, "drop: [1]\n", TIGHT, ["tight-bend"]),
        (with_fewer_bends, "", HELD, []),  # the same drawing is held as it was
        (refusing, "", TIGHT | HELD, []),
    ],
)
def test_fit_is_offered_where_it_was_tried_and_helps(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    make: Callable[[Drawing, Config], Fit],
    more: str,
    codes: set[str],
    helped: list[str],
) -> None:
    work = worked(tmp_path, more)
    monkeypatch.setattr(comparing, "make_fit", make)
    assert helped_by_fit(work, codes) == helped


@pytest.mark.parametrize(("left_out", "helped"), [("tail", ["unheld"]), ("ring", []), ("nothing", [])])
def test_fit_is_offered_where_the_jig_then_holds_enough(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, left_out: str, helped: list[str]
) -> None:
    """No peg goes into the bends of the tail, so that one wire along ring and tail isn't held at all."""
    tailed = PICTURE.replace("M 45 20 L 60 20", "M 45 20 C 47 10 49 30 51 20 C 53 10 55 30 57 20")
    work = worked(tmp_path, "pegs: {diameters: [3 mm]}\n", tailed)
    assert work.drawing is not None
    lengths = [segment.curve.length for segment in work.drawing.segments]
    numbers = {"tail": [lengths.index(min(lengths))], "ring": [lengths.index(max(lengths))], "nothing": []}

    def leaving_out(drawing: Drawing, config: Config) -> Fit:
        drop = tuple(numbers[left_out]) if config.fit == "gentle" else ()
        return make_fit(drawing, config.model_copy(update={"fit": "off", "drop": drop}))

    monkeypatch.setattr(comparing, "make_fit", leaving_out)
    assert helped_by_fit(work, {"unheld", "weak-wire"}) == helped


def test_a_finding_has_the_button_that_was_tried_for_it(tmp_path: Path) -> None:
    session = Session(with_piece(tmp_path) / "leaf.yaml", None)
    told = {
        "level": "warning",
        "where": "wire-01",
        "message": "tight",
        "remedy": "bend it by hand",
        "at": None,
    }
    session._building.findings = [told | {"code": "tight-bend"}, told | {"code": "weak-wire"}]
    session._building.problem = {"code": "unheld", "problem": "", "where": "leaf", "remedy": ""}
    session._building.helped = ["tight-bend", "unheld"]
    state = session.state()
    fit = [{"label": "Make it fit: gentle", "change": {"set": {"fit": "gentle"}}}]
    assert [each["fixes"] for each in state["findings"]] == [fit, []]
    assert state["problem"]["fixes"] == fit


def test_numbers_are_written_by_the_page_and_taken_back(tmp_path: Path) -> None:
    with running(with_piece(tmp_path), "leaf.yaml") as studio:
        assert studio.built()["shown"]["fit"] is None
        said = changed(studio, {"add": {"drop": [1]}, "take": {"keep": [1]}})
        assert studio.config.read_text() == CONFIG.replace("jigs:", "drop: [1]\njigs:")
        assert (said["drop"], said["keep"], said["shown"]["fit"]["left_out"]) == ([1], [], [1])
        assert len(said["shown"]["drawing"]["segments"]) == LINES - 1
        said = changed(studio, {"add": {"keep": [1]}, "take": {"drop": [1]}})
        assert (said["drop"], said["keep"], said["shown"]["fit"]) == ([], [1], None)
        assert studio.post("/undo", {})[0] == 200
        assert studio.built()["shown"]["fit"]["left_out"] == [1]
        assert studio.post("/undo", {})[0] == 200
        assert studio.built()["shown"]["fit"] is None
        assert studio.config.read_text() == CONFIG
        status, told = studio.post("/change", {"add": {"drop": [-7]}})
        assert (status, told["error"]["code"]) == (422, "config")


def changed(studio: Studio, change: dict[str, Any]) -> dict[str, Any]:
    status, told = studio.post("/change", change)
    assert status == 200, told
    return studio.built()
