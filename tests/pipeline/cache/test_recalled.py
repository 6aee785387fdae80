"""Which steps are made again after which change; the files are the same as without a cache."""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from tests.conftest import CONFIGS
from tests.pipeline.folders import PIECE, held, written_piece
from wrapit.errors import UnheldError
from wrapit.pipeline import stages
from wrapit.pipeline.build import build, check
from wrapit.pipeline.cache import store as stores
from wrapit.pipeline.cache.sealed import Entry
from wrapit.pipeline.cache.store import Store
from wrapit.pipeline.output.ownership import REPORT
from wrapit.pipeline.summary import timing_lines
from wrapit.pipeline.work import STAGES, Work

pytestmark = pytest.mark.usefixtures("kernel_here")

DRAWING = {"trace", "drawing"}
DRAWN = DRAWING | {"decomposition", "wires"}
PRINTED, SHEET = "jig printed", "jig sheet"
EXPORTS = {"wires.step", "views", "guide"}
ALL = DRAWN | {PRINTED, SHEET} | EXPORTS
# A change of the config, and the steps that are made again for it.
CHANGES: list[tuple[str, set[str]]] = [
    ("guide.language=de", {"guide"}),
    ("guide.paper=letter", {"guide"}),
    ("guide.margin=70 mm", ALL - DRAWING - {"decomposition"}),
    ("plate.kerf=0.2 mm", {SHEET, "guide"}),
    ("jig.wall_thickness=4 mm", {PRINTED, SHEET, "views", "guide"}),
    ("jig.base_thickness=4 mm", {PRINTED, SHEET, "views", "guide", "wires.step"}),
    ("jig.springback=compensate", {"wires", "laid", PRINTED, SHEET} | EXPORTS),
    ("jigs=[printed]", {"guide"}),
    ("pegs.pitch=12 mm", set()),
    ("wire.metal=brass", ALL - DRAWING - {"decomposition"}),
    ("decomposition.seed=2", ALL - DRAWING),
    ("decomposition.bridges=true", ALL - {"trace"}),
    ("size=21 mm", ALL),
    ("name=other", {PRINTED} | EXPORTS),
    ("keep=[0]", set()),
    ("fit=gentle", ALL | {"fit"}),  # pieces of the drawing are joined with it
]
KERNEL_FREE = {"guide", "views", SHEET} | DRAWN
OUTPUTS = ["step", "stl", "dxf", "html"]


@pytest.fixture(scope="module")
def filled(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path]:
    """A config, and a cache that its build has filled."""
    place = tmp_path_factory.mktemp("filled")
    # The kernel's time goes with the length of the channel: at 40 mm a build takes thrice as long as at 16.
    config = written_piece(place, size="20 mm", outputs=OUTPUTS)
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("WRAPIT_CACHE", str(place / "cache"))
        build(config, place / "out")
    return config, place / "cache"


@pytest.fixture
def copied(filled: tuple[Path, Path], cache: Path) -> Path:
    """The config, with a copy of that cache as this test's."""
    shutil.copytree(filled[1], cache.parent)
    return filled[0]


@pytest.mark.parametrize(("change", "made"), CHANGES, ids=[change for change, _ in CHANGES])
def test_what_a_change_makes_again(
    tmp_path: Path,
    copied: Path,
    anew: list[str],
    monkeypatch: pytest.MonkeyPatch,
    change: str,
    made: set[str],
) -> None:
    if made <= KERNEL_FREE:
        monkeypatch.setattr(stages, "Worker", None)
    build(copied, tmp_path / "cached", (change,))
    assert set(anew) == made
    monkeypatch.undo()  # the suite's own setting: no cache
    build(copied, tmp_path / "uncached", (change,))
    assert held(tmp_path / "cached") == held(tmp_path / "uncached")


@pytest.mark.parametrize(
    ("change", "made"),
    [
        ("wire.gauge=20 AWG", {"fit"} | DRAWN - {"trace"}),
        ("jig.min_wall_width=3 mm", {"fit"} | DRAWN - {"trace"}),
        ("keep=[0]", {"fit"} | DRAWN - {"trace"}),
        ("jig.wall_thickness=4 mm", set()),
        ("guide.margin=70 mm", {"wires"}),
    ],
)
def test_what_a_change_makes_again_of_a_fitted_piece(
    tmp_path: Path, copied: Path, anew: list[str], change: str, made: set[str]
) -> None:
    build(copied, tmp_path / "first", ("fit=gentle",), until="wires")
    anew.clear()
    build(copied, tmp_path / "cached", ("fit=gentle", change), until="wires")
    assert set(anew) == made


def test_an_offer_is_tried_once(tmp_path: Path, cache: Path, anew: list[str]) -> None:
    config = written_piece(tmp_path)
    corner = '<path d="M 5 20 C 5 5 10 5 10 7 C 10 8 9 8 9 7.5" fill="none" stroke="black"/></svg>'
    (tmp_path / "piece.svg").write_text(PIECE.replace("</svg>", corner))
    first = build(config, tmp_path / "first", until="wires").report
    assert "tight-bend" in {each["code"] for each in first["findings"]}
    assert anew.count("offer") == 1
    again = build(config, tmp_path / "second", until="wires")
    assert anew.count("offer") == 1
    assert again.report["findings"] == first["findings"]
    assert again.cached == STAGES[:3]
    assert cache.is_dir()


def test_of_the_same_input_nothing_is_made_again(
    tmp_path: Path, copied: Path, anew: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(stages, "Worker", None)
    seen: list[tuple[str, tuple[bool, ...]]] = []

    def after(stage: str, work: Work) -> None:
        values = (work.drawing, work.solution, work.wires, work.laid, work.made, work.report.get("jig"))
        seen.append((stage, tuple(map(bool, values))))

    built = build(copied, tmp_path / "cached", after=after)
    assert anew == []
    assert built.cached == STAGES
    assert built.timings["cached"] == list(STAGES)
    assert all(line.endswith(" s from the cache") for line in timing_lines(built))
    assert [(stage, sum(there)) for stage, there in seen] == [
        ("drawing", 1), ("decomposition", 2), ("wires", 4), ("jig", 6), ("exports", 6)
    ]  # fmt: skip
    assert check(copied).report["findings"] == built.report["findings"]
    assert anew == []


def test_force_makes_all_anew_and_keeps_it(
    tmp_path: Path, copied: Path, cache: Path, anew: list[str]
) -> None:
    (before,) = {path.stat().st_mtime_ns for path in cache.iterdir() if path.name == min(held(cache))}
    built = build(copied, tmp_path / "out", force=True)
    assert set(anew) == ALL
    assert built.cached == ()
    assert (cache / min(held(cache))).stat().st_mtime_ns > before


@pytest.mark.parametrize("name", ["leaf"])  # several jigs
def test_pieces_are_the_same_with_and_without(
    tmp_path: Path, cache: Path, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    kinds = ("pair=true", "jigs=[printed, sheet]", "bail={at: top}", "jig.springback=compensate")
    settings = ("size=40 mm", *kinds)
    for folder in ("first", "second"):
        build(CONFIGS / f"{name}.yaml", tmp_path / folder, settings, alternatives=2)
    monkeypatch.setenv("WRAPIT_CACHE", "off")
    build(CONFIGS / f"{name}.yaml", tmp_path / "off", settings, alternatives=2)
    assert held(tmp_path / "first") == held(tmp_path / "off")
    assert held(tmp_path / "second") == held(tmp_path / "off")
    assert list(cache.iterdir()) != []


@pytest.mark.usefixtures("cache")
@pytest.mark.parametrize("value", [b"", b"foreign", b"cnowhere\nnothing\n."])
def test_a_value_that_cannot_be_read_is_made_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, value: bytes
) -> None:
    config = written_piece(tmp_path)
    build(config, tmp_path / "first", until="drawing")
    get = Store.get

    def unlike(store: Store, key: str) -> Entry | None:
        entry = get(store, key)
        return entry and Entry(entry.head, entry.files, value)

    with monkeypatch.context() as patch:
        patch.setattr(Store, "get", unlike)
        assert build(config, tmp_path / "second", until="wires").cached == ()
    assert build(config, tmp_path / "third", until="wires").cached == STAGES[:3]
    assert held(tmp_path / "second") == held(tmp_path / "third")


@pytest.mark.parametrize("spoilt", [b"", b"foreign", None])
def test_entries_that_somebody_spoilt_are_made_again(
    tmp_path: Path, cache: Path, spoilt: bytes | None
) -> None:
    config = written_piece(tmp_path)
    build(config, tmp_path / "first", until="wires")
    for entry in cache.iterdir():
        entry.write_bytes(entry.read_bytes()[:-1] if spoilt is None else spoilt)
    assert build(config, tmp_path / "second", until="wires").cached == ()
    assert build(config, tmp_path / "third", until="wires").cached == STAGES[:3]
    assert held(tmp_path / "first") == held(tmp_path / "second") == held(tmp_path / "third")


def test_a_drawing_that_is_saved_while_it_is_read_is_of_no_key(
    tmp_path: Path, cache: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    import wrapit.drawing.stage as tracing

    config, trace = written_piece(tmp_path), tracing.trace
    drawing = tmp_path / "piece.svg"
    before = drawing.read_text()

    def saved(*given: Any) -> Any:
        drawing.write_text(before.replace("15 15", "14 14"))
        return trace(*given)

    with monkeypatch.context() as patch:
        patch.setattr(tracing, "trace", saved)
        build(config, tmp_path / "amid", until="wires")
    assert not cache.exists()
    drawing.write_text(before)
    assert build(config, tmp_path / "after", until="wires").cached == ()


def test_errors_are_not_kept(
    tmp_path: Path, cache: Path, anew: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("wrapit.pipeline.build.what_would_do", lambda config, drawing: "take another drawing")
    config = written_piece(
        tmp_path,
        size="20 mm",
        jigs=["pegs"],
        outputs=["dxf"],
        jig={"least_support": 1},
        pegs={"diameters": ["30 mm"]},
    )
    for made in (DRAWN, set()):
        anew.clear()
        with pytest.raises(UnheldError):
            build(config, tmp_path / "out")
        assert set(anew) == made
        assert len(list(cache.iterdir())) == len(DRAWN)


def test_a_cache_that_takes_nothing_is_one_note_and_no_matter_of_the_piece(
    tmp_path: Path, cache: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    config = written_piece(tmp_path)
    monkeypatch.setattr(stores, "LEAST_FREE_BYTES", 1 << 60)
    built = build(config, tmp_path / "full", until="wires")
    (note,) = [each for each in built.report["findings"] if each["code"] == "cache"]
    assert (note["level"], note["where"]) == ("note", str(cache))
    assert "no space left" in note["message"]
    assert json.loads((tmp_path / "full" / REPORT).read_text())["findings"] == [
        each for each in built.report["findings"] if each != note
    ]
    monkeypatch.setenv("WRAPIT_CACHE", "off")
    assert "cache" not in {each["code"] for each in build(config, tmp_path / "off").report["findings"]}


@pytest.mark.usefixtures("cache")
def test_what_is_recalled_takes_no_numpy(tmp_path: Path) -> None:
    config = written_piece(tmp_path, pair=True)
    script = (
        "import pathlib, sys\n"
        "from wrapit.pipeline.build import build\n"
        "if __name__ == '__main__':\n"
        "    built = build(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]))\n"
        "    print(len(built.cached), sorted({'numpy', 'shapely', 'scipy', 'OCP'} & set(sys.modules)))\n"
    )
    root = str(CONFIGS.parent)
    said = [
        subprocess.run(
            [sys.executable, "-c", f"import sys; sys.path.insert(0, {root!r})\n{script}", config, out],
            capture_output=True, text=True, check=True,
        ).stdout
        for out in (tmp_path / "first", tmp_path / "second")
    ]  # fmt: skip
    assert said[0].startswith("0 ")
    assert said[1] == "5 []\n"
