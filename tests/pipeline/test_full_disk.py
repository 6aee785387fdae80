"""A disk that fills up: one line that says so, nothing left on it, and no cut-off file taken for good."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.pipeline.folders import written_piece
from tests.pipeline.test_command_line import WRAPIT, refused

Run = subprocess.CompletedProcess[str]
REMEDY = "free space, or choose another folder with -o"
# On a small disk: runs what follows, and lists what is there at the end.
ON_A_DISK = """
mount -t tmpfs -o size="$2"k tmpfs "$1" || exit 77
disk=$1; shift 2; "$@"; code=$?
find "$disk" -mindepth 1 -printf "%P\\n"
exit $code
"""
# Each of the kernel's files on disks of more and more pages.
EVERY_SIZE = """
import subprocess, sys
from pathlib import Path
import cadquery
from wrapit.kernel.files import FilePart, write_3mf, write_step, write_stl

disk, whole = Path(sys.argv[1]), Path(sys.argv[2])
box = cadquery.Workplane().box(9, 8, 7).edges().fillet(1).val().wrapped
writers = {
    "a.step": lambda path: write_step(path, "box", [FilePart("part", box, "#cc8844")]),
    "a.stl": lambda path: write_stl(path, [box], 0.01),
    "a.3mf": lambda path: write_3mf(path, [FilePart("part", box, "#cc8844")]),
}
for name, write in writers.items():
    write(whole / name)
    data = (whole / name).read_bytes()
    pages = -(-len(data) // 4096)
    # The kernel's own text of a STEP file is larger: it says the same things again and again.
    enough = 3 * pages if name == "a.step" else pages
    for size in sorted({1, 2, pages // 2, pages - 2, pages - 1, pages, enough, enough + 1} - {0, -1}):
        subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={4 * size}k", "tmpfs", disk], check=True)
        try:
            write(disk / name)
        except Exception as error:
            print(name, size, "of", pages, "refused" if size < enough else f"REFUSED: {error}")
        else:
            right = size >= pages and (disk / name).read_bytes() == data
            print(name, size, "of", pages, "whole" if right else "CUT OFF")
        subprocess.run(["umount", disk], check=True)
"""


@pytest.fixture(scope="session", autouse=True)
def _mounting() -> None:
    if sys.platform != "linux" or subprocess.run(["unshare", "-rm", "true"], check=False).returncode:
        pytest.skip("no disk can be mounted here without being the administrator")


@pytest.fixture
def on_disk(tmp_path: Path) -> Callable[..., Run]:
    """Builds a piece of 0.6 MB (two STEP files of 0.1, an STL of 0.3) into a disk of so many kB."""
    config = written_piece(tmp_path, outputs=["step", "stl"])
    disk = tmp_path / "disk"
    disk.mkdir()

    def run(kilobytes: int, out: Path) -> Run:
        command = ["unshare", "-rm", "sh", "-c", ON_A_DISK, "sh", str(disk), str(kilobytes)]
        command += [*WRAPIT, "build", str(config), "-q", "-o", str(out)]
        return subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)

    return run


@pytest.mark.parametrize("kilobytes", [8, 100, 240, 400, 480])
def test_a_full_disk_is_one_line_and_leaves_nothing(
    tmp_path: Path, on_disk: Callable[..., Run], kilobytes: int
) -> None:
    out = tmp_path / "disk" / "out"
    run = on_disk(kilobytes, out)
    refused(run, 1, str(out), "o space left on device", REMEDY)
    assert ".partial" not in run.stderr


def test_a_disk_may_be_the_folder_itself(tmp_path: Path, on_disk: Callable[..., Run]) -> None:
    run = on_disk(1600, tmp_path / "disk")
    assert (run.returncode, run.stderr) == (0, "")
    assert {"jig.step", "jig.stl", "wires.step", "report.json"} <= set(run.stdout.splitlines())
    refused(on_disk(100, tmp_path / "disk"), 1, "o space left on device", REMEDY)


def test_a_file_of_the_kernel_is_whole_or_refused(tmp_path: Path) -> None:
    for folder in ("disk", "whole"):
        (tmp_path / folder).mkdir()
    command = ["unshare", "-rm", sys.executable, "-c", EVERY_SIZE, tmp_path / "disk", tmp_path / "whole"]
    run = subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)
    assert run.returncode == 0, run.stderr
    lines = [line for line in run.stdout.splitlines() if line.startswith("a.")]
    assert len(lines) >= 3 * 4
    assert [line for line in lines if not line.endswith((" refused", " whole"))] == []
