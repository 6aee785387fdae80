"""Every number of the config has a sane range: nonsense is refused with place and remedy."""

from __future__ import annotations

import json
import math
import re
from pathlib import Path
from typing import Any

import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from pydantic import ValidationError

from tests.config.keys import Key, numeric_keys, ranges
from tests.config.nonsense import NUMBERS, OTHERS, SPELLED, TEXTS
from wrapit.config import Config, load_config, schema
from wrapit.config.block import Block
from wrapit.config.ranges import NumberRange, QuantityRange
from wrapit.errors import ConfigError

KEYS = list(numeric_keys())
QUANTITIES = [key for key in KEYS if isinstance(key.mark, QuantityRange)]
MOST_OF_ALL = 1e10
"""No bound is greater, in any unit of the program, but that of the random seed."""


def block_of(key: Key) -> tuple[type[Block], tuple[str | int, ...]]:
    """The model that holds the key itself, and the way to the key within it."""
    model: Any = Config
    names = key.dotted.split(".")
    for name in names[:-1]:
        kinds = [model.model_fields[name].annotation]
        while not (isinstance(kinds[0], type) and issubclass(kinds[0], Block)):
            kinds = [*getattr(kinds[0], "__args__", ()), *kinds[1:]]
        model = kinds[0]
    return model, key.wraps[key.wraps.index(names[-1], len(names) - 1) :]


def leaves(value: object) -> list[object]:
    return [leaf for each in value for leaf in leaves(each)] if isinstance(value, list | tuple) else [value]


def within(key: Key, value: object) -> bool:
    """Whether what was read lies in a declared range."""
    return (
        value == "top"
        or value is None
        or any(
            isinstance(value, int | float)
            and not isinstance(value, bool)
            and each.at_least <= value <= each.at_most
            and math.copysign(1, value or 1.0) == math.copysign(1, value)
            for each in ranges(key.mark)
        )
    )


def verdict(key: Key, value: object) -> bool:
    """Whether a value is refused; fails where it is taken wrongly, or refused unclearly."""
    model, way = block_of(key)
    made = read(model, Key(key.dotted, key.mark, way).nested(value) | _needed(model, str(way[0])))
    if isinstance(made, ValidationError):
        mistake = made.errors(include_url=False)[0]
        assert mistake["loc"][:1] == (way[0],) or not mistake["loc"], (key.dotted, mistake)
        if mistake["type"] == "value_error":
            problem, _, remedy = str(mistake["ctx"]["error"]).partition("; ")
            assert problem, (key.dotted, value)
            assert remedy, (key.dotted, value, problem)
            assert len(problem) < 200, (key.dotted, problem)
        return True
    for leaf in leaves(getattr(made, str(way[0]))):
        assert within(key, leaf), (key.dotted, value, leaf)
    return False


def read(model: type[Block], data: dict[str, Any]) -> Block | ValidationError:
    try:
        return model.model_validate(data)
    except ValidationError as error:
        return error


def attempt(tmp_path: Path, text: str) -> Config | ConfigError:
    """The config of a file with this text as its second line, or why it is refused."""
    path = tmp_path / "x.yaml"
    path.write_text(f"drawing: bee.png\n{text}\n", encoding="utf-8")
    try:
        return load_config(path)
    except ConfigError as error:
        return error


def _needed(model: type[Block], but: str) -> dict[str, Any]:
    given = {"drawing": "bee.png", "at": ["1 mm", "1 mm"], "diameter": "5 mm"}
    return {
        name: given[name] for name, field in model.model_fields.items() if field.is_required() and name != but
    }


def test_every_number_has_a_finite_range() -> None:
    assert len(KEYS) > 60
    for key in KEYS:
        found = ranges(key.mark)
        assert found, f"{key.dotted} has no range: give it one of config/quantities.py"
        for each in found:
            assert math.isfinite(each.at_least), key.dotted
            assert math.isfinite(each.at_most), key.dotted
            assert each.at_least < each.at_most, key.dotted
            assert each.at_most <= MOST_OF_ALL or key.dotted == "decomposition.seed", key.dotted


def test_the_test_above_finds_a_number_without_range() -> None:
    class Careless(Block):
        kerf: float = 0.15
        many: tuple[int, ...] | None = None

    assert [(key.dotted, ranges(key.mark)) for key in numeric_keys(Careless)] == [("kerf", []), ("many", [])]


def test_the_schema_says_every_range() -> None:
    """Also of the keys that the models' walk might miss: each number and each text with an example."""

    def numbers(value: object, path: str) -> list[tuple[str, dict[str, Any]]]:
        if isinstance(value, list):
            return [each for index, item in enumerate(value) for each in numbers(item, f"{path}/{index}")]
        if not isinstance(value, dict):
            return []
        own = [(path, value)] if value.get("type") in ("number", "integer") or "x-minimum" in value else []
        return own + [each for key, item in value.items() for each in numbers(item, f"{path}/{key}")]

    found = numbers(json.loads(json.dumps(schema())), "")
    assert len(found) >= len(KEYS)
    for path, value in found:
        assert {"minimum", "maximum"} <= set(value) or {"x-minimum", "x-maximum"} <= set(value), path
    plate = schema()["$defs"]["PlateConfig"]["properties"]["kerf"]
    assert plate["description"].endswith("Between 0 mm and 5 mm.")
    assert plate["default"] == "0.15 mm"


@pytest.mark.parametrize("key", KEYS, ids=[key.dotted for key in KEYS])
def test_defaults_examples_and_bounds_are_within(key: Key) -> None:
    model, way = block_of(key)
    default = model.model_fields[str(way[0])].get_default()
    if default not in (None, ()) and not model.model_fields[str(way[0])].is_required():
        assert all(within(key, leaf) for leaf in leaves(default))
    for each in ranges(key.mark):
        texts = (
            (*each.texts, each.example) if isinstance(each, QuantityRange) else (each.at_least, each.at_most)
        )
        for text in texts:
            assert each.at_least <= each.check(text) <= each.at_most
            assert each.check(each.write(each.check(text))) == pytest.approx(each.check(text), rel=1e-8)


@pytest.mark.parametrize("key", KEYS, ids=[key.dotted for key in KEYS])
def test_nonsense_is_refused_clearly(key: Key) -> None:
    values = (*NUMBERS, *TEXTS, *OTHERS)
    refused = [value for value in values if verdict(key, value)]
    assert len(refused) > 0.75 * len(values)
    for bound in ranges(key.mark):
        if isinstance(bound, NumberRange):
            step = 1 if bound.type == "integer" else 1e-6
            assert verdict(key, bound.at_least - step)
            assert verdict(key, bound.at_most + max(step, 1e-6 * bound.at_most))


@given(
    key=st.sampled_from(KEYS),
    number=st.floats() | st.integers() | st.text(alphabet="0123456789.eE+-_ ", max_size=12),
    unit=st.sampled_from(
        ["", "mm", "m", "um", "in", "/mm", "1/m", "deg", "°", "rad", "s", "h", "AWG", "swg"]
    ),
)
@example(key=KEYS[0], number=10**5000, unit="")
@example(key=KEYS[0], number=math.nan, unit="mm")
def test_any_number_with_any_unit_is_within_or_refused(key: Key, number: object, unit: str) -> None:
    verdict(key, number)
    if not isinstance(number, int) or abs(number) < 10**4000:
        verdict(key, f"{number} {unit}")


@given(
    key=st.sampled_from(KEYS),
    value=st.recursive(
        st.none() | st.booleans() | st.text(max_size=20) | st.binary(max_size=5) | st.dates(),
        lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=5), inner, max_size=3),
    ),
)
def test_anything_at_all_is_within_or_refused(key: Key, value: object) -> None:
    verdict(key, value)


@given(
    key=st.sampled_from([key for key in KEYS if isinstance(key.mark, QuantityRange)]), part=st.floats(0, 1)
)
def test_what_is_written_is_read_again(key: Key, part: float) -> None:
    assert isinstance(key.mark, QuantityRange)
    value = key.mark.at_least + part * (key.mark.at_most - key.mark.at_least)
    assert key.mark.check(key.mark.write(value)) == pytest.approx(value, rel=1e-6, abs=1e-8)


@pytest.mark.parametrize("key", KEYS, ids=[key.dotted for key in KEYS])
def test_nonsense_in_a_file_is_refused_in_one_line(tmp_path: Path, key: Key) -> None:
    """As the maker meets it: file, line, column and key, what is wrong, and a remedy."""
    model, way = block_of(key)
    needed = {} if model is Config else _needed(model, str(way[0]))
    beside = "".join(f", {name}: {value}".replace("'", "") for name, value in needed.items())
    refused = 0
    for spelled in SPELLED:
        block = str(key.nested("VALUE"))[1:-1].replace("'", "")
        text = block.replace("VALUE", f"{spelled}{beside}")
        made = attempt(tmp_path, text)
        if isinstance(made, ConfigError):
            refused += 1
            assert made.problem, (key.dotted, spelled)
            assert made.remedy, (key.dotted, spelled, made.problem)
            assert re.match(rf"{re.escape(str(tmp_path))}/x.yaml:2:\d+", made.where), (spelled, made.where)
            assert len(str(made)) < 400 + len(made.where), (key.dotted, spelled, str(made))
            assert "ValueError" not in str(made)
        else:
            value: Any = made
            for step in key.wraps:
                value = getattr(value, step) if isinstance(step, str) else value[0] if value else None
            assert all(within(key, leaf) for leaf in leaves(value)), (key.dotted, spelled)
    assert refused > 0.6 * len(SPELLED)
