"""What the page offers: each control is of a key that there is, each button is taken by the config."""

from __future__ import annotations

import json
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pydantic import ValidationError

from wrapit.config import Config
from wrapit.config.loading import config_without_drawing
from wrapit.errors import ConfigError
from wrapit.studio.controls import CONTROLS, constraint_entries, controls, field_at, from_page, numbers_at
from wrapit.studio.fixes import fixes
from wrapit.studio.text.editing import Change, edited
from wrapit.studio.text.history import History
from wrapit.studio.text.values import finite, with_value, without_value

DATA: dict[str, Any] = {"drawing": "bee.png", "size": "40 mm"}
# What YAML can say at a key.
SCALARS = st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=8)
VALUES = st.recursive(
    SCALARS,
    lambda inner: (
        st.lists(inner, max_size=3) | st.dictionaries(st.text("abc", min_size=1), inner, max_size=2)
    ),
    max_leaves=6,
)
# Keys that a later config may have; the page offers them as soon as it does.
COMING = {"decomposition.choice"}


def applied(change: dict[str, Any], data: dict[str, Any]) -> Config:
    for key in change.get("unset", ()):
        data = without_value(data, key)
    for key, value in change["set"].items():
        data = with_value(data, key, value)
    return Config.model_validate(data)


def test_every_control_is_of_a_key_of_the_config() -> None:
    keys = {f"{block}.{name}" if block else name for _, block, name, _ in CONTROLS}
    assert {key for key in keys if field_at(key) is None} <= COMING
    shown = controls(DATA)
    assert len(shown) == len({each["key"] for each in shown}) >= len(keys - COMING)
    assert [each["key"] for each in shown if not each["help"]] == []


@pytest.mark.parametrize("control", controls({}), ids=lambda control: control["key"])
def test_what_a_control_offers_is_taken(control: dict[str, Any]) -> None:
    key, kind = control["key"], control["kind"]
    offers: list[Any] = [control["default"]]
    if kind == "choice":
        offers += control["choices"]
    elif kind == "choices":
        offers += [[choice] for choice in control["choices"]]
    elif kind == "switch":
        offers += [True, False]
    elif kind == "number":
        offers += [control["min"], control["max"]]
    elif "min" in control:
        offers += [control["min"], control["max"], control["example"]]
    else:
        offers += ["top", "3", "[12 mm, 30 mm]"]
    assert len(offers) > 1
    for offer in offers:
        value = from_page(key, offer)
        if value is not None:
            applied({"set": {key: value}}, DATA)


def test_a_default_is_the_config_s() -> None:
    config = config_without_drawing()
    for control in controls({}):
        if control["default"] is None or control["key"].startswith("bail"):
            continue
        value: Any = applied({"set": {control["key"]: control["default"]}}, {"drawing": "none"})
        wanted: Any = config
        for name in control["key"].split("."):
            value, wanted = getattr(value, name), getattr(wanted, name)
        assert value == pytest.approx(wanted) if isinstance(wanted, float) else value == wanted
        assert control["value"] == control["default"]
        assert not control["given"]


def test_values_are_as_the_text_writes_them() -> None:
    data = {"drawing": "a.png", "wire": {"gauge": "swg18"}, "bail": {"at": ["1 cm", "2 cm"]}}
    shown = {each["key"]: each for each in controls(data)}
    assert shown["wire.gauge"]["value"] == "swg18"
    assert shown["wire.gauge"]["given"]
    assert shown["bail"]["value"] is True
    assert shown["bail.at"]["value"] == "[1 cm, 2 cm]"
    assert from_page("bail.at", "[1 cm, 2 cm]") == ["1 cm", "2 cm"]
    assert from_page("bail", True) == {}
    assert from_page("bail", False) is None
    assert from_page("size", "") is None


def test_a_constraint_of_each_kind_has_a_sentence() -> None:
    listed = [
        {"same_wire": [3, 7, 8]},
        {"different_wire": [1, 2]},
        {"through": [1, 2], "at": 5},
        {"not_through": [1, 2]},
        {"start_at": 4},
        {"cut_at": 4},
        {"max_wire_length": "30 cm"},
    ]
    entries = constraint_entries({"decomposition": {"constraints": listed}})
    assert [each["constraint"] for each in entries] == listed
    assert [each["index"] for each in entries] == list(range(7))
    assert all(" " in each["text"] and ":" not in each["text"] for each in entries)


@pytest.mark.parametrize(
    ("remedy", "changes"),
    [
        ("with size: 70 mm they would hold 80%", [{"size": "70 mm"}]),
        (
            "with size: 71 mm they would hold 31% or with wire.gauge: 22 AWG they would hold 35%",
            [{"size": "71 mm"}, {"wire.gauge": "22 AWG"}],
        ),
        ("make the piece larger, or set jig.split to per-wire", [{"jig.split": "per-wire"}, "size", "size"]),
        ("make the piece larger, or use thinner or softer wire", ["size", "size", {"wire.gauge": "20 AWG"}]),
        (
            "make the piece larger, take thinner wire, or leave sheet out of `jigs`",
            ["size", "size", "wire.gauge", {"jigs": ["printed"]}],
        ),
        (
            "extend its line, or set decomposition.refine_dangling: auto",
            [{"decomposition.refine_dangling": "auto"}],
        ),
        ("join them with a line, set decomposition.bridges: true, or not", [{"decomposition.bridges": True}]),
        ("set jig.split to auto or per-wire, or leave it", [{"jig.split": "per-wire"}]),
        ("set plate.wall_sheet to a thicker sheet to need only one", []),
        ("enlarge the piece, or make the wire thinner", ["size", "size", "wire.gauge"]),
        ("leave it out of `jigs`, or go larger", ["size", "size"]),
        ("leave pdf out of `outputs`", ["outputs"]),
        ("no size up to 1000 mm and no wire would do: simplify the drawing", []),
        ("scan at a higher resolution", []),
        ("", []),
    ],
)
def test_a_button_does_what_the_sentence_says(remedy: str, changes: list[Any]) -> None:
    offered = fixes(remedy, "wire-01 at 3 mm", DATA)
    made = [fix["change"]["set"] for fix in offered]
    assert len(made) == len(changes)
    for one, wanted in zip(made, changes, strict=True):
        assert one == wanted if isinstance(wanted, dict) else list(one) == [wanted]
        applied({"set": one}, DATA)
    assert len({fix["label"] for fix in offered}) == len(offered)


@pytest.mark.parametrize(("fit", "offered"), [("off", 1), ("gentle", 0), ("bold", 0)])
def test_what_fit_helps_against_has_its_button(fit: str, offered: int) -> None:
    made = fixes("bend it by hand", "wire-01", DATA | {"fit": fit}, helped=True)
    assert [fix["label"] for fix in made] == ["Make it fit: gentle"] * offered
    assert fixes("bend it by hand", "wire-01", DATA | {"fit": fit}) == []
    said = fixes("larger, or set fit to gentle", "wire-01", DATA | {"fit": fit}, helped=True)
    assert sum(fix["change"] == {"set": {"fit": "gentle"}} for fix in said) == (fit != "gentle")


@pytest.mark.parametrize("size", ["3 mm", "39.9 mm", "150 mm", "999 mm", "1000 mm"])
def test_a_larger_size_is_larger_and_taken(size: str) -> None:
    data = DATA | {"size": size}
    for fix in fixes("make the piece larger", "", data):
        config = applied(fix["change"], data)
        assert config.size is not None
        assert config.size > float(size.removesuffix(" mm"))


def test_one_wire_is_not_parted() -> None:
    remedy = "press it by hand, or set jig.split to per-wire"
    assert [len(fixes(remedy, "", DATA, wires=count)) for count in (0, 1, 2)] == [1, 0, 1]


def test_the_size_of_the_piece_stands_in_for_that_of_the_config() -> None:
    assert fixes("make the piece larger", "", {"drawing": "bee.svg"}) == []
    [first, _] = fixes("make the piece larger", "", {"drawing": "bee.svg"}, 62.5)
    assert first["change"] == {"set": {"size": "70 mm"}}


def test_a_mistake_of_the_text_has_its_button() -> None:
    wrong = {"drawing": "bee.png", "sise": "4 cm"}
    [fix] = fixes("did you mean 'size'?", "bee.yaml:2:1 sise", wrong)
    assert fix["change"] == {"unset": ["sise"], "set": {"size": "4 cm"}}
    [fix] = fixes("did you mean 'copper'?", "bee.yaml:2:8 wire.metal", DATA | {"wire": {"metal": "coper"}})
    assert fix["change"] == {"set": {"wire.metal": "copper"}}
    offered = fixes("write for example '9 mm' or '9 in'", "bee.yaml:2:1 size", DATA | {"size": 9})
    assert [fix["change"]["set"]["size"] for fix in offered] == ["9 mm", "9 in"]


@pytest.mark.parametrize("where", ["decomposition.choice", "bee.yaml:3:5 decomposition.choice"])
def test_an_alternative_that_there_isn_t_has_buttons(where: str) -> None:
    data = DATA | {"decomposition": {"choice": 9}}
    first, last = fixes("choose between 1 and 4", where, data)
    assert first == {"label": "Take alternative 1", "change": {"set": {"decomposition.choice": 1}}}
    assert last["change"] == {"set": {"decomposition.choice": 4}}
    [away] = fixes("take it away", where, data)
    assert away["change"] == {"unset": ["decomposition.choice"]}


def test_a_range_offers_its_ends() -> None:
    config = {"decomposition": {"weights": {"smoothness": 1e9}}}
    with pytest.raises(ValidationError) as told:
        Config.model_validate(DATA | config)
    remedy = told.value.errors()[0]["msg"]
    offered = fixes(remedy, "bee.yaml:3:5 decomposition.weights.smoothness", DATA | config)
    assert len(offered) == 2
    for fix in offered:
        applied(fix["change"], DATA)


@settings(max_examples=300)
@given(key=st.sampled_from([f"{block}.{name}".strip(".") for _, block, name, _ in CONTROLS]), value=VALUES)
def test_whatever_a_text_says_can_be_shown(key: str, value: Any) -> None:
    """Also where no build would take it: the page shows the last good state, and the text to mend."""
    said = finite(with_value({"drawing": "bee.png"}, key, value))
    shown = {each["key"]: each for each in controls(said)}
    json.dumps([list(shown.values()), constraint_entries(said)], allow_nan=False)
    kinds: dict[str, type | tuple[type, ...]] = {"choices": list, "switch": bool}
    for each in shown.values():
        assert isinstance(each["value"], kinds.get(each["kind"], (str, int, float, type(None)))), each


def test_a_choice_is_shown_as_the_list_spells_it() -> None:
    said = {"wire": {"metal": "Copper", "temper": "dead_soft"}, "jigs": ["Printed"], "outputs": "HTML"}
    shown = {each["key"]: each for each in controls(DATA | said)}
    assert shown["wire.metal"]["value"] in shown["wire.metal"]["choices"]
    assert shown["wire.temper"]["value"] in shown["wire.temper"]["choices"]
    assert shown["jigs"]["value"] == ["printed"]
    assert shown["outputs"]["value"] == ["html"]


@pytest.mark.parametrize("constraints", [3, "x", [None, 3, [1], {}, {"at": 3}], {"same_wire": [1, 2]}])
def test_constraints_that_are_none_do_no_harm(constraints: Any) -> None:
    entries = constraint_entries({"decomposition": {"constraints": constraints}})
    assert all(isinstance(each["constraint"], dict) and each["text"] is not None for each in entries)
    if not isinstance(constraints, list):
        text = f"decomposition: {{constraints: {json.dumps(constraints)}}}\n"
        with pytest.raises(ConfigError, match="no list"):
            edited(text, Change(release=[0]))


@pytest.mark.parametrize("listed", [3, "x", None, [], [None, "5", 3.5, True, [5]], {"a": 1}])
def test_a_list_of_no_numbers_names_no_line(listed: Any) -> None:
    assert numbers_at(DATA | {"drop": listed}, "drop") == []


def test_history_passes_over_what_does_not_hold() -> None:
    history = History(b"a", lambda content: content != b"broken")
    assert history.before() is history.after() is None
    history.add(b"broken")
    history.add(b"c")
    assert history.before() == b"a"
    history.go_back()
    assert (history.current, history.after()) == (b"a", b"c")
    history.go_on()
    assert (history.current, history.after()) == (b"c", None)
    history.go_back()
    history.add(b"d")
    assert history.after() is None
    with pytest.raises(ValueError, match="no such step"):
        history.go_on()
