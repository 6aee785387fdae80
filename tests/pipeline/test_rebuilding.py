"""What is there already isn't built again, and nothing less is taken for it."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.pipeline.folders import held, listed, written_piece
from wrapit.pipeline.build import build
from wrapit.pipeline.output.ownership import REPORT
from wrapit.pipeline.summary import summary_lines
from wrapit.pipeline.work import STAGES, Stage

KERNEL_FREE: tuple[Stage, ...] = STAGES[:3]


@pytest.fixture
def piece(tmp_path: Path) -> tuple[Path, Path]:
    return written_piece(tmp_path), tmp_path / "out"


@pytest.mark.parametrize("stage", KERNEL_FREE)
def test_the_same_build_again_is_up_to_date(piece: tuple[Path, Path], stage: Stage) -> None:
    assert not build(*piece, until=stage).up_to_date
    before = held(piece[1])
    again = build(*piece, until=stage)
    assert again.up_to_date
    assert list(summary_lines(again))[-1] == f"up to date: {piece[1]}"
    assert held(piece[1]) == before


def test_any_file_that_is_gone_or_changed_is_built_again(piece: tuple[Path, Path]) -> None:
    build(*piece, until="wires")
    before = held(piece[1])
    for artifact in listed(piece[1]):
        (piece[1] / artifact["path"]).unlink()
        assert not build(*piece, until="wires").up_to_date
        assert held(piece[1]) == before
    for number, artifact in enumerate(listed(piece[1])):
        path = piece[1] / artifact["path"]
        path.write_bytes(b"changed")
        report = build(*piece, until="wires").report
        assert path.read_bytes() == b"changed"
        assert "file-kept" in {finding["code"] for finding in report["findings"]}
        assert sum("instead_of" in each for each in report["artifacts"]) == number + 1
        assert build(*piece, until="wires").up_to_date


def test_a_file_of_somebody_elses_that_is_gone_gives_its_name_back(piece: tuple[Path, Path]) -> None:
    build(*piece, until="wires")
    before = held(piece[1])
    (piece[1] / "drawing.json").write_text("changed")
    build(*piece, until="wires")
    assert (piece[1] / "drawing.new.json").read_bytes() == before["drawing.json"]
    (piece[1] / "drawing.json").unlink()
    assert not build(*piece, until="wires").up_to_date
    assert held(piece[1]) == before


@pytest.mark.parametrize("force", [False, True])
@pytest.mark.parametrize("stage", KERNEL_FREE[:2])
def test_a_fuller_build_stays(piece: tuple[Path, Path], stage: Stage, force: bool) -> None:
    build(*piece, until="wires")
    before = held(piece[1])
    less = build(*piece, until=stage, force=force)
    assert held(piece[1]) == before
    assert less.up_to_date is not force
    if not force:
        assert "it holds a build until wires, which stays as it is" in list(summary_lines(less))[-1]


def test_other_input_is_never_taken_for_the_same(piece: tuple[Path, Path]) -> None:
    build(*piece, until="wires")
    assert not build(*piece, ("size=39 mm",), until="drawing").up_to_date
    assert {each["path"] for each in listed(piece[1])} >= {"drawing.json"}
    assert not (piece[1] / "decomposition.json").exists(), "it would be of another size"
    drawing = piece[0].with_name("piece.svg")
    drawing.write_text(drawing.read_text().replace("15 15", "14 14"))
    assert not build(*piece, ("size=39 mm",), until="drawing").up_to_date


def test_choices_come_when_they_are_asked_for_and_stay(piece: tuple[Path, Path]) -> None:
    assert not build(*piece, until="wires").up_to_date
    assert not build(*piece, until="wires", alternatives=2).up_to_date
    assert (piece[1] / "alternatives.svg").is_file()
    assert build(*piece, until="wires", alternatives=2).up_to_date
    assert build(*piece, until="wires").up_to_date
    assert not build(*piece, until="wires", alternatives=3).up_to_date


@pytest.mark.parametrize("artifacts", [None, [], [1], "x", {}, [{"path": 1}], [{"instead_of": 1}]])
def test_a_report_that_somebody_spoilt_is_written_again(piece: tuple[Path, Path], artifacts: object) -> None:
    build(*piece, until="drawing")
    true = json.loads((piece[1] / REPORT).read_text())
    (piece[1] / REPORT).write_text(json.dumps({**true, "artifacts": artifacts}))
    assert not build(*piece, until="drawing").up_to_date
    assert build(*piece, until="drawing").up_to_date
