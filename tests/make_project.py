"""A copy of this project in which make builds pieces, and how often it calls wrapit for that."""

from __future__ import annotations

import copy
import hashlib
import os
import shutil
import subprocess
import sys
from pathlib import Path
from subprocess import PIPE

from wrapit.pipeline.work import Stage

ROOT = Path(__file__).parent.parent
RING = """<svg xmlns="http://www.w3.org/2000/svg" width="40mm" height="30mm" viewBox="0 0 40 30">
<path d="M5,15 C5,2 35,2 35,15 C35,28 5,28 5,15 Z" fill="none" stroke="black"/></svg>
"""
# The environment's programs: this Python, and wrapit from the project's own folder, with a note of each call.
PYTHON = '#!/bin/sh\nexec "{python}" "$@"\n'
WRAPIT = '#!/bin/sh\necho "$*" >> "{log}"\nexec "{python}" -m wrapit "$@" --until {until}\n'


class Project:
    """A copy of this one, with an environment that is ready, so that nothing is installed.

    To make, half a build is as good as a whole one; `until` says how far its wrapit goes.
    """

    def __init__(self, folder: Path, until: Stage = "decomposition") -> None:
        self.until = until
        self._place(folder)
        self.configs.mkdir(parents=True)
        (folder / ".ci").mkdir()
        for name in ("Makefile", "pyproject.toml", "requirements.lock", ".ci/make-venv"):
            shutil.copy2(ROOT / name, folder / name)
        # With its bytecode, where there is some: it would be compiled anew for each of these projects.
        shutil.copytree(ROOT / "wrapit", folder / "wrapit")
        self._write_programs()
        for name in (".python", ".ready"):
            (folder / ".venv" / name).touch()

    def _place(self, folder: Path) -> None:
        self.folder = folder
        self.configs, self.build, self.log = folder / "configs", folder / "build", folder / "calls.log"

    def _write_programs(self) -> None:
        bin_ = self.folder / ".venv/bin"
        bin_.mkdir(parents=True, exist_ok=True)
        for name, text in (("python", PYTHON), ("wrapit", WRAPIT)):
            (bin_ / name).write_text(text.format(python=sys.executable, log=self.log, until=self.until))
            (bin_ / name).chmod(0o755)

    def copied(self, folder: Path) -> Project:
        """The same elsewhere: files are as old as they are here."""
        shutil.copytree(self.folder, folder)
        there = copy.copy(self)
        there._place(folder)
        there._write_programs()
        return there

    def add(self, name: str = "ring", drawing: str = "ring.svg") -> Path:
        """A piece that takes a moment to build; returns its drawing."""
        quoted = drawing.replace("'", "''")
        (self.configs / f"{name}.yaml").write_text(f"drawing: '{quoted}'\nsize: 40 mm\noutputs: []\n")
        path = Path(os.path.normpath(self.configs / drawing))
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(RING)
        return path

    def start(self, *arguments: str) -> subprocess.Popen[str]:
        environment = {**os.environ, "LC_ALL": "C.UTF-8"}
        for name in ("MAKEFLAGS", "MAKELEVEL", "MFLAGS", "PYTHON"):
            environment.pop(name, None)  # these tests may have been started by make
        return subprocess.Popen(
            ["make", *arguments],
            cwd=self.folder,
            env=environment,
            stdout=PIPE,
            stderr=PIPE,
            text=True,
            start_new_session=True,
        )

    def make(self, *goals: str) -> subprocess.CompletedProcess[str]:
        process = self.start(*goals)
        output, errors = process.communicate(timeout=600)
        return subprocess.CompletedProcess(goals, process.returncode, output, errors)

    def calls(self) -> int:
        """How often wrapit was called since the last look."""
        lines = self.log.read_text().splitlines() if self.log.exists() else []
        self.log.unlink(missing_ok=True)
        return len(lines)

    def builds(self, *goals: str) -> int:
        """How often wrapit was called by a make that does well."""
        self.calls()
        run = self.make(*goals)
        assert run.returncode == 0, run.stderr
        return self.calls()

    def files(self, name: str = "ring") -> dict[str, str]:
        """What is in a piece's folder: names and hashes."""
        return {
            path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in (self.build / name).iterdir()
        }
