"""Completion as bash does it: its own script, really sourced."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent.parent
BASH = "/bin/bash"

pytestmark = pytest.mark.skipif(not Path(BASH).exists(), reason="bash isn't installed")


@pytest.fixture(scope="module")
def shell(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with a program `wrapit`, its completion script, and some files."""
    folder = tmp_path_factory.mktemp("shell")
    program = folder / "bin" / "wrapit"
    program.parent.mkdir()
    program.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m wrapit "$@"\n')
    program.chmod(0o755)
    for name in ("bee.yaml", "bear.yml", "bee.png", "notes.txt", "my bee.yaml"):
        (folder / name).touch()
    (folder / "art").mkdir()
    (folder / "art" / "cat.yaml").touch()
    script = bash(folder, "wrapit --show-completion bash || wrapit --show-completion")
    assert "_WRAPIT_COMPLETE=complete_bash" in script
    (folder / "completion.sh").write_text(script)
    return folder


def bash(folder: Path, script: str) -> str:
    environment = {**os.environ, "PATH": f"{folder / 'bin'}:{os.environ['PATH']}", "PYTHONPATH": str(ROOT)}
    command = [BASH, "--norc", "-c", f"{script}\nexit $?"]
    run = subprocess.run(command, capture_output=True, text=True, cwd=folder, env=environment, check=False)
    assert run.returncode == 0, run.stderr
    return run.stdout


def offered(shell: Path, *words: str) -> list[str]:
    """What bash offers for the last of these words."""
    quoted = " ".join(f"'{word}'" for word in words)
    script = (
        f". ./completion.sh; COMP_WORDS=({quoted}); COMP_CWORD={len(words) - 1}; "
        "function=$(complete -p wrapit | sed 's/.*-F \\([^ ]*\\).*/\\1/'); $function wrapit; "
        "printf '%s\\n' \"${COMPREPLY[@]}\""
    )
    return bash(shell, script).split("\n")[:-1]


def test_commands_and_options(shell: Path) -> None:
    commands = {"build", "check", "init", "coupon", "schema", "materials", "doctor"}
    assert commands <= set(offered(shell, "wrapit", ""))
    assert offered(shell, "wrapit", "ma") == ["materials"]
    assert {"--choose", "--force", "--dump-config"} <= set(offered(shell, "wrapit", "build", "--"))


def test_configs_presets_and_drawings(shell: Path) -> None:
    assert {":pendant", ":charm", ":earrings", "bee.yaml", "bear.yml", "art/"} <= set(
        offered(shell, "wrapit", "build", "")
    )
    assert offered(shell, "wrapit", "build", "be") == ["bear.yml", "bee.yaml"]
    assert offered(shell, "wrapit", "check", "bee.yaml", "art/") == ["art/cat.yaml"]
    assert offered(shell, "wrapit", "build", ":pe") == [":pendant"]
    assert offered(shell, "wrapit", "build", ":", "pe") == ["pendant"]  # as bash parts it at the colon
    assert offered(shell, "wrapit", "init", "be") == ["bee.png"]
    assert offered(shell, "wrapit", "batch", "") == ["art/", "bear.yml", "bee.yaml", "bin/", "my bee.yaml"]


def test_stages_and_keys(shell: Path) -> None:
    assert offered(shell, "wrapit", "build", "bee.yaml", "--until", "d") == ["drawing", "decomposition"]
    assert offered(shell, "wrapit", "build", "bee.yaml", "--set", "wire.m") == ["wire.metal="]


def test_installed_for_the_next_shell(shell: Path, tmp_path: Path) -> None:
    bash(shell, f"export HOME='{tmp_path}'; wrapit --install-completion bash || wrapit --install-completion")
    assert any("_WRAPIT_COMPLETE" in path.read_text() for path in tmp_path.rglob("*.sh"))
    assert "wrapit" in (tmp_path / ".bashrc").read_text()
