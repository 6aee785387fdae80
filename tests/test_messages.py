"""What messages tell the user to set can be set: every key that they name exists."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import wrapit
from tests.config.keys import every_key
from wrapit.config import Config

PACKAGE = Path(wrapit.__file__).parent
BLOCKS = [name for name in every_key(Config) if any(key.startswith(f"{name}.") for key in every_key(Config))]
DOTTED = re.compile(rf"(?<![\w./-])(?:{'|'.join(map(re.escape, BLOCKS))})\.[a-z_]+(?:\.[a-z_]+)*")
FILES = re.compile(r"\.(svg|json|dxf|stl|step|3mf|html|pdf|png|yaml|py|jinja)$")


def texts(tree: ast.AST) -> Iterator[str]:
    """The words of a module that users can read: texts, but no docstrings."""
    documented = (ast.Module, ast.ClassDef, ast.FunctionDef)
    hidden = {
        id(node.body[0].value)
        for node in ast.walk(tree)
        if isinstance(node, documented) and node.body and isinstance(node.body[0], ast.Expr)
    }
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in hidden:
            yield node.value


def named_keys() -> dict[str, str]:
    """Each dotted key in a message, and a module that names it."""
    return {
        key: str(path.relative_to(PACKAGE))
        for path in sorted(PACKAGE.rglob("*.py"))
        for text in texts(ast.parse(path.read_text(encoding="utf-8")))
        for key in DOTTED.findall(text)
        if not FILES.search(key)
    }


def test_every_key_that_a_message_names_exists() -> None:
    named = named_keys()
    assert len(named) > 20
    assert {key: place for key, place in named.items() if key not in set(every_key(Config))} == {}
