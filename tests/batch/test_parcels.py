"""Pieces as bytes: built elsewhere they are the same, wherever their drawings lie."""

from __future__ import annotations

import io
import json
import zipfile
from pathlib import Path
from typing import Any

import pytest

from tests.batch.catalogues import QUICK, ring
from tests.pipeline.folders import PIECE, held
from wrapit.batch.choosing import choose
from wrapit.batch.model import Piece
from wrapit.batch.parcels import arrived, build_parcel, packed, put_here
from wrapit.errors import ConfigError, DrawingError, ExportError
from wrapit.pipeline.build import build

pytestmark = pytest.mark.usefixtures("kernel_here")


def piece_with(folder: Path, drawing: str, name: str = "moth") -> Piece:
    """A config whose drawing lies there, seen from the config."""
    (folder / drawing).parent.mkdir(parents=True, exist_ok=True)
    (folder / drawing).write_text(PIECE)
    config = folder / f"{name}.yaml"
    config.write_text(json.dumps({"drawing": drawing, **QUICK}))
    return choose([config])[0]


@pytest.mark.parametrize("drawing", ["ring.svg", "../../drawings/ring ü.svg", "sub/../deep/er/ring.svg"])
def test_built_elsewhere_it_is_the_same(tmp_path: Path, drawing: str) -> None:
    (tmp_path / "a" / "b").mkdir(parents=True)
    piece = piece_with(tmp_path / "a" / "b", drawing)
    overrides = ["wire.gauge=20 AWG"]
    build(piece.config_path, tmp_path / "here", overrides)
    answer = build_parcel(packed(piece, overrides), "machine", str(tmp_path))
    assert answer["exit_code"] == 0
    assert answer["timings_s"]
    put_here(answer["files"], tmp_path / "there")
    assert held(tmp_path / "there") == held(tmp_path / "here")


def test_somebodys_file_stays_beside_what_arrives(tmp_path: Path) -> None:
    piece = piece_with(tmp_path, "ring.svg")
    build(piece.config_path, tmp_path / "out")
    (tmp_path / "out" / "guide.html").write_text("mine")
    put_here(build_parcel(packed(piece, ()), "machine")["files"], tmp_path / "out")
    report = json.loads((tmp_path / "out" / "report.json").read_text())
    assert (tmp_path / "out" / "guide.html").read_text() == "mine"
    assert {"guide.new.html"} == {a["path"] for a in report["artifacts"] if "instead_of" in a}
    assert "file-kept" in {finding["code"] for finding in report["findings"]}


def test_a_foreign_folder_is_refused(tmp_path: Path) -> None:
    files = io.BytesIO()
    with zipfile.ZipFile(files, "w") as archive:
        archive.writestr("report.json", "{}")
    (tmp_path / "notes.txt").write_text("mine")
    with pytest.raises(ConfigError):
        put_here(files.getvalue(), tmp_path)


@pytest.mark.parametrize("name", ["../evil", "/evil", "a/b", "..", "C:\\evil"])
def test_files_stay_in_their_folder(tmp_path: Path, name: str) -> None:
    files = io.BytesIO()
    report: dict[str, Any] = {"format": "wrapit-report/1", "artifacts": [], "findings": []}
    with zipfile.ZipFile(files, "w") as archive:
        archive.writestr("report.json", json.dumps(report))
        archive.writestr(name, "evil")
    with pytest.raises(ExportError):
        put_here(files.getvalue(), tmp_path / "deep" / "out")
    assert list(tmp_path.rglob("*evil*")) == []


def test_a_worker_of_another_version_says_so(tmp_path: Path) -> None:
    parcel = packed(choose([ring(tmp_path, "a")])[0], ()) | {"version": "0.0.7"}
    error = build_parcel(parcel, "tcp://far:1")["error"]
    assert error["where"] == "tcp://far:1"
    assert "0.0.7" in error["problem"]
    assert "==0.0.7" in error["remedy"]


@pytest.mark.parametrize("drawing", ["/srv/ring.svg", "C:\\ring.svg", "\\\\host\\ring.svg"])
def test_an_absolute_drawing_cannot_be_sent(tmp_path: Path, drawing: str) -> None:
    piece = choose([ring(tmp_path, "a", drawing=drawing)])[0]
    with pytest.raises(DrawingError, match="absolute"):
        packed(piece, ())


def test_a_missing_drawing_is_not_sent(tmp_path: Path) -> None:
    with pytest.raises(DrawingError) as refused:
        packed(choose([ring(tmp_path, "a", drawing="none.svg")])[0], ())
    assert refused.value.where == str(tmp_path / "none.svg")


def test_places_are_told_as_they_are_here(tmp_path: Path) -> None:
    piece = piece_with(tmp_path, "ring.svg")
    (tmp_path / "ring.svg").write_text("<svg")
    here = Piece(piece.name, Path("configs") / piece.config_path.name, piece.config)
    ended = arrived(build_parcel(packed(piece, ()), "machine", str(tmp_path)), here)
    assert ended.exit_code == 3
    assert ended.error is not None
    assert str(Path("configs") / "ring.svg") in ended.error["where"]
    assert str(tmp_path) not in str(ended.error)
