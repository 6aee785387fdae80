"""The same command with a real Dask scheduler and workers in processes of their own, one of them killed."""

from __future__ import annotations

import os
import re
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.batch.catalogues import PATIENCE_S, ROOT, awaited, builds, ledger, ring, run, started, statuses
from wrapit.batch.cluster import connected
from wrapit.errors import ConfigError
from wrapit.pipeline.output.ownership import is_whole, own_report

pytest.importorskip("distributed", reason="needs wrapit[cluster]")


def dask(folder: Path, kind: str, *arguments: str) -> subprocess.Popen[str]:
    """A scheduler or worker; what it says goes to a file, for nobody reads a pipe here."""
    with (folder / f"{kind}-{time.monotonic_ns()}.log").open("w") as log:
        return subprocess.Popen(
            [sys.executable, "-m", f"distributed.cli.dask_{kind}", *arguments, "--no-dashboard"],
            cwd=folder,
            env={**os.environ, "PYTHONPATH": str(ROOT)},
            stdout=log,
            stderr=log,
            text=True,
        )


def worker(folder: Path, address: str) -> subprocess.Popen[str]:
    """No nanny: a kill ends the worker for good."""
    return dask(folder, "worker", address, "--nthreads", "1", "--no-nanny", "--local-directory", str(folder))


@pytest.fixture(scope="module")
def cluster(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[str, list[subprocess.Popen[str]]]]:
    """A scheduler's address, and its two workers."""
    folder = tmp_path_factory.mktemp("cluster")
    processes = [dask(folder, "scheduler", "--host", "127.0.0.1", "--port", "0")]
    try:

        def address() -> str | None:
            said = "".join(path.read_text() for path in folder.glob("scheduler-*.log"))
            found = re.search(r"tcp://127\.0\.0\.1:[1-9]\d*", said)
            return found[0] if found else None

        at = awaited(address, "the scheduler's address")
        workers = [worker(folder, at), worker(folder, at)]
        processes += workers
        yield at, workers
    finally:
        for process in reversed(processes):
            process.kill()
            process.wait()


@pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="needs /proc to see processes")
def test_a_worker_killed_amid_its_work_loses_nothing(
    tmp_path: Path, cluster: tuple[str, list[subprocess.Popen[str]]]
) -> None:
    address, workers = cluster
    configs = [ring(tmp_path, f"piece{number}") for number in range(4)]
    bad = ring(tmp_path, "bad", drawing="blank.svg")
    (tmp_path / "blank.svg").write_text('<svg xmlns="http://www.w3.org/2000/svg" width="9mm" height="9mm"/>')
    batch = started(tmp_path, *configs, bad, "--scheduler", address)

    def busy() -> int | None:
        return next((w.pid for w in workers for n in range(4) if builds(w.pid, f"piece{n}")), None)

    victim = awaited(busy, "a worker at work")
    os.kill(victim, signal.SIGKILL)
    _, complaint = batch.communicate(timeout=PATIENCE_S)
    assert batch.returncode == 1, complaint
    assert statuses(tmp_path) == {**{f"piece{n}": "ok" for n in range(4)}, "bad": "failed"}
    (failure,) = [piece["error"] for piece in ledger(tmp_path)["pieces"] if piece["status"] == "failed"]
    assert failure["code"] == "drawing"
    assert failure["where"] == "blank.svg" or failure["where"] == str(tmp_path / "blank.svg")
    for config in configs:
        report = own_report(tmp_path / "out" / config.stem)
        assert report is not None
        assert is_whole(tmp_path / "out" / config.stem, report)
    assert len(complaint.splitlines()) == len(configs) + 1

    code, _, complaint = run(tmp_path, *configs, "--scheduler", address)
    assert code == 0
    assert complaint.count("up to date") == len(configs)


def test_the_kernel_works_on_a_worker(
    tmp_path: Path, cluster: tuple[str, list[subprocess.Popen[str]]]
) -> None:
    config = ring(tmp_path, "solid", jigs=["printed"], outputs=["stl"])
    code, _, complaint = run(tmp_path, config, "--scheduler", cluster[0])
    assert code == 0, complaint
    assert (tmp_path / "out" / "solid" / "jig.stl").stat().st_size > 1000


@pytest.mark.parametrize(
    "address",
    ["", "nonsense://x:1", "tcp://127.0.0.1", "tcp://127.0.0.1:none", "127.0.0.1:8786", "tcp://:1\n"],
)
def test_what_is_no_address_is_refused_at_once(address: str) -> None:
    with pytest.raises(ConfigError, match="not an address") as refused, connected(address):
        pass
    assert "dask scheduler" in refused.value.remedy
    assert len(str(refused.value).splitlines()) == 1


def test_no_scheduler_is_one_line(tmp_path: Path) -> None:
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        port = taken.getsockname()[1]
    code, _, complaint = run(tmp_path, ring(tmp_path, "a"), "--scheduler", f"tcp://127.0.0.1:{port}")
    assert code == 2, complaint
    assert len(complaint.splitlines()) == 1
    assert "no scheduler answers" in complaint
    assert "dask scheduler" in complaint
    assert not (tmp_path / "out" / "batch.json").exists()


def test_without_dask_it_is_said_how_to_get_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(ConfigError) as refused, connected("tcp://127.0.0.1:1"):
        pass
    assert 'pip install "wrapit[cluster]"' in refused.value.remedy
