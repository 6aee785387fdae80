"""The main path with what Windows lacks taken away (`windows/sitecustomize.py` says what): the same bytes."""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tests.pipeline.folders import held
from wrapit.config.naming import DEVICES

ROOT = Path(__file__).parents[2]
WINDOWS = Path(__file__).parent / "windows"
LINES = (
    '<svg xmlns="http://www.w3.org/2000/svg" width="40mm" height="40mm" viewBox="0 0 40 40">'
    '<path fill="none" stroke="black" '
    'd="M 35 20 A 15 15 0 0 1 5 20 A 15 15 0 0 1 35 20 M 5 20 L 35 20"/></svg>'
)
NAME = "Krähe im Kreis"
# As `init` writes it, and what is built: the kernel's time goes with the length of the channels.
PROPOSED, SMALL = b"size: 40 mm", b"size: 20 mm"

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="Windows is imitated on Linux")


def environment(folder: Path, *, windows: bool) -> dict[str, str]:
    paths = [str(WINDOWS), str(ROOT)] if windows else [str(ROOT)]
    coding = {"PYTHONIOENCODING": "cp1252"} if windows else {}
    scratch = folder / "temporary"
    scratch.mkdir(exist_ok=True)
    return {**os.environ, **coding, "PYTHONPATH": os.pathsep.join(paths), "TMPDIR": str(scratch)}


def started(folder: Path, *arguments: str, windows: bool = True) -> subprocess.Popen[str]:
    return subprocess.Popen(
        [sys.executable, "-m", "wrapit", *arguments],
        cwd=folder,
        env=environment(folder, windows=windows),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        encoding="cp1252" if windows else "utf-8",
        start_new_session=True,
    )


def ran(folder: Path, *arguments: str, windows: bool = True) -> tuple[int, str, str]:
    process = started(folder, *arguments, windows=windows)
    output, errors = process.communicate(timeout=300)
    return process.returncode, output, errors


def drawn(folder: Path) -> Path:
    folder.mkdir()
    (folder / f"{NAME}.svg").write_text(LINES, encoding="utf-8", newline="\n")
    return folder


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path]:
    """The same commands here and there: a config, a build with all files, their dependencies, test pieces."""
    folders = []
    for windows in (False, True):
        folder = drawn(tmp_path_factory.mktemp("desk") / "pieces")
        folders.append(folder)
        for arguments in (
            ["init", f"{NAME}.svg"],
            ["build", f"{NAME}.yaml", "-MF", "piece.d", "--alternatives", "2", "--set", "pair=true"],
            ["coupon", f"{NAME}.yaml", "-o", "coupons"],
        ):
            code, _, errors = ran(folder, *arguments, windows=windows)
            assert code == 0, errors
            assert not any(line.startswith(("error", "Traceback")) for line in errors.splitlines())
            if arguments[0] == "init":
                written = (folder / arguments[1]).with_suffix(".yaml")
                assert written.read_bytes().count(PROPOSED) == 1
                written.write_bytes(written.read_bytes().replace(PROPOSED, SMALL))
        shutil.rmtree(folder / "temporary")
    return folders[0], folders[1]


def test_all_files_have_the_same_bytes(built: tuple[Path, Path]) -> None:
    here, there = (held(folder) for folder in built)
    assert here.keys() == there.keys()
    assert [name for name in here if here[name] != there[name]] == []
    suffixes = {Path(name).suffix for name, data in here.items() if data is not None}
    assert suffixes >= {
        ".yaml",
        ".d",
        ".step",
        ".stl",
        ".3mf",
        ".dxf",
        ".svg",
        ".html",
        ".pdf",
        ".png",
        ".json",
    }


def test_text_has_unix_line_ends_in_utf_8(built: tuple[Path, Path]) -> None:
    texts = [
        path
        for path in built[1].rglob("*")
        if path.suffix in {".yaml", ".d", ".step", ".dxf", ".svg", ".html", ".json"}
    ]
    assert len(texts) > 10
    for path in texts:
        assert b"\r" not in path.read_bytes(), path.name
        path.read_text(encoding="ascii" if path.suffix == ".step" else "utf-8")


def test_every_system_takes_the_names_and_tells_them_apart(built: tuple[Path, Path]) -> None:
    names = [path.name for path in built[1].rglob("*") if path.parent.name == NAME]
    assert len(names) > 20
    assert len({name.casefold() for name in names}) == len(names)
    for name in names:
        assert not set(name) & set('<>:"/\\|?*')
        assert name.partition(".")[0].lower() not in DEVICES
        assert name == name.rstrip(". ")


def test_what_is_up_to_date_stays_and_what_changed_is_built(built: tuple[Path, Path], tmp_path: Path) -> None:
    folder = shutil.copytree(built[1], tmp_path / "pieces")
    before = held(folder / "build")
    same = ["build", f"{NAME}.yaml", "--set", "pair=true", "--json"]
    code, output, _ = ran(folder, *same)
    assert (code, json.loads(output)["timings_s"]) == (0, {"cached": []})
    code, output, errors = ran(folder, *same, "--set", "size=21 mm", "--set", "outputs=[step, html]")
    assert code == 0, errors
    names = {f"{NAME}/{artifact['path']}" for artifact in json.loads(output)["artifacts"]}
    after = held(folder / "build")
    assert after.keys() == {NAME, f"{NAME}/report.json", *names} < before.keys()
    assert after[f"{NAME}/wires.step"] != before[f"{NAME}/wires.step"]
    code, _, errors = ran(folder, "check", f"{NAME}.yaml")
    assert code == 0, errors


def test_a_file_that_a_slicer_has_open_stops_the_build_before_it_changes_anything(
    built: tuple[Path, Path], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("WRAPIT_CACHE", str(tmp_path / "cache"))  # the second build recalls all of the first
    folder = shutil.copytree(built[1], tmp_path / "pieces")
    before = held(folder / "build")
    with (folder / "build" / NAME / "jig.3mf").open("rb"):
        code, _, errors = ran(folder, "build", f"{NAME}.yaml", "--set", "size=21 mm")
        assert errors.splitlines() == [
            f"error: {folder / 'build' / NAME / 'jig.3mf'}: another program keeps "
            "this file from being replaced; close the program that has jig.3mf open, and build again"
        ]
        assert code == 1
        assert held(folder / "build") == before
    assert ran(folder, "build", f"{NAME}.yaml", "--set", "size=21 mm")[0] == 0
    assert held(folder / "build") != before


@pytest.mark.parametrize("signum", [signal.SIGINT, signal.SIGQUIT], ids=["Ctrl-C", "Ctrl-Break"])
def test_an_interrupted_build_clears_away(
    built: tuple[Path, Path], tmp_path: Path, signum: signal.Signals
) -> None:
    folder = shutil.copytree(built[1], tmp_path / "pieces")
    before = held(folder / "build")
    process = started(folder, "build", f"{NAME}.yaml", "--force")
    partial_in(folder, process)
    process.send_signal(signum)
    _, errors = process.communicate(timeout=60)
    assert errors.splitlines() == ["error: interrupted; earlier files are untouched"]
    assert process.returncode == 128 + signum
    assert held(folder / "build") == before


def partial_in(folder: Path, process: subprocess.Popen[str]) -> Path:
    deadline = time.monotonic() + 60
    while time.monotonic() < deadline and process.poll() is None:
        for path in (folder / "build").glob(".*.partial"):
            return path
        time.sleep(0.005)
    raise AssertionError("the build never started")


def test_what_a_killed_build_left_goes_and_what_a_living_one_has_stays(
    built: tuple[Path, Path], tmp_path: Path
) -> None:
    folder = shutil.copytree(built[1], tmp_path / "pieces")
    killed = started(folder, "build", f"{NAME}.yaml", "--force")
    left = partial_in(folder, killed)
    killed.kill()
    killed.communicate(timeout=60)
    assert left.exists()
    living = started(folder, "build", f"{NAME}.yaml", "--force")
    while left.exists() and living.poll() is None:
        time.sleep(0.005)
    partial = partial_in(folder, living)
    living.send_signal(signal.SIGSTOP)
    try:
        code, _, errors = ran(folder, "build", f"{NAME}.yaml", "--until", "wires", "--force")
        assert code == 0, errors
        assert partial.exists()
    finally:
        living.send_signal(signal.SIGCONT)
    _, errors = living.communicate(timeout=120)
    assert living.returncode == 0, errors
    assert list((folder / "build").glob(".*")) == []


# What a module of wrapit's would do that Windows doesn't take, and the error there.
REFUSED = {
    "import fcntl": "ModuleNotFoundError",
    "import os; os.fork": "AttributeError",
    "from os import O_DIRECTORY": "ImportError",
    "import signal; signal.SIGHUP": "AttributeError",
    "import signal; signal.pthread_sigmask": "AttributeError",
    "import ctypes; ctypes.CDLL(None)": "TypeError",
    "import os; f = open('a', 'w'); os.replace('a', 'b')": "PermissionError",
    "import os; f = open('a', 'w'); os.unlink('a')": "PermissionError",
    "import os; os.mkdir('d'); f = open('d/a', 'w'); os.rename('d', 'e')": "PermissionError",
    "import os; open('a', 'w').close(); open('b', 'w').close(); os.rename('a', 'b')": "FileExistsError",
    "from pathlib import Path; Path('a').write_text('ł')": "UnicodeEncodeError",
    "import sys; assert sys.platform != 'win32'": "AssertionError",
    "from pathlib import Path; Path('a').write_text('1\\n'); assert b'\\r' not in Path('a').read_bytes()": (
        "AssertionError"
    ),
}


@pytest.mark.parametrize("line", REFUSED)
def test_the_imitation_refuses_what_windows_does(line: str, tmp_path: Path) -> None:
    (tmp_path / "wrapit.py").write_text(line)
    paths = os.pathsep.join([str(WINDOWS), str(tmp_path)])
    run = [sys.executable, "-c", "import wrapit"]
    for path, expected in ((paths, REFUSED[line]), (str(tmp_path), None)):
        for made in ("a", "b", "d", "e"):
            shutil.rmtree(tmp_path / made) if (tmp_path / made).is_dir() else (tmp_path / made).unlink(
                missing_ok=True
            )
        told = subprocess.run(
            run,
            capture_output=True,
            text=True,
            cwd=tmp_path,
            env={**os.environ, "PYTHONPATH": path},
            check=False,
        )
        last = [each for each in told.stderr.splitlines() if not each.startswith(" ")][-1:]
        assert [each.partition(":")[0] for each in last] == ([expected] if expected else []), told.stderr
