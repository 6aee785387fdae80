"""`decomposition.choice` takes what `alternatives` lists, and says how good that is."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Literal

import pytest

from tests.conftest import CONFIGS
from wrapit.config import Config, load_config
from wrapit.config.decomposition import MOST_CHOICES, ConstraintConfig
from wrapit.decomposition.stage import alternatives, decompose
from wrapit.drawing.model import Drawing
from wrapit.drawing.stage import trace
from wrapit.errors import ConfigError
from wrapit.face import build

ROOT = Path(__file__).parent.parent.parent


def traced(name: str) -> tuple[Drawing, Config]:
    config = load_config(CONFIGS / f"{name}.yaml")
    drawing, _ = trace(CONFIGS / config.drawing, config.tracing, config.size)
    return drawing, config


def choose(config: Config, number: int, solver: Literal["exact", "annealing"] = "exact") -> Config:
    changed = config.decomposition.model_copy(update={"choice": number, "solver": solver})
    return config.model_copy(update={"decomposition": changed})


@pytest.mark.parametrize("name", ["leaf", "butterfly"])
@pytest.mark.parametrize("solver", ["exact", "annealing"])
def test_the_choice_is_what_alternatives_list(name: str, solver: Literal["exact", "annealing"]) -> None:
    drawing, config = traced(name)
    listed = alternatives(drawing, config.decomposition, 5)
    assert len({each.decomposition.mate for each in listed}) == 5
    for number, expected in enumerate(listed[1:], start=2):
        solution, _ = decompose(drawing, choose(config, number, solver).decomposition)
        assert solution.decomposition.mate == expected.decomposition.mate
        assert solution.energy == expected.energy
        assert solution.lower_bound == listed[0].lower_bound
        assert solution.optimal == (expected.energy.total <= listed[0].energy.total + 1e-9)
    assert not decompose(drawing, choose(config, 5).decomposition)[0].optimal
    assert decompose(drawing, choose(config, 1).decomposition)[0].optimal


def test_one_too_many_says_how_many_there_are(tmp_path: Path) -> None:
    (tmp_path / "y.json").write_text(
        '{"format": "wrapit-drawing/1", "unit": "mm", "junctions": [[0, 0], [20, 0], [-10, 20], [-10, -20]],'
        ' "segments": [{"start": 0, "end": 1, "kind": "stroke",'
        ' "beziers": [[[0, 0], [7, 0], [9, 0], [20, 0]]]},'
        ' {"start": 0, "end": 2, "kind": "stroke", "beziers": [[[0, 0], [-3, 7], [-7, 14], [-10, 20]]]},'
        ' {"start": 0, "end": 3, "kind": "stroke", "beziers": [[[0, 0], [-3, -7], [-7, -14], [-10, -20]]]}]}'
    )
    drawing, _ = trace(tmp_path / "y.json", Config(drawing="y.json").tracing, None)
    config = Config(drawing="y.json")
    there_are = len(alternatives(drawing, config.decomposition, MOST_CHOICES))
    assert 1 < there_are < MOST_CHOICES
    decompose(drawing, choose(config, there_are).decomposition)
    for number in (there_are + 1, 999):
        with pytest.raises(ConfigError) as caught:
            decompose(drawing, choose(config, number).decomposition)
        assert caught.value.where == "decomposition.choice"
        assert f"has {there_are}" in caught.value.problem
        assert caught.value.remedy == f"choose between 1 and {there_are}"


def test_many_are_not_all_looked_for() -> None:
    drawing, config = traced("leaf")
    with pytest.raises(ConfigError, match=f"choose between 1 and {MOST_CHOICES}$"):
        decompose(drawing, choose(config, 1000).decomposition)


def test_constraints_hold_for_every_choice() -> None:
    drawing, config = traced("leaf")
    wish = ConstraintConfig(different_wire=(0, 1))
    wished = choose(config, 3).decomposition.model_copy(update={"constraints": (wish,)})
    solution, _ = decompose(drawing, wished)
    for trail in solution.trails:
        assert not {0, 1} <= {traversal.segment for traversal in trail.traversals}


def test_the_table_names_every_constraint_as_the_schema_does() -> None:
    rows = re.findall(r"\| `(\w+): (.+?)` \|", (ROOT / "README.md").read_text(encoding="utf-8"))
    told = dict(rows)
    for name, field in ConstraintConfig.model_fields.items():
        assert field.examples, name
        if name != "at":
            assert told[name] == str(field.examples[0]), name


def test_a_choice_is_part_of_a_build(tmp_path: Path) -> None:
    config = CONFIGS / "leaf.yaml"
    best = build(config, tmp_path / "out", until="decomposition", alternatives=3).report
    second = build(config, tmp_path / "out", ["decomposition.choice=3"], until="decomposition").report
    assert best["decomposition"]["optimal"]
    assert second["decomposition"]["energy"]["total"] >= best["decomposition"]["energy"]["total"]
    assert second["decomposition"]["lower_bound"] == best["decomposition"]["lower_bound"]
    assert second["config_sha256"] != best["config_sha256"]
