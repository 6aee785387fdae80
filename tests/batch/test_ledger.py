"""`batch.json` and `index.html`: whole at any moment, and never written over somebody else's."""

from __future__ import annotations

import hashlib
import json
import os
from pathlib import Path

import pytest
from rich.cells import cell_len

from tests.batch.catalogues import ring
from wrapit.batch import ledger as ledgers
from wrapit.batch.choosing import choose
from wrapit.batch.ledger import Ledger, held
from wrapit.batch.model import Outcome, Piece, failed
from wrapit.batch.pricing import Prices
from wrapit.batch.telling import reason, summary_lines
from wrapit.errors import ConfigError, DrawingError

FOREIGN = {
    "text": b"mine",
    "json": b'{"format": "somebody/1"}',
    "list": b"[]",
    "deep": b"[" * 100_000,
    "empty": b"",
}


@pytest.fixture
def pieces(tmp_path: Path) -> tuple[Piece, ...]:
    return choose([ring(tmp_path, name) for name in ("a", "b")])


def outcome(piece: Piece, problem: str = "no ink") -> Outcome:
    return Outcome(piece, failed(DrawingError(problem, "a.png", "draw something")), 1.0)


@pytest.mark.parametrize("name", ["batch.json", "index.html"])
@pytest.mark.parametrize("content", FOREIGN.values(), ids=FOREIGN)
def test_somebody_elses_files_stay(tmp_path: Path, name: str, content: bytes) -> None:
    (tmp_path / name).write_bytes(content)
    with pytest.raises(ConfigError) as refused, held(tmp_path):
        pass
    assert refused.value.where == str(tmp_path / name)
    assert refused.value.exit_code == 2
    assert "move it away" in refused.value.remedy
    assert (tmp_path / name).read_bytes() == content


def test_links_are_not_followed(tmp_path: Path, pieces: tuple[Piece, ...]) -> None:
    with held(tmp_path / "real"):
        Ledger(tmp_path / "real", pieces, Prices()).write()
    (tmp_path / "out").mkdir()
    for name in ("batch.json", "index.html"):
        (tmp_path / "out" / name).symlink_to(tmp_path / "real" / name)
    with pytest.raises(ConfigError), held(tmp_path / "out"):
        pass


def test_a_page_that_somebody_changed_is_theirs(tmp_path: Path, pieces: tuple[Piece, ...]) -> None:
    ledger = Ledger(tmp_path, pieces, Prices())
    ledger.write()
    with (tmp_path / "index.html").open("a") as page:
        page.write("mine")
    for attempt in (ledger.write, lambda: held(tmp_path).__enter__()):
        with pytest.raises(ConfigError, match=r"index\.html"):
            attempt()
    assert (tmp_path / "index.html").read_text().endswith("mine")


def test_one_batch_at_a_time(tmp_path: Path) -> None:
    with held(tmp_path), pytest.raises(ConfigError, match="another batch"), held(tmp_path):
        pass
    with held(tmp_path):
        pass


class Killed(BaseException):
    pass


@pytest.mark.parametrize("after", range(4))
@pytest.mark.parametrize("whole", [False, True])
def test_killed_between_its_files_it_still_knows_them(
    tmp_path: Path, pieces: tuple[Piece, ...], monkeypatch: pytest.MonkeyPatch, after: int, whole: bool
) -> None:
    """A kill before or after any file is replaced: the next batch takes both for its own."""
    ledger = Ledger(tmp_path, pieces, Prices())
    ledger.write()
    left, write = after, ledgers.write_whole

    def killed(path: Path, text: str) -> None:
        nonlocal left
        if left == 0 and not whole:
            raise Killed
        write(path, text)
        if left == 0:
            raise Killed
        left -= 1

    monkeypatch.setattr(ledgers, "write_whole", killed)
    try:
        ledger.record(outcome(pieces[0]))
        ledger.write()
    except Killed:
        pass
    monkeypatch.setattr(ledgers, "write_whole", write)
    with held(tmp_path):
        later = Ledger(tmp_path, pieces, Prices())
        later.record(outcome(pieces[0]))
        later.record(outcome(pieces[1], "too thin"))
        later.write()
    document = json.loads((tmp_path / "batch.json").read_text())
    assert [piece["status"] for piece in document["pieces"]] == ["failed", "failed"]
    digest = hashlib.sha256((tmp_path / "index.html").read_bytes()).hexdigest()
    assert document["artifacts"] == [{"path": "index.html", "sha256": digest}]


def test_what_a_killed_writer_left_is_cleared_away(tmp_path: Path) -> None:
    (tmp_path / ".wrapit-abcd1234").mkdir()
    (tmp_path / ".wrapit-abcd1234" / "text").touch()
    (tmp_path / ".wrapit-somebody").mkdir()
    (tmp_path / ".wrapit-somebody" / "notes").touch()
    with held(tmp_path):
        pass
    assert [path.name for path in tmp_path.iterdir()] == [".wrapit-somebody"]


@pytest.mark.skipif(os.name == "nt", reason="Windows takes no such names")
def test_names_that_are_no_text_are_spelled_out(tmp_path: Path) -> None:
    odd = [ring(tmp_path, stem) for stem in (os.fsdecode(b"bee\xff"), "moth\x1b[31m")]
    pieces = choose(odd)
    ledger = Ledger(tmp_path / "out", pieces, Prices())
    (tmp_path / "out").mkdir()
    for piece in pieces:
        told = failed(DrawingError(f"{piece.config_path.name} is odd", str(piece.config_path), "rename it"))
        entry = ledger.record(Outcome(piece, told, 1.0))
        assert reason(entry).isprintable()
    ledger.write()
    for name in ("batch.json", "index.html"):
        text = (tmp_path / "out" / name).read_text(encoding="utf-8")
        assert r"bee\udcff" in text.replace("\\\\", "\\")
        assert "\x1b" not in text


def test_columns_stand_below_each_other_whatever_the_script() -> None:
    entry = {
        "status": "ok",
        "wires": 1,
        "cut_length_mm": 100.0,
        "mass_g": 1.0,
        "cost": None,
        "difficulty": "easy",
        "findings": {"error": 0, "warning": 0},
    }
    names = ("bee", "蜂", "e\u0301te\u0301", "a much longer name of a piece")
    totals = {"currency": "", "metal": [], "pieces": 4, "ok": 4, "failed": 0}
    document = {"pieces": [{**entry, "name": name} for name in names], "totals": totals}
    *rows, _ = summary_lines(document, Path("out"))
    assert len({cell_len(row[: row.index("0.10 m")]) for row in rows[1:]}) == 1


def test_a_piece_that_failed_says_why(tmp_path: Path, pieces: tuple[Piece, ...]) -> None:
    entry = Ledger(tmp_path, pieces, Prices()).record(outcome(pieces[0]))
    assert entry["status"] == "failed"
    assert entry["exit_code"] == DrawingError.exit_code
    assert entry["error"] == {
        "code": "drawing",
        "problem": "no ink",
        "where": "a.png",
        "remedy": "draw something",
    }
