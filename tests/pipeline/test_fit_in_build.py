"""The stage `fit` in a build: nothing without it; with it all files are of one drawing; offers were tried."""

from __future__ import annotations

import json
import re
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.pipeline.folders import held
from wrapit.cli.starting import write_proposal
from wrapit.config import Config, load_config
from wrapit.drawing.json_file import drawing_json, read_drawing
from wrapit.drawing.model import Drawing
from wrapit.drawing.stage import trace
from wrapit.errors import ConfigError, Finding, UnheldError, WireError
from wrapit.exports.drawing_svg import drawing_svg
from wrapit.fit import stage as fit_stage
from wrapit.fit.model import Fitted
from wrapit.pipeline import build as builds
from wrapit.pipeline.build import build
from wrapit.pipeline.reads import takes_fit
from wrapit.pipeline.summary import finding_lines, fit_line, summary_lines
from wrapit.pipeline.trying import offering, proposing, remedies
from wrapit.pipeline.trying.offering import counted, offer
from wrapit.pipeline.trying.proposing import propose_makeable
from wrapit.pipeline.trying.remedies import held_share, what_would_do
from wrapit.pipeline.trying.tried import bolder, read, tried
from wrapit.studio.fixes import fixes

MakeFit = Callable[[Drawing, Config], tuple[Fitted, tuple[Finding, ...]]]
SVG = '<svg xmlns="http://www.w3.org/2000/svg" width="60mm" height="60mm" viewBox="0 0 60 60">{}</svg>'
LINE = '<path d="{}" fill="none" stroke="black"/>'
# A rim in two halves between two junctions, a way across, a spiral tail at one of them that 1 mm wire doesn't
# take, and a plain one at the other.
LINES = {
    "rim": "M 10 30 C 10 5 50 5 50 30 C 50 55 10 55 10 30",
    "across": "M 10 30 C 20 22 40 38 50 30",
    "curl": "M 50 30 C 55 30 58 28 58 26.6 C 58 25.6 56.9 25.6 56.9 26.6",
}


@pytest.fixture
def config(tmp_path: Path) -> Path:
    (tmp_path / "piece.svg").write_text(SVG.format("".join(map(LINE.format, LINES.values()))))
    path = tmp_path / "piece.yaml"
    path.write_text(json.dumps({"drawing": "piece.svg", "tracing": {"shortest_segment": "0 mm"}}))
    return path


@pytest.fixture
def curl(config: Path) -> int:
    """The number of the segment that is too tight."""
    drawing = _traced(config)
    return min((each.id for each in drawing.segments), key=lambda each: drawing.segments[each].curve.length)


@pytest.fixture
def leaving_out(monkeypatch: pytest.MonkeyPatch) -> Callable[[dict[str, tuple[int, ...]]], list[str]]:
    """Lets each level leave these segments out; returns the levels that are taken, as they come."""

    def to_be_left_out(numbers: dict[str, tuple[int, ...]]) -> list[str]:
        usual: MakeFit = fit_stage.make_fit
        taken: list[str] = []

        def fitting(drawing: Drawing, config: Config) -> tuple[Fitted, tuple[Finding, ...]]:
            taken.append(config.fit)
            dropped = (*config.drop, *numbers.get(config.fit, ()))
            return usual(drawing, config.model_copy(update={"fit": "off", "drop": dropped}))

        monkeypatch.setattr(fit_stage, "make_fit", fitting)
        return taken

    return to_be_left_out


def _traced(path: Path) -> Drawing:
    config = load_config(path)
    return trace(path.parent / config.drawing, config.tracing, config.size)[0]


def _report(folder: Path) -> dict[str, Any]:
    report: dict[str, Any] = json.loads((folder / "report.json").read_text(encoding="utf-8"))
    return report


def test_off_changes_no_byte(config: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(fit_stage, "make_fit", None)  # it isn't asked, but for an offer
    monkeypatch.setattr(builds, "with_offers", lambda work: work.findings)
    build(config, tmp_path / "usual", until="wires")
    off = ("fit=off", "drop=[]", "keep=[]", "beads=never")
    for index, settings in enumerate((off, ("fit=false", "beads=false"))):
        build(config, tmp_path / str(index), settings, until="wires")
        assert held(tmp_path / str(index)) == held(tmp_path / "usual")
    drawing = _traced(config)
    assert (tmp_path / "usual" / "drawing.json").read_text(encoding="utf-8") == drawing_json(drawing)
    assert (tmp_path / "usual" / "drawing.svg").read_text(encoding="utf-8") == drawing_svg(drawing)
    report = _report(tmp_path / "usual")
    assert "fit" not in report
    assert "fit" not in json.dumps(report["findings"])


def test_to_keep_alone_changes_nothing(config: Path, tmp_path: Path) -> None:
    build(config, tmp_path / "usual", until="wires")
    build(config, tmp_path / "kept", ("keep=[0]",), until="wires")
    usual, kept = held(tmp_path / "usual"), held(tmp_path / "kept")
    differ = {name for name in usual if usual[name] != kept[name]}
    assert differ == {"config.lock.yaml", "report.json"}, "the config is another, so its hash is"
    one, other = _report(tmp_path / "usual"), _report(tmp_path / "kept")
    assert {key for key in one if one[key] != other[key]} == {"config_sha256", "artifacts"}


def test_all_files_are_of_the_fitted_drawing(config: Path, tmp_path: Path, curl: int) -> None:
    result = build(config, tmp_path / "out", (f"drop=[{curl}]",), until="wires")
    before, after = _traced(config), read_drawing(tmp_path / "out" / "drawing.json")
    report = _report(tmp_path / "out")
    fit, length = report["fit"], before.length_mm
    assert fit["before"]["segments"] == len(before.segments)
    assert fit["after"]["segments"] == len(after.segments) == report["drawing"]["segments"]
    assert fit["after"]["length_mm"] == pytest.approx(after.length_mm, abs=1e-3)
    assert fit["left_out_share"] == pytest.approx(before.segments[curl].curve.length / length, abs=1e-3)
    assert Counter(each.what for each in after.removed) - Counter(each.what for each in before.removed) == (
        Counter(fit["changes"])
    )
    assert fit["changes"] == {"dropped": 1}
    decomposition = json.loads((tmp_path / "out" / "decomposition.json").read_text(encoding="utf-8"))
    said = {number for wire in decomposition["wires"] for number, _ in wire["traversals"]}
    assert said == {segment.id for segment in after.segments}
    assert fit_line(fit) in list(summary_lines(result))
    assert re.match(r"left out as asked: \d+ -> \d+ segments?, .* of the lines left out$", fit_line(fit))
    svg = (tmp_path / "out" / "drawing.svg").read_text(encoding="utf-8")
    assert f'id="original-{curl}"' in svg


def test_the_line_of_the_summary() -> None:
    before = {"segments": 130, "wires": 28, "tight_bends": 47}
    after = {"segments": 52, "wires": 1, "tight_bends": 0}
    fit = {"level": "bold", "before": before, "after": after, "beads": [], "left_out_share": 0.08}
    assert fit_line(fit) == (
        "fit bold: 130 -> 52 segments, 28 -> 1 wire, no bend too tight; 8% of the lines left out"
    )
    fit |= {"after": after | {"tight_bends": 1}, "beads": [{}, {}]}
    assert "1 bend too tight, 2 beads; 8% of the lines left out or beads" in fit_line(fit)
    assert fit_line(fit | {"level": "off", "changes": {"bead": 2}}).startswith("with beads: ")
    asked = fit | {"level": "off", "changes": {"bead": 2, "dropped": 1}}
    assert fit_line(asked).startswith("left out as asked: ")


@pytest.mark.parametrize("setting", ["drop=[{last}]", "fit=gentle;keep=[99]", "fit=bold;keep=[0];drop=[0]"])
def test_wishes_that_cannot_be(config: Path, tmp_path: Path, setting: str) -> None:
    settings = setting.format(last=len(_traced(config).segments)).split(";")
    with pytest.raises(ConfigError) as refusal:
        build(config, tmp_path / "out", settings, until="drawing")
    assert refusal.value.remedy
    assert not (tmp_path / "out").exists()


@given(
    st.sampled_from(("off", "gentle", "bold")),
    st.lists(st.integers(0, 9), max_size=2),
    st.lists(st.integers(0, 9), max_size=2),
    st.sampled_from(("never", "auto")),
)
def test_when_it_is_taken(fit: str, keep: list[int], drop: list[int], beads: str) -> None:
    config = Config.model_validate(
        {"drawing": "x.svg", "fit": fit, "keep": keep, "drop": drop, "beads": beads}
    )
    assert takes_fit(config) == (fit != "off" or bool(drop) or beads == "auto")
    assert fit not in bolder(config)
    assert "bold" in bolder(config) or fit == "bold"


def test_what_is_tried_is_what_is_built(config: Path, tmp_path: Path, curl: int) -> None:
    settings = (f"drop=[{curl}]",)
    made = build(config, tmp_path / "out", settings, until="wires").report
    changed = load_config(config, settings)
    found = tried(changed, tmp_path / "piece.svg")
    assert [wire.length_mm for wire in found.wires] == pytest.approx(
        [wire["length_mm"] for wire in made["wires"]], abs=1e-3
    )
    assert drawing_json(read(changed, tmp_path / "piece.svg")[0]) == (
        (tmp_path / "out" / "drawing.json").read_text(encoding="utf-8")
    )
    usual = load_config(config)
    assert held_share(usual, tmp_path / "piece.svg") != held_share(changed, tmp_path / "piece.svg")


def test_an_offer_was_tried_and_no_file_says_it(
    config: Path, tmp_path: Path, curl: int, leaving_out: Callable[..., list[str]]
) -> None:
    leaving_out({"gentle": (curl,), "bold": (curl,)})
    result = build(config, tmp_path / "out", until="wires")
    (said,) = {f["remedy"] for f in result.report["findings"] if f["code"] == "tight-bend"}
    offered = re.search(r"; with fit: gentle: no tight bend.*", said)
    assert offered, said
    assert any(offered[0] in line for line in finding_lines(result, every=False))
    assert "fit" not in (tmp_path / "out" / "report.json").read_text(encoding="utf-8").replace("fitted", "")
    (button,) = [fix for fix in fixes(said, "wire-01", {"drawing": "piece.svg"}) if "fit" in fix["label"]]
    assert button["change"] == {"set": {"fit": "gentle"}}
    then = build(config, tmp_path / "then", ("fit=gentle",), until="wires").report
    assert "tight-bend" not in {each["code"] for each in then["findings"]}
    assert then["fit"]["level"] == "gentle"


def test_a_large_drawing_is_not_tried(
    config: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, leaving_out: Callable[..., list[str]]
) -> None:
    taken = leaving_out({})
    monkeypatch.setattr(offering, "_MOST_SEGMENTS", 1)
    result = build(config, tmp_path / "out", until="wires")
    (said,) = {f["remedy"] for f in result.report["findings"] if f["code"] == "tight-bend"}
    assert said.endswith("; try fit: bold, with so many lines it takes long")
    assert taken == []


def test_the_gentlest_that_does_is_offered(
    config: Path, tmp_path: Path, curl: int, leaving_out: Callable[..., list[str]]
) -> None:
    path, loaded = tmp_path / "piece.svg", load_config(config)
    taken = leaving_out({"bold": (curl,)})
    made = counted(loaded, path)
    assert made is not None
    assert offer(loaded, path, made).startswith("with fit: bold: no tight bend")
    assert taken == ["gentle", "bold"]
    taken.clear()
    gently = loaded.model_copy(update={"fit": "gentle"})
    made = counted(gently, path)
    assert made is not None
    assert offer(gently, path, made).startswith("with fit: bold: ")
    assert taken == ["gentle", "bold"]


def test_what_does_not_help_is_not_offered(
    config: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, leaving_out: Callable[..., list[str]]
) -> None:
    leaving_out({})
    loaded, path = load_config(config), tmp_path / "piece.svg"
    made = counted(loaded, path)
    assert made is not None
    assert offer(loaded, path, made) == ""
    result = build(config, tmp_path / "out", until="wires")
    assert "tight-bend" in {each["code"] for each in result.report["findings"]}
    assert not any("fit:" in each["remedy"] for each in result.report["findings"])

    def fails(*_: object) -> None:
        raise WireError("it can't be bent")

    monkeypatch.setattr(fit_stage, "make_fit", fails)
    assert offer(loaded, path, made) == ""


@given(
    st.lists(
        st.builds(
            Finding,
            st.sampled_from(("note", "warning", "error")),
            st.sampled_from(("tight-bend", "weak-turn", "small-wall", "weak-wire", "springback")),
            st.integers(0, 9).map(str),
            st.just("message"),
        ),
        max_size=8,
    )
)
def test_what_asks_for_it(findings: list[Finding]) -> None:
    asking = offering._asking(findings)
    crowded = {each for each in findings if each.code in ("weak-turn", "small-wall") and each.level != "note"}
    tight = {each for each in findings if each.code == "tight-bend" and each.level != "note"}
    assert asking == (tight | crowded if len(crowded) >= 3 else tight)


def test_a_piece_that_is_not_held_gets_the_offer(config: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    shares = {"off": 0.1, "gentle": 0.2, "bold": 0.5}
    monkeypatch.setattr(remedies, "held_share", lambda config, path: shares[config.fit])
    loaded = load_config(config)
    path = config.parent / loaded.drawing
    assert what_would_do(loaded, path) == "with fit: bold they would hold 50%"
    shares["gentle"] = 0.4
    assert what_would_do(loaded, path) == "with fit: gentle they would hold 40%"
    shares.update(gentle=0.1, bold=0.1)
    assert "simplify" in what_would_do(loaded, path)
    monkeypatch.setattr(builds, "run_stages", _unheld)
    shares["bold"] = 0.5
    with pytest.raises(UnheldError) as refusal:
        build(config, config.parent / "out")
    assert refusal.value.remedy == "with fit: bold they would hold 50%"


def _unheld(*_: object) -> None:
    raise UnheldError("the jig would hold too little")


@pytest.mark.parametrize(("does", "level"), [(("gentle", "bold"), "gentle"), (("bold",), "bold")])
def test_a_drawing_of_no_usual_size_is_made_fit(
    config: Path, monkeypatch: pytest.MonkeyPatch, does: tuple[str, ...], level: str
) -> None:
    monkeypatch.setattr(proposing, "held_share", lambda config, path: 1.0)
    monkeypatch.setattr(proposing, "_too_tight", lambda config, path: 1.0 if config.fit in does else 2.0)
    proposal, found = propose_makeable(config.parent / "piece.svg", config.parent)
    (config.parent / "new.yaml").write_text(proposal.text(), encoding="utf-8")
    assert (load_config(config.parent / "new.yaml").fit, found) == (level, "sound")
    assert "# Made fit for wire: as it is drawn, some bends are too tight" in proposal.text()
    monkeypatch.setattr(proposing, "held_share", lambda config, path: float(config.fit in does))
    monkeypatch.setattr(proposing, "_too_tight", lambda config, path: 2.0)
    assert (propose_makeable(config.parent / "piece.svg")[0].fit) == level, "held is better than unheld"
    monkeypatch.setattr(proposing, "held_share", lambda config, path: 1.0)
    proposal, found = propose_makeable(config.parent / "piece.svg")
    assert (proposal.fit, found) == ("", "tight"), "no fit where it doesn't help"
    assert "fit" not in proposal.text().replace("Made fit", "")


def test_init_says_that_it_is_made_fit(
    config: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(proposing, "held_share", lambda config, path: 1.0)
    monkeypatch.setattr(proposing, "_too_tight", lambda config, path: 1.0 if config.fit != "off" else 2.0)
    target = write_proposal(config.parent / "piece.svg", config.parent / "new.yaml")
    assert load_config(target).fit == "gentle"
    said = capsys.readouterr().err
    assert "note: as it is drawn, no usual size would do, so the config says `fit: gentle`" in said
    assert "warning: at every usual size" not in said


def test_what_it_would_do_is_a_comment(config: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(proposing, "held_share", lambda config, path: 1.0)
    monkeypatch.setattr(proposing, "_too_tight", lambda config, path: 1.0)
    made = {"off": offering.Counts(0, 9, 0.0), "gentle": offering.Counts(0, 6, 0.04)}
    monkeypatch.setattr(offering, "counted", lambda config, path: made[config.fit])
    proposal, _ = propose_makeable(config.parent / "piece.svg", config.parent)
    assert "# fit: gentle   # 6 wires instead of 9, 4% of the lines left out\n" in proposal.text()
    (config.parent / "new.yaml").write_text(proposal.text(), encoding="utf-8")
    assert load_config(config.parent / "new.yaml").fit == "off"
    made["gentle"] = made["off"]
    assert "fit" not in propose_makeable(config.parent / "piece.svg", config.parent)[0].text()
