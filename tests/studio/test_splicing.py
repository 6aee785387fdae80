"""A change touches the lines that it is about; all else in a config stays byte for byte."""

from __future__ import annotations

import difflib
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from wrapit.errors import ConfigError
from wrapit.studio.text.editing import Change, change_from, edited
from wrapit.studio.text.values import BOM, said, value_at

VALUES: dict[str, list[Any]] = {
    "name": ["bee", "my bee", "1.0", "yes: no", "é ß"],
    "size": ["40 mm", "4 cm", "1 1/2 in"],
    "wire.gauge": ["18 AWG", "1.0 mm"],
    "wire.metal": ["copper", "brass"],
    "wire.temper": ["dead soft", "hard"],
    "decomposition.weights.smoothness": [0.1, 1, 2.5e-05],
    "decomposition.bridges": [True, False],
    "decomposition.constraints": [[{"same_wire": [3, 7]}], [{"start_at": 4}, {"max_wire_length": "30 cm"}]],
    "jigs": [["pegs"], ["printed", "sheet"]],
    "outputs": [["html"], ["html", "pdf", "step"], ["dxf"]],
    "jig.split": ["single", "per-wire"],
    "bail.diameter": ["5 mm"],
    "guide.units": ["in", "mm"],
    "keep": [[3], [3, 7, 11]],
    "drop": [[0], [12, 5]],
}
KEYS = sorted(VALUES)


def spelled(value: Any, draw: st.DrawFn) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, list):
        return "[" + draw(st.sampled_from([", ", ",  "])).join(spelled(item, draw) for item in value) + "]"
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key}: {spelled(item, draw)}" for key, item in value.items()) + "}"
    if isinstance(value, str) and (value[0].isdigit() or ":" in value or draw(st.booleans())):
        return draw(st.sampled_from([f"'{value}'", f'"{value}"']))
    return str(value)


@st.composite
def configs(draw: st.DrawFn) -> str:
    """Texts of configs, in many hands: order, comments, blank lines, styles, line ends."""
    chosen = draw(st.permutations(draw(st.lists(st.sampled_from(KEYS), unique=True))))
    tree: dict[str, Any] = {"drawing": "bee.png"}
    for key in chosen:
        *blocks, last = key.split(".")
        inner = tree
        for name in blocks:
            inner = inner.setdefault(name, {})
        inner[last] = draw(st.sampled_from(VALUES[key]))
    comment = st.sampled_from(["", "", "  # size: 9 mm", "   #", "  "])
    between = st.sampled_from([[], [], [""], ["# wire: {gauge: 1 mm}"], ["    # deep", ""]])
    lines: list[str] = list(draw(between))

    def write(block: dict[str, Any], indent: str) -> None:
        for key, value in block.items():
            if isinstance(value, dict) and draw(st.booleans()):
                lines.append(f"{indent}{key}:{draw(comment)}")
                write(value, indent + draw(st.sampled_from(["  ", "    "])))
            elif isinstance(value, list) and draw(st.booleans()):
                lines.append(f"{indent}{key}:{draw(comment)}")
                dash = indent + draw(st.sampled_from(["", "  "]))
                for item in value:
                    lines.append(f"{dash}- {spelled(item, draw)}{draw(comment)}")
                    lines.extend(draw(between))
            else:
                lines.append(f"{indent}{key}: {spelled(value, draw)}{draw(comment)}")
            lines.extend(draw(between))

    write(tree, "")
    newline = draw(st.sampled_from(["\n", "\r\n"]))
    text = newline.join(lines) + draw(st.sampled_from(["", newline]))
    return draw(st.sampled_from(["", BOM])) + text


def differences(before: str, after: str) -> tuple[list[str], list[str]]:
    """Lines that went and lines that came."""
    old, new = before.splitlines(keepends=True), after.splitlines(keepends=True)
    changes = difflib.SequenceMatcher(None, old, new, autojunk=False).get_opcodes()
    gone = [line for tag, a, b, _, _ in changes if tag != "equal" for line in old[a:b]]
    came = [line for tag, _, _, a, b in changes if tag != "equal" for line in new[a:b]]
    return gone, came


@settings(deadline=None, max_examples=200)
@given(text=configs(), key=st.sampled_from(KEYS), data=st.data())
def test_a_value_that_is_set_changes_its_own_lines_only(text: str, key: str, data: st.DataObject) -> None:
    value = data.draw(st.sampled_from(VALUES[key]))
    was = value_at(said(text), key)
    result = edited(text, Change(set={key: value}))
    assert value_at(said(result), key) == value
    gone, came = differences(text, result)
    if was == value:
        assert result == text
    listed = max(len(was) if isinstance(was, list) else 1, len(value) if isinstance(value, list) else 1)
    assert len(gone) <= listed + 1  # and the last line of all, where it had no end
    if was is None:  # it is new, so every letter that stood there stays, in its order
        letters = iter(result)
        assert all(letter in letters for letter in text)
    assert len(came) <= listed + 3  # blocks that it needs
    if "\r\n" in text:
        assert "\n" not in result.replace("\r\n", "")
    assert result.startswith(BOM) == text.startswith(BOM)


@settings(deadline=None, max_examples=200)
@given(text=configs(), key=st.sampled_from(KEYS), data=st.data())
def test_what_is_set_and_taken_away_again_leaves_the_text_as_it_was(
    text: str, key: str, data: st.DataObject
) -> None:
    """But for the end of the last line, which a line behind it needs."""
    if value_at(said(text), key) is not None:
        return
    there = edited(text, Change(set={key: data.draw(st.sampled_from(VALUES[key]))}))
    back = edited(there, Change(unset=[key]))
    if key.startswith("bail") and value_at(said(back), "bail") == {}:
        back = edited(back, Change(unset=["bail"]))
    assert back.rstrip("\r\n") == text.rstrip("\r\n")


@settings(deadline=None, max_examples=200)
@given(text=configs(), key=st.sampled_from(KEYS))
def test_what_is_taken_away_takes_no_other_line_with_it(text: str, key: str) -> None:
    result = edited(text, Change(unset=[key]))
    assert value_at(said(result), key) is None
    gone, came = differences(text, result)
    was = value_at(said(text), key)
    blocks = key.count(".")
    listed = len(was) * 3 if isinstance(was, list) else 1  # comments between its items go with them
    assert len(gone) - len(came) <= listed + blocks + 1
    kept = {k: value_at(said(text), k) for k in KEYS if k != key}
    assert {k: value_at(said(result), k) for k in kept} == kept


@settings(deadline=None, max_examples=100)
@given(text=configs(), data=st.data())
def test_constraints_come_and_go_by_their_number(text: str, data: st.DataObject) -> None:
    old = value_at(said(text), "decomposition.constraints") or []
    release = data.draw(st.lists(st.integers(0, len(old) - 1), unique=True)) if old else []
    added = data.draw(st.lists(st.sampled_from([{"cut_at": 9}, {"through": [1, 2], "at": 5}]), unique_by=str))
    result = edited(text, Change(constrain=added, release=release))
    kept = [item for index, item in enumerate(old) if index not in release]
    assert (value_at(said(result), "decomposition.constraints") or []) == kept + added


@settings(deadline=None, max_examples=80)
@given(text=configs(), key=st.sampled_from(["keep", "drop"]), numbers=st.sets(st.integers(0, 15), min_size=1))
def test_numbers_are_added_once_and_taken_wherever_they_stand(text: str, key: str, numbers: set[int]) -> None:
    old = value_at(said(text), key) or []
    other = {"keep": "drop", "drop": "keep"}[key]
    result = edited(text, Change(add={key: sorted(numbers)}, take={other: sorted(numbers)}))
    assert value_at(said(result), key) == old + [each for each in sorted(numbers) if each not in old]
    was = value_at(said(text), other) or []
    assert (value_at(said(result), other) or []) == [each for each in was if each not in numbers]
    gone, _ = differences(text, result)
    assert len(gone) <= 3 + 3 * (len(was) + 1)  # of each list its line or its items' lines, comments between
    fresh = sorted(numbers - set(old))
    if fresh:
        there = edited(text, Change(add={key: fresh}))
        assert edited(there, Change(take={key: fresh})).rstrip("\r\n") == text.rstrip("\r\n")


@pytest.mark.parametrize(
    ("before", "change", "after"),
    [
        ("drawing: a.png\nsize: 4 cm # c\n", {"set": {"size": "5 cm"}}, "drawing: a.png\nsize: 5 cm # c\n"),
        ("{drawing: a.png}\n", {"set": {"size": "5 cm"}}, "{drawing: a.png, size: 5 cm}\n"),
        ("drawing: a.png", {"set": {"pair": True}}, "drawing: a.png\npair: true\n"),
        ("drawing: a.png\nbail:\n", {"set": {"bail.at": 3}}, "drawing: a.png\nbail:\n  at: 3\n"),
        (
            "drawing: a.png\nwire: {}\n",
            {"set": {"wire.metal": "brass"}},
            "drawing: a.png\nwire: {metal: brass}\n",
        ),
        ("drawing: a.png\nbail: {at: 3}\n", {"unset": ["bail.at"]}, "drawing: a.png\nbail: {}\n"),
        (
            "drawing: a.png\nguide: &g {units: in}\nname: x\n",
            {"set": {"guide.units": "mm"}},
            "drawing: a.png\nguide: &g {units: mm}\nname: x\n",
        ),
        (
            "drawing: a.png\njigs:\n- printed  # a\n- sheet\n# kept\n\n\n",
            {"set": {"jigs": ["pegs"]}},
            "drawing: a.png\njigs:\n- pegs\n# kept\n\n\n",
        ),
        (
            "drawing: a.png\njigs: [\n  pegs,  # a\n  sheet,  # b\n]\n",
            {"set": {"jigs": ["sheet"]}},
            "drawing: a.png\njigs: [\n  sheet,  # b\n]\n",
        ),
        (
            "drawing: a.png\njigs: [\n  pegs,  # a\n  sheet,  # b\n]\n",
            {"set": {"jigs": ["pegs"]}},
            "drawing: a.png\njigs: [\n  pegs,  # a\n]\n",
        ),
        (
            "drawing: a.png\nkeep: [4, 5]  # eyes\npair: true\n",
            {"add": {"drop": [5]}, "take": {"keep": [5]}},
            "drawing: a.png\nkeep: [4]  # eyes\ndrop: [5]\npair: true\n",
        ),
        (
            "drawing: a.png\ndrop:\n  - 5  # whisker\n  - 6  # tail\n",
            {"take": {"drop": [5]}},
            "drawing: a.png\ndrop:\n  - 6  # tail\n",
        ),
        (
            "drawing: a.png\ndrop: [5, 6, 5]\n",
            {"take": {"drop": [5, 6]}},
            "drawing: a.png\n",
        ),
        (
            "drawing: a.png\ndrop:  # no eyes\npair: true\n",
            {"add": {"drop": [5]}},
            "drawing: a.png\ndrop: [5]  # no eyes\npair: true\n",
        ),
        (
            "{drawing: a.png, drop: , pair: true}",
            {"add": {"drop": [5]}},
            "{drawing: a.png, drop: [5] , pair: true}",
        ),
        ("drawing: a.png\ndrop: null\n", {"add": {"drop": [5]}}, "drawing: a.png\ndrop: [5]\n"),
        ("drawing: a.png\ndrop:\n", {"add": {"drop": [5]}}, "drawing: a.png\ndrop: [5]\n"),
    ],
)
def test_samples(before: str, change: dict[str, Any], after: str) -> None:
    assert edited(before, change_from(change)) == after


def test_a_value_with_an_anchor_is_changed_where_it_is_meant() -> None:
    text = "drawing: a.png  # here\njig:\n  clearance: &c 1 mm\n  inside_gap: *c\n"
    result = edited(text, Change(set={"jig.inside_gap": "2 mm"}))
    assert said(result)["jig"] == {"clearance": "1 mm", "inside_gap": "2 mm"}
    assert "# here" in result


@pytest.mark.parametrize(
    "document",
    [
        [],
        "size",
        {"sett": {}},
        {"set": []},
        {"set": {"": 1}},
        {"set": {"a.b": 1, "../x": 2}},
        {"unset": "size"},
        {"unset": [3]},
        {"constrain": [3]},
        {"release": [True]},
        {"release": ["0"]},
        {"release": [99]},
        {"set": {"drawing.size": 3}},
        {"add": [3]},
        {"add": {"drop": 3}},
        {"add": {"drop": ["3"]}},
        {"take": {"drop": [True]}},
        {"take": {"../x": [3]}},
        {"add": {"drawing": [3]}},
    ],
)
def test_what_is_no_change_is_refused(document: object) -> None:
    with pytest.raises(ConfigError):
        edited("drawing: a.png\n", change_from(document))


@pytest.mark.parametrize("text", ["a: [", "- a\n", "a: 1\na: 2\n", "%YAML 1.1\n---\na: 1\n"])
def test_what_is_no_yaml_is_not_changed(text: str) -> None:
    with pytest.raises(ConfigError):
        edited(text, Change(set={"size": "4 cm"}))
