"""Each step reads no more of the config than `reads` says: every key that is read is recorded."""

from __future__ import annotations

import typing
from collections import defaultdict
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from tests.conftest import CONFIGS
from tests.pipeline.folders import PIECE, written_piece
from tests.pipeline.kernel_here import KernelHere
from wrapit.config import Config
from wrapit.config.block import Block
from wrapit.jig.kinds import JIGS
from wrapit.pipeline import stages
from wrapit.pipeline.build import build
from wrapit.pipeline.cache.remembering import Outcome
from wrapit.pipeline.reads import STEPS, all_reads
from wrapit.pipeline.work import Work
from wrapit.pipeline.worker import Job

# Together they come by each branch that asks for a key of its own: each kind, a pair, both bails, seats,
# overbending, pegs, several jigs, both solvers, bridges.
SETTINGS: dict[str, tuple[str, ...]] = {
    "printed": ("jigs=[printed]", "pair=true", "bail={at: top}"),
    "sheet": ("jigs=[sheet]", "jig.springback=compensate"),
    "pegs": ("jigs=[pegs]", "jig.support=turns"),
    "bridges": ("jigs=[printed]", "decomposition.bridges=true", "jig.split=per-wire"),
    "annealing": ("jigs=[sheet]", "decomposition.solver=annealing", "outputs=[html, dxf]", "pair=true"),
}


def _keys(block: type[Block], prefix: str = "") -> Iterator[tuple[tuple[type[Block], str], str]]:
    """Each field of each block, and how the config spells it."""
    for name, field in block.model_fields.items():
        yield (block, name), f"{prefix}{name}"
        for inner in _blocks(field.annotation):
            yield from _keys(inner, f"{prefix}{name}.")


def _blocks(annotation: Any) -> Iterator[type[Block]]:
    if isinstance(annotation, type) and issubclass(annotation, Block):
        yield annotation
    for argument in typing.get_args(annotation):
        yield from _blocks(argument)


SPELT = dict(_keys(Config))


class Here(KernelHere):
    """What it does belongs to the step that asked for it, and that is done then."""

    def __init__(self, recorder: Recorder) -> None:
        self._recorder = recorder

    def start(self, where: str, limit_s: float, function: Callable[..., Any], *arguments: Any) -> Job:
        job = super().start(where, limit_s, function, *arguments)
        self._recorder.step = ""
        return job


class Recorder:
    """What is read between a step's being missed in the cache and its being kept there."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.step, self.read = "", defaultdict[str, set[str]](set)
        self._names: dict[str, str] = {}
        usual, key, recall, keep = Block.__getattribute__, Work.key, Work.recall, Work.keep

        def reading(block: Block, name: str) -> Any:
            if self.step and (spelt := SPELT.get((type(block), name))):
                self.read[self.step].add(spelt)
            return usual(block, name)

        def naming(work: Work, step: str, *also: Any, **upon: Any) -> str:
            self.step = ""
            name = key(work, step, *also, **upon)
            self._names[name] = step
            return name

        def missing(work: Work, name: str, folder: Path | None) -> Outcome | None:
            found = recall(work, name, folder)
            self.step = self._names[name]
            return found

        def keeping(work: Work, *given: Any) -> Outcome:
            self.step = ""
            return keep(work, *given)

        monkeypatch.setattr(Block, "__getattribute__", reading)
        monkeypatch.setattr(Work, "key", naming)
        monkeypatch.setattr(Work, "recall", missing)
        monkeypatch.setattr(Work, "keep", keeping)
        monkeypatch.setattr(stages, "Worker", lambda preload: Here(self))

    def undeclared(self) -> dict[str, list[str]]:
        """Keys that steps read and don't say so; who says a key of a block may take the block for it."""
        return {
            step: wrong
            for step, read in self.read.items()
            if (wrong := sorted(path for path in read if not _declared(path, all_reads(step))))
        }


def _declared(path: str, said: set[str]) -> bool:
    within = any(path == key or path.startswith(f"{key}.") for key in said)
    return within or any(key.startswith(f"{path}.") for key in said)


@pytest.fixture
def recorder(monkeypatch: pytest.MonkeyPatch) -> Recorder:
    return Recorder(monkeypatch)


@pytest.mark.parametrize("settings", SETTINGS.values(), ids=SETTINGS)
def test_no_step_reads_what_it_does_not_say(
    tmp_path: Path, recorder: Recorder, settings: tuple[str, ...]
) -> None:
    build(CONFIGS / "leaf.yaml", tmp_path / "out", settings, alternatives=2)
    assert recorder.undeclared() == {}
    assert set(recorder.read) >= {"trace", "decomposition", "wires", "guide"}
    assert any(step.startswith("jig ") for step in recorder.read)


def test_nor_with_seats_and_a_size_of_its_own(tmp_path: Path, recorder: Recorder) -> None:
    seats = [{"at": ["20 mm", "20 mm"], "diameter": "4 mm"}]
    build(written_piece(tmp_path, jig={"seats": seats}, jigs=["printed"], pair=True), tmp_path / "out")
    assert recorder.undeclared() == {}
    assert "jig.seats.at" in recorder.read["jig printed"]


@pytest.mark.parametrize("name", ["bead-pendant", "celtic-knot", "earrings", "leaf", "mandala"])
def test_nor_for_pieces_of_the_gallery(tmp_path: Path, recorder: Recorder, name: str) -> None:
    build(CONFIGS / f"{name}.yaml", tmp_path / "out", until="wires")
    assert recorder.undeclared() == {}


@pytest.mark.parametrize("settings", [("fit=gentle",), ("fit=bold", "beads=auto"), ("drop=[0]", "keep=[1]")])
@pytest.mark.parametrize("springback", ["report", "compensate"])
def test_nor_where_it_is_made_fit(
    tmp_path: Path, recorder: Recorder, settings: tuple[str, ...], springback: str
) -> None:
    also = (f"jig.springback={springback}", "jig.post_bends=true", "decomposition.bridges=true")
    config = written_piece(tmp_path)
    across = '<path d="M 35 20 C 25 25 15 15 5 20" fill="none" stroke="black"/></svg>'
    (tmp_path / "piece.svg").write_text(PIECE.replace("</svg>", across))
    build(config, tmp_path / "out", (*settings, *also), until="wires")
    assert recorder.undeclared() == {}
    assert {"fit", "drop"} <= recorder.read["fit"]


def test_nor_does_an_offer(tmp_path: Path, recorder: Recorder) -> None:
    config = written_piece(tmp_path)
    corner = '<path d="M 5 20 C 5 5 10 5 10 7 C 10 8 9 8 9 7.5" fill="none" stroke="black"/></svg>'
    (tmp_path / "piece.svg").write_text(PIECE.replace("</svg>", corner))
    build(config, tmp_path / "out", until="wires")
    assert recorder.undeclared() == {}
    assert "wire.gauge" in recorder.read["offer"]


@pytest.mark.parametrize("step", ["decomposition", "drawing"])
def test_what_is_not_fitted_is_of_any_wire(step: str) -> None:
    assert "wire" in all_reads(step, fit=True)
    alone = all_reads(step, fit=False, twice=False)
    assert alone & {"wire", "keep", "jig.clearance"} == set()
    assert alone >= {"fit", "drop", "beads"}


def test_where_two_wires_may_lie_side_by_side_their_room_is_read() -> None:
    assert {"wire", "jig.clearance"} <= all_reads("decomposition", fit=False, twice=True)
    assert "wire" not in all_reads("drawing", fit=False, twice=True)


def test_a_step_that_reads_more_is_found(
    tmp_path: Path, recorder: Recorder, monkeypatch: pytest.MonkeyPatch
) -> None:
    wires = STEPS["wires"]
    less = type(wires)(wires.upon, tuple(set(wires.reads) - {"guide.margin"}))
    monkeypatch.setitem(STEPS, "wires", less)
    build(written_piece(tmp_path), tmp_path / "out", until="wires")
    assert recorder.undeclared()["wires"] == ["guide", "guide.margin"]


def test_what_is_said_is_spelt_as_in_the_config() -> None:
    spelt = set(SPELT.values())
    assert {key for step in STEPS.values() for key in step.reads} <= spelt
    assert {f"jig {kind}" for kind in JIGS} <= set(STEPS), "else a change of anything makes that kind again"
    assert all_reads("jig paper") >= set(Config.model_fields), "a kind that isn't named reads everything"
