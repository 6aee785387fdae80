"""A build that is ended at any moment leaves the earlier files or the new ones, and no trace for long."""

from __future__ import annotations

import os
import random
import shutil
import signal
import subprocess
import sys
import time
import uuid
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.pipeline.folders import held, written_piece
from wrapit.pipeline.output.folder import prepare, staged
from wrapit.pipeline.output.ownership import is_whole, listed_files, own_report

pytestmark = pytest.mark.skipif(
    not Path("/proc/self/environ").exists(), reason="needs /proc to see processes"
)
SIGNALS = [signal.SIGKILL, signal.SIGTERM, signal.SIGHUP, signal.SIGINT]
INTERRUPTED = "interrupted; earlier files are untouched"


@pytest.fixture(autouse=True)
def _heeded() -> Iterator[None]:
    """A terminal's end counts here, even where these tests were started by nohup."""
    shown = signal.signal(signal.SIGHUP, signal.SIG_DFL)
    yield
    signal.signal(signal.SIGHUP, shown)


def _process(mark: str, config: Path, *arguments: str) -> subprocess.Popen[str]:
    return subprocess.Popen(
        [sys.executable, "-m", "wrapit", "build", str(config), "-o", str(config.parent / "out"), *arguments],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env={**os.environ, "WRAPIT_TEST_MARK": mark},
        start_new_session=True,
    )


def _living(mark: str) -> list[int]:
    """Processes that were started with this mark and still run."""
    needle, found = f"WRAPIT_TEST_MARK={mark}".encode(), []
    for process in Path("/proc").iterdir():
        if not process.name.isdecimal():
            continue
        try:
            if needle in (process / "environ").read_bytes().split(b"\0"):
                found.append(int(process.name))
        except OSError:
            continue  # it has ended, or is somebody else's
    return found


def _partial(folder: Path) -> list[Path]:
    return sorted(folder.glob(".out.*"))


def _is_whole(folder: Path) -> bool:
    report = own_report(folder)
    return (
        report is not None
        and is_whole(folder, report)
        and held(folder).keys() == {*listed_files(report), "report.json"}
    )


@pytest.fixture(scope="module")
def earlier(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, float]:
    """The folder of a piece that was built, and how long that took from the first sight of its partial."""
    folder = tmp_path_factory.mktemp("killed")
    process = _process("first", written_piece(folder, outputs=["step", "stl"]))
    _wait_for_partial(folder, process)
    start = time.monotonic()
    assert process.communicate(timeout=120)[1] == ""
    return folder, time.monotonic() - start


def _wait_for_partial(folder: Path, process: subprocess.Popen[str]) -> None:
    deadline = time.monotonic() + 60
    while not _partial(folder) and process.poll() is None and time.monotonic() < deadline:
        time.sleep(0.005)
    assert _partial(folder), "the build never started"


@pytest.mark.parametrize("signum", SIGNALS, ids=lambda signum: signum.name)
@pytest.mark.parametrize("whom", ["it", "all"])
@pytest.mark.parametrize("moment", ["seen", "starting", "working"])
def test_a_killed_build_leaves_the_earlier_one(
    earlier: tuple[Path, float], tmp_path: Path, signum: signal.Signals, whom: str, moment: str
) -> None:
    """`all` is what a terminal does: the signal goes to the worker's process too."""
    whole, duration_s = earlier
    folder = shutil.copytree(whole, tmp_path / "piece")
    config, mark, before = folder / "piece.yaml", uuid.uuid4().hex, held(folder / "out")
    share = random.Random(f"{signum} {whom} {moment}").random()
    process = _process(mark, config, "--force", "--set", "size=31 mm")
    _wait_for_partial(folder, process)
    time.sleep(share * {"seen": 0.0, "starting": 0.5, "working": duration_s}[moment])
    (os.kill if whom == "it" else os.killpg)(process.pid, signum)
    _, told = process.communicate(timeout=60)
    ended = time.monotonic()
    assert "Traceback" not in told
    if held(folder / "out") != before:  # it came after the end
        assert process.returncode in (0, -signum, 128 + signum)
        assert _is_whole(folder / "out")
        assert moment == "working"
    if signum == signal.SIGKILL:
        assert (process.returncode, told) in ((-signum, ""), (0, ""))
    else:
        assert process.returncode in (0, 128 + signum)
        assert _partial(folder) == []
        assert told.splitlines() == (["error: " + INTERRUPTED] if process.returncode else [])
    while _living(mark) and time.monotonic() < ended + 2:
        time.sleep(0.02)
    assert _living(mark) == []
    prepare(folder / "out")
    assert _partial(folder) == []
    assert held(folder / "out").keys() == before.keys()


@pytest.mark.parametrize("signum", [signal.SIGTERM, signal.SIGHUP, signal.SIGINT], ids=lambda each: each.name)
def test_impatience_does_not_end_the_clearing_away(tmp_path: Path, signum: signal.Signals) -> None:
    config, mark = written_piece(tmp_path), uuid.uuid4().hex
    process = _process(mark, config)
    _wait_for_partial(tmp_path, process)
    while process.poll() is None:
        os.killpg(process.pid, signum)
        time.sleep(0.002)
    assert process.communicate()[1].splitlines() == ["error: " + INTERRUPTED]
    assert process.returncode == 128 + signum
    assert _partial(tmp_path) == _living(mark) == []
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("signum", [signal.SIGHUP, signal.SIGINT], ids=lambda each: each.name)
def test_a_signal_that_is_to_be_ignored_is(tmp_path: Path, signum: signal.Signals) -> None:
    """As nohup does it, and shells for what runs in the background."""
    shown = signal.signal(signum, signal.SIG_IGN)
    try:
        process = _process("ignoring", written_piece(tmp_path), "--until", "wires")
    finally:
        signal.signal(signum, shown)
    _wait_for_partial(tmp_path, process)
    os.killpg(process.pid, signum)
    assert process.communicate(timeout=60)[1] == ""
    assert process.returncode == 0


def test_two_builds_at_once_leave_one_whole(tmp_path: Path) -> None:
    config = written_piece(tmp_path, outputs=["stl"])
    processes = [_process("twin", config, "--force") for _ in range(2)]
    told = [process.communicate(timeout=120)[1] for process in processes]
    assert [process.returncode for process in processes] == [0, 0], told
    assert _is_whole(tmp_path / "out")
    assert _partial(tmp_path) == []


def test_the_temporary_folder_of_a_living_build_is_left_to_it(tmp_path: Path) -> None:
    with staged(tmp_path / "out") as partial:
        (partial / "a.step").write_bytes(b"one")
        run = [
            sys.executable,
            "-c",
            "import sys; from tests.pipeline.folders import put, Path; put(Path(sys.argv[1]), {})",
        ]
        subprocess.run([*run, str(tmp_path / "out")], check=True, timeout=60)
        assert held(partial) == {"a.step": b"one"}


# What calls the program with a command during which the signal comes where its exception is thrown away.
MEANWHILE = """
import signal, sys, time
from importlib import import_module

class Swallows:
    def __del__(self):
        signal.raise_signal(signal.NAME)

def converts():
    try:
        signal.raise_signal(signal.NAME)
    except BaseException:
        raise ImportError("the module could not be initialised") from None

def app(arguments, standalone_mode, prog_name):
    AMID()
    time.sleep(30)

main = import_module("wrapit.cli.main")
main.app = app
sys.argv = ["wrapit", "build"]
main.main()
"""


@pytest.mark.parametrize("signum", [signal.SIGTERM, signal.SIGHUP, signal.SIGINT], ids=lambda each: each.name)
@pytest.mark.parametrize("amid", ["Swallows", "converts"])
def test_a_signal_is_not_lost_with_its_exception(signum: signal.Signals, amid: str) -> None:
    """Python throws away what finalisers raise; native modules amid their loading make ImportErrors of it."""
    script = MEANWHILE.replace("NAME", signum.name).replace("AMID", amid)
    ended = subprocess.run(
        [sys.executable, "-c", script], check=False, capture_output=True, text=True, timeout=20
    )
    assert ended.stderr.splitlines() == ["error: " + INTERRUPTED]
    assert ended.returncode == 128 + signum
