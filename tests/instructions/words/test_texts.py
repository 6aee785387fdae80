"""Both languages say the same things, all that the program says is there, and nothing else is."""

from __future__ import annotations

import ast
import itertools
import re
from collections.abc import Iterator
from pathlib import Path
from typing import get_args, get_type_hints

import pytest
from fluent.syntax import FluentParser
from fluent.syntax import ast as ftl
from fluent.syntax.visitor import Visitor

import wrapit
from wrapit.instructions.model import Difficulty
from wrapit.instructions.order.moves import MoveKind
from wrapit.instructions.order.wire_steps import BY_HAND, DIRECTIONS
from wrapit.jig.bench.model import Around
from wrapit.materials import METALS
from wrapit.pages.model import Listed

HOUSE = Path(wrapit.__file__).parent
WORDS = HOUSE / "instructions" / "words"
LANGUAGES = ("en", "de")
BENDS = [kind for kind in get_args(MoveKind) if kind != "straight"]
TEMPERS = {temper for metal in METALS.values() for temper in metal.proof_mpa}
# What goes into the keys that are put together: each pattern with all its values.
COMPOSED: dict[str, list[str]] = {
    "way-{}": list(DIRECTIONS),
    "caution-{}": list(BY_HAND),
    "heading-{}": BENDS,
    "do-{}": [
        *(kind for kind in BENDS if kind != "wrap"),
        *(f"wrap-{around}" for around in get_args(Around)),
        *(f"hairpin-{around}" for around in get_args(Around) if around != "run"),
        "by-hand-curve",
    ],
    "lead-to-{}": list(get_args(Around)),
    "tail-{}": ["start", "end", "both"],
    "ends-{}": ["wound", "turned"],
    "ends-{}-all": ["wound", "turned"],
    "difficulty-{}": list(get_args(Difficulty)),
    "metal-{}": [name.replace(" ", "-") for name in METALS],
    "temper-{}": [name.replace(" ", "-") for name in TEMPERS],
    "materials-head-{}": ["what", "thickness", "length", "weight"],
    "cut-head-{}": ["wire", "cut", "tail", "shape"],
    "glue-head-{}": ["sheet", "thickness", "size", "parts", "file"],
}  # fmt: skip
# Texts of the print, which may wait for it as long as its room is empty.
OF_THE_PRINT = {
    "print-scale", "tile", "strip-how", "strip-title", "strip-part", "page-of", "strips-title",
    "true-size-title", "steps-title", "step-number",
}  # fmt: skip


def messages(language: str) -> dict[str, ftl.Message]:
    source = (WORDS / f"{language}.ftl").read_text(encoding="utf-8")
    body = FluentParser().parse(source).body
    assert not [entry for entry in body if isinstance(entry, ftl.Junk)]
    found = [entry for entry in body if isinstance(entry, ftl.Message)]
    names = [message.id.name for message in found]
    assert len(names) == len(set(names)), "a key is given twice"
    return dict(zip(names, found, strict=True))


class Collected(Visitor):
    """Variables of a message, the variants of each choice, and all plain text."""

    def __init__(self, message: ftl.Message) -> None:
        self.variables: set[str] = set()
        self.choices: set[tuple[str, frozenset[str]]] = set()
        self.text = ""
        self.visit(message)

    def visit_VariableReference(self, node: ftl.VariableReference) -> None:  # noqa: N802  Visitor's names
        self.variables.add(node.id.name)

    def visit_TextElement(self, node: ftl.TextElement) -> None:  # noqa: N802
        self.text += node.value + " "

    def visit_SelectExpression(self, node: ftl.SelectExpression) -> None:  # noqa: N802
        assert isinstance(node.selector, ftl.VariableReference)
        keys = frozenset(
            variant.key.name if isinstance(variant.key, ftl.Identifier) else variant.key.value
            for variant in node.variants
        )
        self.choices.add((node.selector.id.name, keys))
        self.generic_visit(node)


def test_both_languages_have_the_same_keys_in_the_same_order() -> None:
    english, german = (list(messages(language)) for language in LANGUAGES)
    assert english == german


def test_both_languages_take_the_same_values() -> None:
    english, german = (messages(language) for language in LANGUAGES)
    for key, message in english.items():
        assert Collected(message).variables == Collected(german[key]).variables, key


def test_every_choice_has_a_rest_and_counts_tell_one_from_many() -> None:
    for language in LANGUAGES:
        for key, message in messages(language).items():
            for name, variants in Collected(message).choices:
                if name in ("count", "wires", "ties", "pieces", "jigs", "turns", "walls"):
                    assert "other" in variants, key
                    assert variants & {"one", "0", "1"}, key


def test_no_words_of_the_workshop_behind() -> None:
    for language in LANGUAGES:
        for key, message in messages(language).items():
            said = Collected(message).text
            assert not re.search(
                r"\b(rad|energy|energie|odd junction|junction|segment|trail)\b", said, re.I
            ), key
            assert not re.search(r"[<>]|\bTODO\b", said), key


Said = tuple[str, frozenset[str], str]
"""A key, the values that go with it, and where."""


def said_in(source: str, where: str) -> Iterator[Said]:
    """Keys that a module says: `text(…)`, `say(…)` or `….of(…)` with words as its first argument."""
    for node in ast.walk(ast.parse(source)):
        if not isinstance(node, ast.Call) or not node.args:
            continue
        called = node.func
        named = isinstance(called, ast.Name) and called.id in ("text", "say")
        if not (named or (isinstance(called, ast.Attribute) and called.attr == "of")):
            continue
        given = frozenset(each.arg for each in node.keywords if each.arg is not None)
        for key in keys_of(node.args[0]):
            yield key, given, f"{where}:{node.lineno}"


def keys_of(node: ast.expr) -> Iterator[str]:
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        yield node.value
    elif isinstance(node, ast.IfExp):
        yield from keys_of(node.body)
        yield from keys_of(node.orelse)
    elif isinstance(node, ast.JoinedStr):
        pattern = "".join(str(part.value) if isinstance(part, ast.Constant) else "{}" for part in node.values)
        # A pattern that isn't among them is a KeyError here: its values are to be added above.
        yield from (pattern.format(value) for value in COMPOSED[pattern])


def everything_said() -> list[Said]:
    said = []
    for path in sorted(
        itertools.chain((HOUSE / "instructions").rglob("*.py"), (HOUSE / "jig").rglob("*.py"))
    ):
        source = path.read_text(encoding="utf-8")
        if "wrapit.pages.model" in source or "words.speaking" in source or path.name == "speaking.py":
            said += said_in(source, str(path.relative_to(HOUSE)))
    for path in sorted((HOUSE / "instructions").rglob("*.jinja")):
        found = re.findall(r"say\('([a-z-]+)'((?:, *\w+=)?)", path.read_text(encoding="utf-8"))
        said += [(key, frozenset(re.findall(r"\w+(?==)", rest)), path.name) for key, rest in found]
    return said


def test_every_key_that_is_said_is_there_with_all_that_it_takes() -> None:
    known = messages("en")
    said = everything_said()
    assert len(said) > 150
    for key, given, where in said:
        assert key in known, f"{where}: {key}"
        missing = Collected(known[key]).variables - given
        assert not missing, f"{where}: {key} lacks {sorted(missing)}"


def test_every_key_that_is_there_is_said() -> None:
    joining = set(get_args(get_type_hints(Listed)["word"]))
    unused = set(messages("en")) - {key for key, _, _ in everything_said()} - joining
    printing = any(path.stem != "__init__" for path in (HOUSE / "instructions" / "print").glob("*.py"))
    assert unused <= (set() if printing else OF_THE_PRINT)


@pytest.mark.parametrize("broken", ["text('no-such-key')", "text('lead-on')", "speaker.of(f'way-{x}', a=1)"])
def test_what_is_said_is_found(broken: str) -> None:
    known = messages("en")
    found = [*said_in(broken, "here")]
    assert found
    if "way" in broken:
        assert {key for key, _, _ in found} == {f"way-{way}" for way in DIRECTIONS}
    else:
        ((key, given, _),) = found
        assert key not in known or Collected(known[key]).variables - given
