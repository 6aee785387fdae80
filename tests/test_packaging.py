"""What an installation must look like."""

from __future__ import annotations

import functools
import importlib.metadata
import itertools
import subprocess
import sys
import tomllib
from collections.abc import Callable
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


@pytest.fixture(scope="module")
def ran(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Path]:
    """Runs an example, by its name, once; returns the folder that it wrote to."""

    @functools.cache
    def run(name: str) -> Path:
        folder = tmp_path_factory.mktemp(name)
        # Of the gallery's pictures one is enough: the pieces themselves are built by other tests.
        names = ["butterfly"] if name == "pictures" else []
        command = [sys.executable, str(ROOT / "examples" / f"{name}.py"), str(folder), *names]
        told = subprocess.run(command, capture_output=True, text=True, timeout=300, check=False, cwd=folder)
        assert told.returncode == 0, told.stderr
        return folder

    return run


@pytest.mark.usefixtures("recalling")
def test_examples_run(ran: Callable[[str], Path]) -> None:
    examples = sorted((ROOT / "examples").glob("*.py"))
    assert examples
    for example in examples:
        ran(example.stem)


def test_drawings_are_what_their_sources_render_to(ran: Callable[[str], Path]) -> None:
    rendered = sorted(ran("ink").glob("*.png"))
    assert len(rendered) >= 3
    for path in rendered:
        import numpy as np
        from PIL import Image

        fresh, kept = (np.asarray(Image.open(p), float) for p in (path, ROOT / "configs" / path.name))
        assert fresh.shape == kept.shape
        assert np.abs(fresh - kept).mean() < 0.1
