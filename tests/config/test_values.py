"""What is said of a number out of range, of a list too long, of a search without end."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from pydantic import ValidationError

from tests.config.keys import every_key
from wrapit import units
from wrapit.config import Config, load_config, lock_text
from wrapit.config.decomposition import MOST_ITERATIONS, AnnealingConfig
from wrapit.config.quantities import length
from wrapit.errors import ConfigError


def load(tmp_path: Path, text: str) -> Config:
    path = tmp_path / "x.yaml"
    path.write_text(f"drawing: bee.png\n{text}\n", encoding="utf-8")
    return load_config(path)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("plate: {kerf: 40 mm}", ":2:9 plate.kerf: 40 mm is out of range; choose between 0 mm and 5 mm"),
        ("plate: {kerf: 1e300 mm}", ":2:9 plate.kerf: 1e300 mm is out of range; choose between 0 mm"),
        ("plate: {kerf: 1e999 mm}", ":2:9 plate.kerf: '1e999 mm' is not a finite number; write for"),
        ("plate: {kerf: 40}", ":2:9 plate.kerf: 40 has no unit; write for example '0.15 mm'"),
        ("plate: {kerf: 0.4}", ":2:9 plate.kerf: 0.4 has no unit; write for example '0.4 mm'"),
        ("wire: {gauge: 1}", ":2:8 wire.gauge: 1 has no unit; write for example '1 AWG' or '1 mm'"),
        ("wire: {gauge: 1.5}", ":2:8 wire.gauge: 1.5 has no unit; write for example '1.5 mm'"),
        ("tracing: {corner_angle: 1e300 deg}", ":2:11 tracing.corner_angle: 1e300 deg is out of range"),
        ("jig: {min_wall_area: .inf}", ":2:7 jig.min_wall_area: inf is not a finite number; choose"),
        ("jig: {min_wall_area: 1e999}", ":2:7 jig.min_wall_area: inf is not a finite number; choose"),
        ("jig: {min_wall_area: true}", ":2:7 jig.min_wall_area: true or false is not a number; choose"),
        ("jig: {min_wall_area: &a true}", ":2:7 jig.min_wall_area: true or false is not a number; choose"),
        ("plate: {kerf: 2001-13-45}", ":2:9 plate.kerf: '2001-13-45' is not a value with a unit; write"),
        ("plate: {kerf: '0,1,2 mm'}", ":2:9 plate.kerf: '0,1,2 mm' is not a value with a unit; write for"),
        ("plate: {kerf: '1,500 mm'}", ":2:9 plate.kerf: '1,500 mm' may mean thousands or decimals; write"),
        ("jig: {time_limit: 2 days}", ":2:7 jig.time_limit: unknown unit 'days'; use one of s, sec"),
        ("jig: {time_limit: 25 h}", ":2:7 jig.time_limit: 25 h is out of range; choose between 1 s and 24 h"),
        ("decomposition: {seed: 1.5}", ":2:17 decomposition.seed: 1.5 is not a whole number; choose"),
        ("decomposition: {seed: " + "9" * 90 + "}", "a number of endless digits is out of range; choose"),
        ("bail: {at: [3 m, 0 mm]}", ":2:8 bail.at: 3 m is out of range; choose between -2 m and 2 m"),
        ("bail: {at: -3}", ":2:8 bail.at: -3 is out of range; choose between 0 and 99999"),
        ("outputs: [step, step, step, step, stl, stl, stl, stl]", ":2:1 outputs: a list of 8 is too long"),
        ("decomposition: {constraints: [{same_wire: [1]}]}", "same_wire: a list of 1 is too short; give at"),
    ],
)  # fmt: skip
def test_a_range_is_told_with_its_place(tmp_path: Path, text: str, said: str) -> None:
    with pytest.raises(ConfigError) as caught:
        load(tmp_path, text)
    assert said in str(caught.value)


@pytest.mark.parametrize(
    ("key", "entry", "most"),
    [
        ("jig.seats", "{at: [0 mm, 0 mm], diameter: 3 mm}", 200),
        ("decomposition.constraints", "{cut_at: 1}", 1000),
        ("decomposition.annealing.operators", "join", 20),
        ("outputs", "stl", 7),
    ],
)
def test_lists_are_bounded(tmp_path: Path, key: str, entry: str, most: int) -> None:
    *blocks, last = key.split(".")

    def text(count: int) -> str:
        lines = [f"{'  ' * depth}{block}:" for depth, block in enumerate(blocks)]
        return "\n".join([*lines, f"{'  ' * len(blocks)}{last}: [{', '.join([entry] * count)}]"])

    load(tmp_path, text(most))
    with pytest.raises(ConfigError, match=f"a list of {most + 1} is too long; give at most {most}"):
        load(tmp_path, text(most + 1))


def test_time_is_read_in_seconds(tmp_path: Path) -> None:
    assert load(tmp_path, "").jig.time_limit is None
    for text, seconds in {"120 s": 120, "5 min": 300, "1.5 h": 5400, "24 h": 86_400}.items():
        config = load(tmp_path, f"jig: {{time_limit: {text}}}")
        assert config.jig.time_limit == seconds
        assert f"time_limit: {seconds} s" in lock_text(config)


@given(
    start=st.floats(1e-9, 1e9), end=st.floats(1e-12, 1e6), cooling=st.floats(-7, -0.005).map(lambda x: 10**x)
)
@example(start=100.0, end=1e-4, cooling=1e-7)
@example(start=1.0, end=1.0, cooling=0.5)
def test_a_schedule_ends_or_is_refused_with_a_remedy(start: float, end: float, cooling: float) -> None:
    schedule = {"temperature": start, "end_temperature": end, "cooling": cooling}
    iterations = math.log(end / start) / math.log1p(-cooling)
    said = refusal(schedule)
    if said is not None:
        if end >= start:
            assert "choose an end_temperature below temperature" in said
        else:
            assert iterations > MOST_ITERATIONS
            assert f"{iterations:.3g} iterations" in said
            remedy = float(said.split("a cooling of ")[1].split(maxsplit=1)[0])
            assert AnnealingConfig.model_validate(schedule | {"cooling": remedy}).cooling == remedy
    else:
        assert 0 < iterations <= MOST_ITERATIONS


def refusal(schedule: dict[str, float]) -> str | None:
    try:
        AnnealingConfig.model_validate(schedule)
    except ValidationError as error:
        return str(error.errors()[0]["ctx"]["error"])
    return None


@pytest.mark.parametrize(
    ("table", "read"),
    [
        (units.MM_PER, units.length_mm),
        (units.PER_MM, units.curvature_per_mm),
        (units.RADIANS_PER, units.angle_rad),
        (units.SECONDS_PER, units.duration_s),
    ],
)
def test_every_unit_that_is_offered_is_read(table: dict[str, float], read: Callable[[object], float]) -> None:
    for unit, factor in table.items():
        for text in (
            f"2.5 {unit}",
            f" 2.5 {unit.upper()} ",
            f"2.5{unit}" if unit[0] != "1" else f"2.5  {unit}",
        ):
            assert read(text) == pytest.approx(2.5 * factor), text


def test_an_example_out_of_range_is_the_programmers_mistake() -> None:
    with pytest.raises(ValueError, match="out of range"):
        length("0 mm", "1 mm", "40 mm")


@given(st.text())
def test_what_is_shown_is_short_and_printable(text: str) -> None:
    assert units.shown(text).isprintable()
    assert units.printable(text).isprintable()
    assert len(units.shortened(text, 10)) <= 10


@pytest.mark.parametrize("key", sorted(every_key(Config)))
def test_a_value_of_another_kind_is_told_in_plain_words(tmp_path: Path, key: str) -> None:
    config = tmp_path / "bee.yaml"
    config.write_text("drawing: bee.png\n")
    values = ("null", "x", "1.5", "true", "[]", "[[1]]", "{a: b}", ".nan", "[{}]", "9e99", '""')
    told = [problem for value in values if (problem := refused(config, f"{key}={value}"))]
    assert told
    for problem in told:
        assert not re.search(r"\b(Input|input|instance|tuple|dict\w*|\w+Config|parse|None)\b", problem)


def refused(config: Path, override: str) -> str | None:
    try:
        load_config(config, [override])
    except ConfigError as error:
        return str(error)
    return None
