"""What an installation must look like."""

from __future__ import annotations

import importlib.metadata
import itertools
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

ROOT = Path(__file__).parent.parent


def test_exactly_one_distribution_provides_the_kernel_bindings() -> None:
    owners = [
        distribution.metadata["Name"]
        for distribution in importlib.metadata.distributions()
        if any(
            str(path).startswith("OCP/") or str(path).startswith("OCP.") for path in distribution.files or ()
        )
    ]
    assert owners == ["cadquery-ocp"]


def test_the_lock_holds_every_dependency() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    wanted = [*project["dependencies"], *itertools.chain(*project["optional-dependencies"].values())]
    names = {canonicalize_name(Requirement(line).name) for line in wanted} - {"wrapit"}
    lock = (ROOT / "requirements.lock").read_text().splitlines()
    locked = {canonicalize_name(Requirement(line).name) for line in lock}
    assert names - locked == set()


@pytest.mark.usefixtures("recalling")
def test_examples_run(tmp_path: Path) -> None:
    examples = sorted((ROOT / "examples").glob("*.py"))
    assert examples
    for example in examples:
        # Of the gallery's pictures one is enough: the pieces themselves are built by other tests.
        names = ["butterfly"] if example.stem == "pictures" else []
        command = [sys.executable, str(example), str(tmp_path), *names]
        run = subprocess.run(command, capture_output=True, text=True, timeout=300, check=False, cwd=tmp_path)
        assert run.returncode == 0, run.stderr


def test_drawings_are_what_their_sources_render_to(tmp_path: Path) -> None:
    command = [sys.executable, str(ROOT / "examples" / "ink.py"), str(tmp_path)]
    subprocess.run(command, check=True, capture_output=True)
    rendered = sorted(tmp_path.glob("*.png"))
    assert len(rendered) >= 3
    for path in rendered:
        import numpy as np
        from PIL import Image

        fresh, kept = (np.asarray(Image.open(p), float) for p in (path, ROOT / "configs" / path.name))
        assert fresh.shape == kept.shape
        assert np.abs(fresh - kept).mean() < 0.1
