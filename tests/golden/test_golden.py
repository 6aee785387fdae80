"""Our pieces keep their numbers; and the comparison can fail."""

from __future__ import annotations

import copy
from collections.abc import Callable
from typing import Any

import pytest

from tests.conftest import CONFIGS
from tests.golden import differences, numbers, read
from wrapit.pipeline.build import Build

NAMES = sorted(path.stem for path in CONFIGS.glob("*.yaml"))


@pytest.mark.parametrize("name", NAMES)
def test_piece_keeps_its_numbers(piece: Callable[[str], Build], name: str) -> None:
    assert differences(read(name), numbers(piece(name).report)) == []


def _changed(document: dict[str, Any], *keys: str | int, to: Any) -> dict[str, Any]:
    changed = copy.deepcopy(document)
    inner: Any = changed
    for key in keys[:-1]:
        inner = inner[key]
    inner[keys[-1]] = to
    return changed


@pytest.mark.parametrize("name", NAMES)
def test_the_comparison_can_fail(name: str) -> None:
    golden = read(name)
    length = golden["drawing"]["length_mm"]
    assert differences(golden, golden) == []
    assert differences(golden, _changed(golden, "drawing", "length_mm", to=length * 1.001)) == []
    assert differences(golden, _changed(golden, "drawing", "length_mm", to=length * 1.01))
    assert differences(golden, _changed(golden, "drawing", "segments", to=golden["drawing"]["segments"] + 1))
    assert differences(golden, _changed(golden, "decomposition", "optimal", to=None))
    assert differences(golden, _changed(golden, "wires", to=golden["wires"][1:]))
    assert differences(golden, _changed(golden, "jig", "valid", to=False))
    assert differences(golden, _changed(golden, "findings", to=["tight-bend", "x"]))
