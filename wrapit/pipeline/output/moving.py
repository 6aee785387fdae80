"""Moving finished files into a folder: each place holds the old file, the new one, or somebody else's."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from pathlib import Path

from wrapit.pipeline.output.ownership import REPORT, is_plain_file, is_unchanged, listed_files, own_report


def move_in(ready: Path, folder: Path) -> None:
    """Each file is the old or the new one at any time; done again after a kill, it goes on where it was.

    The report comes last: until then the old one tells which of the old files are wrapit's.
    """
    old, new = listed_files(own_report(folder)), listed_files(own_report(ready))
    for path in sorted(ready.iterdir()):
        if path.name != REPORT:
            path.replace(folder / path.name)
    for name in sorted(old.keys() - new.keys()):
        if is_unchanged(folder / name, [old[name]]):
            (folder / name).unlink()
    (ready / REPORT).replace(folder / REPORT)
    ready.rmdir()


def held_open(ready: Path, folder: Path) -> Iterator[Path]:
    """Files to be replaced or taken away that a program has open, where this forbids it (Windows).

    A new name for a file needs there what taking it away needs, even where it is the old name.
    """
    if sys.platform != "win32":
        return
    for name in sorted({*listed_files(own_report(folder)), *(path.name for path in ready.iterdir())}):
        place = folder / name
        try:
            if is_plain_file(place):
                place.rename(place)
        except PermissionError:
            yield place


def shut_out(ready: Path, folder: Path) -> Iterator[Path]:
    """New files whose places are taken by files that neither report lists as they are."""
    old, new = listed_files(own_report(folder)), listed_files(own_report(ready))
    for path in sorted(ready.iterdir()):
        place = folder / path.name
        own = path.name == REPORT and own_report(folder) is not None
        unchanged = is_unchanged(place, [old.get(path.name), new.get(path.name)])
        if os.path.lexists(place) and not own and not unchanged:
            yield path
