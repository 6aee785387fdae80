"""What the source says that is not so on every system: names, text files, places, times."""

from __future__ import annotations

import ast
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
HOUSE = ROOT / "wrapit"
# Places that only some systems have.
PLACES = re.compile(r"^(/dev/|/tmp\b|/proc\b|/etc/|/usr/|~/|[A-Za-z]:\\)")
TEXT_METHODS = {"read_text", "write_text", "open"}
# Links and modes are POSIX's; a shell's quotes are no quotes in PowerShell's `cmd`; a rename onto a file
# replaces it on POSIX only (`replace` does so everywhere).
CALLS = {"symlink_to", "hardlink_to", "chmod", "lchmod", "symlink", "link", "mkfifo", "expanduser", "rename"}


def strange(source: str) -> Iterator[str]:
    """What a module does that differs from system to system, each with its line."""
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and PLACES.match(node.value):
            yield f"{node.lineno}: place {node.value}"
        if isinstance(node, ast.Call):
            yield from (f"{node.lineno}: {what}" for what in _strange_call(node))


def _strange_call(call: ast.Call) -> Iterator[str]:
    function = call.func
    name = function.attr if isinstance(function, ast.Attribute) else getattr(function, "id", "")
    named = {keyword.arg for keyword in call.keywords}
    if name in TEXT_METHODS and _is_text(call, function):
        if not named & {"encoding", None} and not (name == "read_text" and call.args):
            yield f"{name} without encoding"
        writes = name == "write_text" or (name == "open" and _mode(call, function)[:1] in "wxa")
        if writes and not named & {"newline", None}:
            yield f"{name} without newline"
    if name in CALLS:
        yield f"call of {name}"
    if name == "strftime":
        yield "words of the system's language"
    if name in ("now", "today", "fromtimestamp", "localtime", "ctime") and "tz" not in named:
        yield "time of the system's zone"
    yield from (f"{each} of processes" for each in named & {"start_new_session", "preexec_fn", "pass_fds"})


def _is_text(call: ast.Call, function: ast.expr) -> bool:
    if isinstance(function, ast.Name) and function.id == "write_text":
        return False  # that of `pipeline/textfile.py`
    if ast.unparse(function) in ("os.open", "Image.open"):
        return False
    return "b" not in _mode(call, function)


def _mode(call: ast.Call, function: ast.expr) -> str:
    place = 1 if isinstance(function, ast.Name) else 0
    given = [keyword.value for keyword in call.keywords if keyword.arg == "mode"] or call.args[
        place : place + 1
    ]
    return (
        given[0].value
        if given and isinstance(given[0], ast.Constant) and isinstance(given[0].value, str)
        else "r"
    )


# Each use that is right, by its module and what is found; with the reason.
RIGHT = {
    ("pipeline/worker.py", "open without encoding"): "nothing is written there: os.devnull",
    ("pipeline/worker.py", "open without newline"): "nothing is written there: os.devnull",
    (
        "pipeline/output/folder.py",
        "call of rename",
    ): "to a free name; a folder that appeared there is an error on each",
    ("pipeline/output/moving.py", "call of rename"): "to its own name: a question to Windows",
    ("pipeline/cache/place.py", "call of expanduser"): "`~` in a setting is the user's folder on each",
    ("studio/server.py", "open without encoding"): "of webbrowser: no file",
    ("studio/text/config_file.py", "call of chmod"): "the rights that the file had, as each system has them",
    ("cli/main.py", "open without newline"): "standard output and error end lines as the terminal does",
}


def test_each_system_gets_the_same() -> None:
    found = {}
    for path in sorted(HOUSE.rglob("*.py")):
        for line in strange(path.read_text(encoding="utf-8")):
            found[path.relative_to(HOUSE).as_posix(), line.partition(": ")[2]] = line
    assert {key: line for key, line in found.items() if key not in RIGHT} == {}
    assert RIGHT.keys() - found.keys() == set(), "allowed without need"


@pytest.mark.parametrize(
    ("line", "what"),
    [
        ("path.write_text(a)", ["write_text without encoding", "write_text without newline"]),
        ("path.write_text(a, encoding='utf-8')", ["write_text without newline"]),
        ("path.write_text(a, encoding='utf-8', newline='\\n')", []),
        ("path.read_text()", ["read_text without encoding"]),
        ("path.open('rb'); open(path, 'wb'); os.open(a, b)", []),
        ("open(path, 'w')", ["open without encoding", "open without newline"]),
        ("path.open('a', encoding='utf-8')", ["open without newline"]),
        ("open(path)", ["open without encoding"]),
        ("a = '/tmp/x'", ["place /tmp/x"]),
        ("a.rename(b)", ["call of rename"]),
        ("datetime.now()", ["time of the system's zone"]),
        ("datetime.now(tz=UTC)", []),
        ("day.strftime('%-d')", ["words of the system's language"]),
        ("Popen(a, start_new_session=True)", ["start_new_session of processes"]),
    ],
)
def test_what_differs_is_noticed(line: str, what: list[str]) -> None:
    assert [each.partition(": ")[2] for each in strange(line)] == what


def lacking(system: str, *files: Path) -> list[str]:
    """What Python's own modules lack on another system, of what these files ask them for.

    Other packages count as untyped: their types are checked once, on this system.
    """
    command = [sys.executable, "-m", "mypy", "--platform", system, *map(str, files)]
    command += ["--config-file=", "--no-site-packages", "--ignore-missing-imports", "--check-untyped-defs"]
    command += ["--cache-dir", str(ROOT / ".mypy_cache" / system)]
    told = subprocess.run(command, capture_output=True, text=True, cwd=ROOT, check=False, timeout=600)
    assert re.search(r"checked \d+ source file|no issues found in \d+", told.stdout), (
        told.stdout + told.stderr
    )
    return [each for each in told.stdout.splitlines() if re.search("Module .*has no attribute", each)]


@pytest.mark.parametrize("system", ["win32", "darwin"])
def test_no_module_asks_for_what_another_system_lacks(system: str) -> None:
    assert lacking(system, HOUSE) == []


@pytest.mark.parametrize(
    "line", ["import os\nos.fork()", "import signal\nsignal.SIGHUP", "import fcntl\nfcntl.flock(1, 2)"]
)
def test_what_windows_lacks_is_noticed(tmp_path: Path, line: str) -> None:
    (tmp_path / "lacking.py").write_text(f"{line}\n", encoding="utf-8")
    assert lacking("win32", tmp_path / "lacking.py")
