"""Every mistake in a config is one line with file, line, column, key and a remedy."""

from __future__ import annotations

import io
import json
from pathlib import Path

import pytest
from ruamel.yaml import YAML

from tests.conftest import CONFIGS
from wrapit.config import Config, load_config, lock_text, schema
from wrapit.errors import ConfigError

GOOD = "name: bee\ndrawing: bee.png\nsize: 40 mm\nwire:\n  gauge: 18 AWG\n  metal: copper\n"


def load(tmp_path: Path, text: str, *overrides: str) -> Config:
    path = tmp_path / "bee.yaml"
    path.write_text(text, encoding="utf-8")
    return load_config(path, overrides)


def test_units_become_millimetres(tmp_path: Path) -> None:
    config = load(tmp_path, GOOD.replace("40 mm", "1.5 in"))
    assert config.size == pytest.approx(38.1)
    assert config.wire.gauge == pytest.approx(1.024, abs=1e-3)


@pytest.mark.parametrize(
    ("text", "place", "problem", "remedy"),
    [
        (GOOD.replace("size: 40 mm", "size: 40"), ":3:1 size", "has no unit", "'40 mm'"),
        (GOOD.replace("40 mm", "40 furlong"), ":3:1 size", "unknown unit", "'40 mm'"),
        (GOOD.replace("40 mm", "-4 mm"), ":3:1 size", "-4 mm is out of range", "between 3 mm and 1000 mm"),
        (GOOD.replace("40 mm", "4 km"), ":3:1 size", "unknown unit", ""),
        (GOOD.replace("18 AWG", "18"), ":5:3 wire.gauge", "has no unit", "'18 AWG'"),
        (GOOD.replace("18 AWG", "swg17"), ":5:3 wire.gauge", "known SWG sizes", ""),
        (
            GOOD.replace("copper", "coper"),
            ":6:3 wire.metal",
            "'coper' is not one of",
            "did you mean 'copper'",
        ),
        (GOOD.replace("metal:", "metall:"), ":6:3 wire.metall", "unknown key", "did you mean 'metal'"),
        (GOOD.replace("size:", "sise:"), ":3:1 sise", "unknown key", "did you mean 'size'"),
        (GOOD + "jig: [1, 2]\n", ":7:1 jig", "a block of keys", "schema"),
        (GOOD + "bail: {diametre: 5 mm}\n", ":7:8 bail.diametre", "unknown key", "did you mean 'diameter'"),
        (GOOD + "bail: {at: bottom}\n", ":7:8 bail.at", "'bottom' is no place", ""),
        (GOOD + "bail: {at: [3, 4 mm]}\n", ":7:8 bail.at", "has no unit", ""),
        (GOOD + "decomposition: {seed: many}\n", ":7:17 decomposition.seed", "'many'", ""),
        (GOOD.replace("drawing: bee.png\n", ""), ":1:1 drawing", "missing", "add it"),
        (GOOD.replace("name: bee", "name: ../bee"), ":1:1 name", "can't be the name", "'bee'"),
        ("- a list\n", "bee.yaml", "not a block of keys", "drawing:"),
        ("name: [", ":", "not valid YAML", "quotes"),
        ("", "bee.yaml", "not a block of keys", ""),
        (GOOD + "size: 50 mm\n", ":7:1", "not valid YAML", ""),
    ],
)
def test_a_mistake_is_named_with_its_place(
    tmp_path: Path, text: str, place: str, problem: str, remedy: str
) -> None:
    with pytest.raises(ConfigError) as caught:
        load(tmp_path, text)
    line = str(caught.value)
    assert "\n" not in line
    assert place in line
    assert problem in line
    assert remedy in line
    assert caught.value.exit_code == 2


def test_set_overrides_the_file_and_names_itself(tmp_path: Path) -> None:
    assert load(tmp_path, GOOD, "wire.gauge=1.0 mm").wire.gauge == 1.0
    assert load(tmp_path, GOOD, "decomposition.weights.smoothness=0").decomposition.weights.smoothness == 0
    for wrong, problem in {
        "wire.gauge": "key=value",
        "=3": "key=value",
        "name.x=1": "no block",
        "wire.gauge=3": "no unit",
        "wire.guage=1 mm": "did you mean 'gauge'",
    }.items():
        with pytest.raises(ConfigError, match=problem) as caught:
            load(tmp_path, GOOD, wrong)
        assert f"--set {wrong}" in str(caught.value)


def test_missing_and_unreadable_files(tmp_path: Path) -> None:
    with pytest.raises(ConfigError, match="no such config"):
        load_config(tmp_path / "none.yaml")
    with pytest.raises(ConfigError, match="can't be read"):
        load_config(tmp_path)
    (tmp_path / "binary.yaml").write_bytes(b"\xff\xfe\x00\x81")
    with pytest.raises(ConfigError, match="can't be read"):
        load_config(tmp_path / "binary.yaml")


@pytest.mark.parametrize("path", sorted(CONFIGS.glob("*.yaml")), ids=lambda path: path.stem)
def test_the_locked_config_is_the_config(tmp_path: Path, path: Path) -> None:
    config = load_config(path)
    assert lock_text(load(tmp_path, lock_text(config))) == lock_text(config)


def test_lock_writes_every_default(tmp_path: Path) -> None:
    data = YAML(typ="safe").load(io.StringIO(lock_text(load(tmp_path, GOOD))))

    def missing(block: type, written: dict[str, object], path: str) -> list[str]:
        gaps = []
        for key, field in block.model_fields.items():
            inner = field.annotation
            if key not in written:
                gaps += [] if field.default is None else [path + key]
            elif isinstance(inner, type) and hasattr(inner, "model_fields"):
                gaps += missing(inner, written[key], f"{path}{key}.")
        return gaps

    assert missing(Config, data, "") == []


def test_schema_documents_every_key() -> None:
    document = json.loads(json.dumps(schema()))
    blocks = [document, *document["$defs"].values()]
    bare = [
        f"{block.get('title')}.{key}"
        for block in blocks
        for key, value in block.get("properties", {}).items()
        if "description" not in value and "$ref" not in json.dumps(value)
    ]
    assert bare == []
    assert document["additionalProperties"] is False


def test_the_schema_beside_our_configs_is_true() -> None:
    assert json.loads((CONFIGS / "schema.json").read_text(encoding="utf-8")) == schema()


def test_places_are_written_as_they_are_read(tmp_path: Path) -> None:
    for at, read in (("top", "top"), ("3", 3), ("[1 cm, -2 mm]", (10.0, -2.0))):
        config = load(tmp_path, GOOD + f"bail: {{at: {at}}}\n")
        assert config.bail is not None
        assert config.bail.at == read
        assert load(tmp_path, lock_text(config)).bail == config.bail
