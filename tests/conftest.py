"""Shared by all tests: pieces built once per session, and how tests that drive other programs find them."""

from __future__ import annotations

import functools
import os
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path
from unittest import mock

import pytest
from hypothesis import settings
from hypothesis.internal.conjecture import providers

from tests.pipeline.kernel_here import KernelHere
from wrapit.pipeline import stages
from wrapit.pipeline.build import Build, build

# What tests build is built, whatever the user's cache holds; `piece` and the cache's tests have their own.
os.environ["WRAPIT_CACHE"] = "off"
# Hundreds of processes import wrapit: where its bytecode isn't kept each of them compiles it, in 0.2 s.
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)

CONFIGS = Path(__file__).parent.parent / "configs"

# All pieces are built and compared with their golden numbers. What takes a minute a piece (FreeCAD, the
# slicer, the kernel's booleans) is asked of these, which differ in kind: one wire, many, several jigs, a pair
# with a ring.
OPENED = ("bee", "butterfly", "dolphin", "earrings", "heart-knot", "leaf", "lotus", "mandala")


def constants_of_no_module() -> providers.Constants:
    return providers._local_constants


if os.environ.get("CI"):
    # Hypothesis draws from the numbers that stand in our sources too, in those that happen to be imported by
    # then: what a worker ran before would change its fixed cases, and so would any commit.
    mock.patch.object(providers, "_get_local_constants", constants_of_no_module).start()
settings.register_profile("wrapit", deadline=None, derandomize=bool(os.environ.get("CI")), print_blob=True)
settings.load_profile("wrapit")


@pytest.fixture(scope="session")
def shared_cache(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A cache for all workers of this session."""
    base = tmp_path_factory.getbasetemp()
    return (base.parent if "PYTEST_XDIST_WORKER" in os.environ else base) / "cache"


@pytest.fixture(scope="module")
def recalling(shared_cache: Path) -> Iterator[None]:
    """For tests that aren't about building: what any test of this session built before is recalled."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("WRAPIT_CACHE", str(shared_cache))
        yield


@pytest.fixture(scope="session")
def piece(shared_cache: Path, tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Build]:
    """Builds a config of ours, by name, once per session: what one worker built, others recall."""

    @functools.cache
    def built(name: str) -> Build:
        with pytest.MonkeyPatch.context() as patch:
            patch.setenv("WRAPIT_CACHE", str(shared_cache))
            return build(CONFIGS / f"{name}.yaml", tmp_path_factory.mktemp("pieces") / name)

    return built


@pytest.fixture(scope="module")
def kernel_here() -> Iterator[None]:
    """For whole builds that aren't about the kernel's process: 2 s less each, and the same files."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(stages, "Worker", KernelHere)
        yield


@pytest.fixture(scope="session")
def program() -> Callable[[str], str]:
    """Path of a program; where it is missing the test is skipped, or fails if clients are required."""

    def found(name: str) -> str:
        path = shutil.which(name)
        if path is None:
            reason = f"{name} is not installed"
            if os.environ.get("WRAPIT_REQUIRE_CLIENTS"):
                pytest.fail(reason)
            pytest.skip(reason)
        return path

    return found
