"""A cache of each test's own, and what builds made anew."""

from __future__ import annotations

from pathlib import Path

import pytest

from wrapit.pipeline.work import Work


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder with the entries."""
    monkeypatch.setenv("WRAPIT_CACHE", str(tmp_path / "cache"))
    return tmp_path / "cache" / "stages"


@pytest.fixture
def anew(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Names of the steps that were made, not recalled, in the order of their making."""
    named, made = {}, []
    key, keep = Work.key, Work.keep

    def naming(work: Work, step: str, *also: object, upon: object = ()) -> str:
        name = key(work, step, *also, upon=upon)  # type: ignore[arg-type]
        named[name] = step
        return name

    def noting(work: Work, name: str, *given: object) -> object:
        made.append(named[name])
        return keep(work, name, *given)  # type: ignore[arg-type]

    monkeypatch.setattr(Work, "key", naming)
    monkeypatch.setattr(Work, "keep", noting)
    return made
