"""Shared by all tests: pieces built once per session, and how tests that drive other programs find them."""

from __future__ import annotations

import functools
import os
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import settings

from wrapit.pipeline.build import Build, build

# What tests build is built, whatever the user's cache holds; the tests of the cache have one of their own.
os.environ["WRAPIT_CACHE"] = "off"

CONFIGS = Path(__file__).parent.parent / "configs"

settings.register_profile("wrapit", deadline=None, derandomize=bool(os.environ.get("CI")), print_blob=True)
settings.load_profile("wrapit")


@pytest.fixture(scope="session")
def piece(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Build]:
    """Builds a config of ours, by name, once per session."""

    @functools.cache
    def built(name: str) -> Build:
        return build(CONFIGS / f"{name}.yaml", tmp_path_factory.mktemp("pieces") / name)

    return built


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
