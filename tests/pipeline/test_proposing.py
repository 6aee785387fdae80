"""What `init` proposes can be made, and what it found is said on the screen."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.conftest import CONFIGS
from wrapit.config import Config, load_config
from wrapit.config.texts.presets import preset_names
from wrapit.drawing.proposal import SIZES_MM, propose
from wrapit.errors import ConfigError
from wrapit.pipeline.trying import proposing
from wrapit.pipeline.trying.proposing import propose_makeable
from wrapit.pipeline.trying.remedies import held_share


def init(*arguments: str, cwd: Path) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "wrapit", "init", *arguments]
    environment = {**os.environ, "PYTHONPATH": str(CONFIGS.parent)}
    return subprocess.run(
        command, capture_output=True, text=True, timeout=300, check=False, cwd=cwd, env=environment
    )


@pytest.mark.parametrize("name", ["leaf", "bee"])
def test_the_proposed_size_is_held(tmp_path: Path, name: str) -> None:
    drawing = CONFIGS / f"{name}.png"
    proposal, fit = propose_makeable(drawing, tmp_path)
    assert fit == "sound"
    assert proposal.size_mm >= propose(drawing, tmp_path).size_mm
    (tmp_path / "x.yaml").write_text(proposal.text(), encoding="utf-8")
    config = load_config(tmp_path / "x.yaml")
    assert config.size == proposal.size_mm
    assert held_share(config, drawing) >= config.jig.least_support


def test_the_first_size_that_does_is_taken(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    drawing = CONFIGS / "leaf.png"
    monkeypatch.setattr(proposing, "held_share", lambda config, path: 1.0 if config.size >= 55 else 0.2)
    monkeypatch.setattr(proposing, "_too_tight", lambda config, path: max(1.0, 79 / config.size))
    assert propose_makeable(drawing, tmp_path)[0].size_mm == 80
    monkeypatch.setattr(proposing, "_too_tight", lambda config, path: 3.0)
    proposal, fit = propose_makeable(drawing, tmp_path)
    assert (proposal.size_mm, fit) == (55, "tight")
    monkeypatch.setattr(proposing, "held_share", lambda config, path: 0.2)
    proposal, fit = propose_makeable(drawing, tmp_path)
    assert fit == "unheld"
    assert proposal.size_mm == propose(drawing, tmp_path).size_mm


@pytest.mark.parametrize("preset", preset_names())
def test_a_preset_is_written_out(tmp_path: Path, preset: str) -> None:
    proposal = propose(CONFIGS / "leaf.png", tmp_path, preset)
    path = tmp_path / "leaf.yaml"
    path.write_text(proposal.text(), encoding="utf-8")
    config, merged = load_config(path), load_config([Path(f":{preset}"), path])
    assert (config.bail, config.pair, config.guide) == (merged.bail, merged.pair, merged.guide)
    assert config.wire.gauge == load_config(Path(f":{preset}"), ["drawing=x.png"]).wire.gauge
    assert proposal.size_mm in SIZES_MM
    with pytest.raises(ConfigError, match="did you mean"):
        propose(CONFIGS / "leaf.png", tmp_path, f"{preset}x")


@pytest.mark.parametrize("preset", ["", *preset_names()])
def test_what_is_tried_is_what_is_written(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, preset: str
) -> None:
    tried: list[Config] = []

    def holds_the_third(config: Config, _: Path) -> float:
        tried.append(config)
        return 1.0 if len(tried) == 3 else 0.0

    monkeypatch.setattr(proposing, "held_share", holds_the_third)
    monkeypatch.setattr(proposing, "_too_tight", lambda config, path: 1.0)
    proposal, _ = propose_makeable(CONFIGS / "leaf.png", tmp_path, preset)
    path = tmp_path / "leaf.yaml"
    path.write_text(proposal.text(), encoding="utf-8")
    assert tried[-1].model_copy(update={"name": "leaf"}) == load_config(path)
    assert len({config.size for config in tried}) == len(tried) == 3


def test_what_was_found_is_said(tmp_path: Path) -> None:
    (tmp_path / "two.svg").write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 90 40"><g fill="none" stroke="black">'
        '<path d="M 2 20 C 2 0 50 0 50 20 C 50 40 2 40 2 20 Z"/><path d="M 70 20 L 80 22"/></g></svg>'
    )
    run = init("two.svg", "--preset", "pendant", cwd=tmp_path)
    assert run.returncode == 0, run.stderr
    written = (tmp_path / "two.yaml").read_text(encoding="utf-8")
    told = [line[2:] for line in written.splitlines() if line.startswith(("# warning: ", "# note: "))]
    assert told
    assert run.stderr.splitlines()[: len(told)] == told
    assert "bail: {at: top" in written


def test_what_is_made_fit_is_as_small_as_fingers_bend(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """Junctions that lie too near ask for a large piece; made fit, they are one."""
    (tmp_path / "near.svg").write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 90 40"><g fill="none" stroke="black">'
        '<path d="M 2 20 C 2 0 50 0 50 20 C 50 40 2 40 2 20 Z"/>'
        '<path d="M 20 2 L 20 38 M 22 2 L 22 38 M 24 2 L 24 38"/></g></svg>'
    )
    first = propose(tmp_path / "near.svg")
    assert first.size_mm > 2 * first.least_mm
    monkeypatch.setattr(proposing, "held_share", lambda config, path: 1.0)
    least_mm = {"gentle": 50, "bold": 40}
    for off, size_mm in (("tight", 50), ("sound", first.size_mm)):
        monkeypatch.setattr(
            proposing,
            "_too_tight",
            lambda config, path, off=off: (
                1.0 + (off == "tight")
                if config.fit == "off"
                else max(1.0, least_mm[config.fit] / config.size)
            ),
        )
        monkeypatch.setattr(proposing, "gain_of", lambda config, path, level: "")
        proposal, found = propose_makeable(tmp_path / "near.svg")
        assert (proposal.size_mm, found) == (size_mm, "sound")
        assert proposal.fit == ("gentle" if off == "tight" else "")
    assert "# fit: gentle   # with it, size: 50 mm can be made too\n" in proposal.text()
    pendant, _ = propose_makeable(tmp_path / "near.svg", preset="pendant")
    assert propose(tmp_path / "near.svg", preset="pendant").least_mm == 50 <= pendant.size_mm
