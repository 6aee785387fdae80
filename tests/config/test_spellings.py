"""Quantities and choices as crafters write them: each spelling is read as what it means, or refused."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterator
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import BaseModel, ValidationError

from wrapit.config import Config, load_config, schema
from wrapit.config.choices import choices, folded
from wrapit.errors import ConfigError
from wrapit.units import SWG_MM, awg_diameter_mm, gauge_diameter_mm, length_mm

AMERICAN = (
    "{} AWG", "{}awg", "{} ga", "{}ga", "{}ga.", "{} Gauge", "{}-gauge", "{} gage", "#{}", "# {}", "No. {}",
    "awg {}", "AWG-{}", "awg#{}", "Gauge {}", "{} AWG gauge", "{}g", "{} B&S",
)  # fmt: skip
BRITISH = ("swg{}", "SWG {}", "{} swg", "{}swg", "{} gauge SWG", "swg #{}")
INCHES = ("{} in", "{}in", "{} inch", "{} Inches", '{}"', "{}''", "{}″", "{} in.", "{}-inch")
VULGAR = {
    "½": Fraction(1, 2),
    "¼": Fraction(1, 4),
    "¾": Fraction(3, 4),
    "⅛": Fraction(1, 8),
    "⅝": Fraction(5, 8),
}
MILLIMETRES = {
    "mm": 1, "millimeter": 1, "Millimetres": 1, "cm": 10, "centimeters": 10, "Centimetre": 10, "m": 1000,
    "metre": 1000, "Meters": 1000, "micron": 1e-3, "ft": 304.8, "feet": 304.8, "foot": 304.8, "'": 304.8,
}  # fmt: skip


@pytest.mark.parametrize("spelled", AMERICAN)
@given(gauge=st.integers(0, 40), padding=st.sampled_from(["", " ", "  "]))
def test_an_american_gauge(spelled: str, gauge: int, padding: str) -> None:
    text = f"{padding}{spelled.format(gauge)}{padding}"
    assert gauge_diameter_mm(text) == gauge_diameter_mm(text.upper()) == awg_diameter_mm(gauge)


@pytest.mark.parametrize("spelled", BRITISH)
@pytest.mark.parametrize("gauge", SWG_MM)
def test_a_british_gauge(spelled: str, gauge: int) -> None:
    assert gauge_diameter_mm(spelled.format(gauge)) == SWG_MM[gauge]


@pytest.mark.parametrize(
    "text",
    [
        "18.5 ga",
        "2/0 AWG",
        "-18 ga",
        "18 20 ga",
        "18/20 gauge",
        "ga",
        "#",
        "99 ga",
        "00 AWG",
        "000ga",
        "18 AWG SWG",
        "½ ga",
    ],
)
def test_what_is_no_gauge_is_refused_with_one_that_is(text: str) -> None:
    with pytest.raises(ValueError, match="; write ") as caught:
        gauge_diameter_mm(text)
    for remedy in re.findall(r"'([^']+)'", str(caught.value).partition("; ")[2]):
        assert gauge_diameter_mm(remedy) > 0


@given(
    whole=st.integers(0, 40),
    part=st.integers(1, 63),
    of=st.sampled_from([2, 3, 4, 8, 16, 32, 64]),
    joint=st.sampled_from([" ", "-", "  ", " - "]),
    spelled=st.sampled_from(INCHES[:-1]),
)
def test_fractions_of_inches(whole: int, part: int, of: int, joint: str, spelled: str) -> None:
    value = 25.4 * (whole + part / of)
    assert length_mm(spelled.format(f"{whole}{joint}{part}/{of}")) == pytest.approx(value)
    assert length_mm(spelled.format(f"{part} / {of}")) == pytest.approx(25.4 * part / of)
    assert length_mm("-" + spelled.format(f"{whole} {part}⁄{of}")) == pytest.approx(-value)


@given(whole=st.integers(0, 40), vulgar=st.sampled_from(sorted(VULGAR)), spelled=st.sampled_from(INCHES[:-1]))
def test_fractions_of_one_letter(whole: int, vulgar: str, spelled: str) -> None:
    assert length_mm(spelled.format(f"{whole}{vulgar}")) == pytest.approx(
        25.4 * float(whole + VULGAR[vulgar])
    )
    assert length_mm(spelled.format(vulgar)) == pytest.approx(25.4 * float(VULGAR[vulgar]))


@given(
    value=st.decimals(0, 900, places=2),
    unit=st.sampled_from(sorted(MILLIMETRES)),
    space=st.sampled_from(["", " "]),
)
def test_decimals_with_a_comma_or_a_point_and_units_in_full(value: Any, unit: str, space: str) -> None:
    expected = pytest.approx(float(value) * MILLIMETRES[unit], abs=1e-8)
    assert length_mm(f"{value}{space}{unit}") == expected
    assert length_mm(f"{value}".replace(".", ",") + space + unit) == expected


@given(thousands=st.integers(1, 999), rest=st.integers(0, 999))
def test_a_comma_that_may_part_thousands_is_refused_with_both_readings(thousands: int, rest: int) -> None:
    text = f"{thousands},{rest:03} mm"
    with pytest.raises(ValueError, match="may mean thousands or decimals") as caught:
        length_mm(text)
    point, none = re.findall(r"'([^']+)'", str(caught.value).partition("; ")[2])
    assert length_mm(point) == pytest.approx(thousands + rest / 1000)
    assert length_mm(none) == 1000 * thousands + rest
    assert length_mm(f"0,{rest:03} mm") == pytest.approx(rest / 1000)  # which no thousand is


@pytest.mark.parametrize(
    "text", ["1.500,5 mm", "1,500.5 mm", "1,234,567 mm", "1,5,5 mm", "1/0 in", "1/ in", "1//2 in", "/2 in"]
)
def test_no_number_is_refused(text: str) -> None:
    with pytest.raises(ValueError, match=r"; .*for example '40 mm'"):
        length_mm(text)


@given(st.text(alphabet="0123456789,./ -+½'\"#agwsmin", max_size=14))
def test_any_text_is_read_or_refused_in_plain_words(text: str) -> None:
    for read in (length_mm, gauge_diameter_mm):
        outcome = outcome_of(read, text)
        assert "; " in outcome if isinstance(outcome, str) else abs(outcome) < 1e20


def outcome_of(read: Callable[[object], float], text: str) -> float | str:
    try:
        return read(text)
    except ValueError as error:
        return str(error)


def chosen(model: type[BaseModel], way: tuple[str, ...] = ()) -> Iterator[tuple[tuple[str, ...], str, bool]]:
    """Each choice of each block: the way to its key, its word, and whether a list holds it."""
    from typing import get_args

    for name, field in model.model_fields.items():
        for word in choices(field.annotation):
            yield (*way, name), word, "tuple" in str(field.annotation) and name != "at"
        for kind in (field.annotation, *get_args(field.annotation)):
            if isinstance(kind, type) and issubclass(kind, BaseModel):
                yield from chosen(kind, (*way, name))


CHOICES = sorted(set(chosen(Config)))


def described(way: tuple[str, ...]) -> dict[str, Any]:
    """What the schema says of a key."""
    document = json.loads(json.dumps(schema()))
    inner = document
    for name in way:
        inner = inner["properties"][name]
        found = re.findall(r"#/\$defs/(\w+)", json.dumps(inner))
        inner = document["$defs"][found[0]] if found else inner
    return inner.get("items", inner)


def takes(description: dict[str, Any], word: str) -> bool:
    """Whether the schema takes a word: a small part of JSON schema, for our own."""
    if "anyOf" in description:
        return any(takes(each, word) for each in description["anyOf"])
    if description.get("type") not in (None, "string"):
        return False
    return (
        word in description.get("enum", [word])
        and re.search(description.get("pattern", ""), word) is not None
        and (description.get("const", word) == word)
    )


def read(way: tuple[str, ...], listed: bool, word: str) -> object:
    data: Any = [word] if listed else word
    for name in reversed(way):
        data = {name: data}
    if way[-1] == "operators":
        data["decomposition"]["annealing"]["operators"].append("join")
    try:
        value: Any = Config.model_validate({"drawing": "bee.png", **data})
    except ValidationError:
        return None
    for name in way:
        value = getattr(value, name)
    return value[0] if listed else value


def test_there_are_choices_of_many_keys() -> None:
    assert len({way for way, _, _ in CHOICES}) > 18


@given(choice=st.sampled_from(CHOICES), data=st.data())
def test_a_choice_is_taken_in_any_spelling_by_loader_and_schema(choice: Any, data: st.DataObject) -> None:
    way, word, listed = choice
    parts = re.split("[ _-]", word)
    joint = data.draw(st.sampled_from([" ", "-", "_", "", "  "]))
    cased = [data.draw(st.sampled_from([str.upper, str.lower, str.title]))(part) for part in parts]
    text = joint.join(cased)
    assert folded(text) == folded(word)
    assert read(way, listed, text) == word
    assert takes(described(way), text), (way, text)


@given(choice=st.sampled_from(CHOICES), text=st.text(alphabet="abcdefSTLMm3 -_.", max_size=8))
def test_loader_and_schema_refuse_the_same_words(choice: Any, text: str) -> None:
    way, _, listed = choice
    assert (read(way, listed, text) is not None) == takes(described(way), text), (way, text)


def test_a_config_as_a_crafter_writes_it(tmp_path: Path) -> None:
    path = tmp_path / "bee.yaml"
    path.write_text(
        "drawing: bee.png\nsize: 1 1/2 inches\n"
        "wire: {gauge: 20 gauge, metal: Sterling Silver, temper: Half-Hard}\n"
        "jig: {clearance: '0,2 mm', support: Turns, split: PER_WIRE}\njigs: [Printed]\noutputs: [STL, 3MF]\n"
        'bail: {at: Top, diameter: 1/4"}\nguide: {paper: a4, margin: 2 in}\n'
    )
    config = load_config(path)
    assert config.size == pytest.approx(38.1)
    assert config.wire.gauge == pytest.approx(awg_diameter_mm(20))
    assert (config.wire.metal, config.wire.temper) == ("sterling silver", "half hard")
    assert (config.jig.clearance, config.jig.support, config.jig.split) == (0.2, "turns", "per-wire")
    assert (config.jigs, config.outputs, config.guide.paper) == (("printed",), ("stl", "3mf"), "A4")
    assert config.bail is not None
    assert (config.bail.at, config.bail.diameter) == ("top", pytest.approx(6.35))


@pytest.mark.parametrize(
    ("key", "said", "meant"),
    [
        ("fit", "off", "off"),
        ("fit", "false", "off"),
        ("fit", "Bold", "bold"),
        ("beads", "false", "never"),
        ("beads", "true", "auto"),
    ],
)
def test_switches_of_fit(tmp_path: Path, key: str, said: str, meant: str) -> None:
    config = tmp_path / "x.yaml"
    config.write_text(f"drawing: x.svg\n{key}: {said}\n")
    assert getattr(load_config(config), key) == meant
    assert getattr(load_config(config, [f"{key}={said}"]), key) == meant


def test_fit_says_how_much(tmp_path: Path) -> None:
    config = tmp_path / "x.yaml"
    config.write_text("drawing: x.svg\nfit: true\n")
    with pytest.raises(ConfigError) as refusal:
        load_config(config)
    assert re.search(r"x\.yaml:2:1 fit: .*gentle or bold", str(refusal.value))
