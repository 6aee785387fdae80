"""Every code that the program can say has its line in the catalogue, and no other has."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from typing import get_args

import pytest

from tests.config.keys import every_key
from tests.docs.troubleshooting import PAGE, page
from tests.test_messages import DOTTED, FILES
from wrapit.codes import ERRORS, FINDINGS
from wrapit.config import Config
from wrapit.drawing.svg import remarks
from wrapit.drawing.svg.seen.losses import What

HOUSE = PAGE.parent
# Where codes are given: the function that takes one, and the place of it among the arguments.
TAKES = {"Finding": 1, "Notice": 1, "tell": 1, "leave_out": 2}
# Codes that aren't written where they are given: what is written there instead, and what it can be.
ELSEWHERE = {
    ("drawing/bitmap/stage.py", "notice.code"): set(),  # of a Notice, which has its own place
    ("drawing/svg/stage.py", "notice.code"): set(),
    ("drawing/bitmap/strand_graph.py", "code"): set(),  # in `tell`, which is called with it
    ("drawing/bitmap/page/stage.py", "code"): set(),  # in `leave_out`, which is called with it
    ("drawing/bitmap/page/stage.py", "*_about_ground(ground)"): {"dark-table", "dark-edge"},
    ("drawing/svg/seen/told.py", "losses[0].what"): set(get_args(What)),
    ("drawing/svg/remarks.py", "code"): {code for code, *_ in remarks._KINDS.values()},
    # Recalled as they were given.
    ("pipeline/cache/remembering.py", "{**said, 'places_mm': tuple(said['places_mm'])}"): set(),
    ("jig/printed/seats.py", "code"): {"bead-without-seat", "bead-below-plate"},
    ("jig/sheet/shops.py", "f'shop-narrow-{what}'"): {"shop-narrow-hole", "shop-narrow-part"},
}


def given(source: str) -> Iterator[str | ast.expr]:
    """The code of each finding that a module makes: as text, or what is written in its place."""
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Call):
            name = node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")
            of_another_kind = name == "tell" and len(node.args) == 1  # the studio's, of a message
            if name in TAKES and not of_another_kind:
                named = [keyword.value for keyword in node.keywords if keyword.arg == "code"]
                starred = [each for each in node.args[: TAKES[name] + 1] if isinstance(each, ast.Starred)]
                spread = [keyword.value for keyword in node.keywords if keyword.arg is None]
                (code,) = named or starred or spread or [node.args[TAKES[name]]]
                yield code.value if isinstance(code, ast.Constant) else code


def modules() -> Iterator[tuple[str, str]]:
    for path in sorted(HOUSE.rglob("*.py")):
        yield path.relative_to(HOUSE).as_posix(), path.read_text(encoding="utf-8")


def said_findings() -> dict[str, str]:
    """Each code of a finding, with a module that gives it."""
    found, places = {}, set()
    for name, source in modules():
        for code in given(source):
            if isinstance(code, str):
                found[code] = name
            else:
                place = (name, ast.unparse(code))
                assert place in ELSEWHERE, f"{place}: which codes can that be? ELSEWHERE is to say it"
                places.add(place)
                found |= dict.fromkeys(ELSEWHERE[place], name)
    assert ELSEWHERE.keys() == places
    return found


def said_errors(source: str) -> Iterator[str]:
    """Codes of the kinds of errors that a module defines, and of those that it makes of others."""
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.ClassDef) and node.name.endswith("Error"):
            for line in node.body:
                target = getattr(line, "target", None) or getattr(line, "targets", [None])[0]
                if isinstance(target, ast.Name) and target.id == "code" and node.name != "WrapItError":
                    yield ast.literal_eval(line.value)
        made = isinstance(node, ast.Call) and getattr(node.func, "id", "") == "_report"
        if made and isinstance(node.args[0], ast.Constant):
            yield node.args[0].value


def test_every_code_of_a_finding_is_explained_and_no_other() -> None:
    said, explained = said_findings(), {code for codes in FINDINGS.values() for code in codes}
    assert len(said) > 60
    assert {code: place for code, place in said.items() if code not in explained} == {}
    assert explained - said.keys() == set(), "nothing says this any more"
    assert sum(map(len, FINDINGS.values())) == len(explained), "explained twice"


def test_every_code_of_an_error_is_explained_and_no_other() -> None:
    said = {code for _, source in modules() for code in said_errors(source)}
    assert len(said) > 10
    assert said == ERRORS.keys()


def test_the_page_is_what_the_code_says() -> None:
    assert PAGE.read_text(encoding="utf-8") == page(), "`make docs` writes it anew"


def test_keys_that_the_page_names_exist() -> None:
    named = {key for key in DOTTED.findall(page()) if not FILES.search(key)}
    assert len(named) > 10
    assert named - set(every_key(Config)) == set()


@pytest.mark.parametrize(
    ("source", "codes"),
    [
        ("Finding('note', 'new', 'jig', 'text')", ["new"]),
        ("x.append(errors.Finding(level, code='new', where='jig', message='text'))", ["new"]),
        ("graph.tell('note', 'new', at, 'text')", ["new"]),
        ("finding", []),
    ],
)
def test_codes_are_found_where_they_are_given(source: str, codes: list[str]) -> None:
    assert list(given(source)) == codes


def test_errors_are_found_where_they_are_defined_or_made() -> None:
    source = (
        "class NewError(WrapItError):\n    code = 'new'\n_report('made', a, b)\n_report(error.code, a, b)\n"
    )
    assert sorted(said_errors(source)) == ["made", "new"]
