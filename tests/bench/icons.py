"""Icons of public packages, unpacked in a folder: SVG against its ink, or its rendering against the SVG.

Run as `python -m tests.bench icons FOLDER … [--most N]`; with `--rendered` the stroked ones are rendered at
400 and 1000 px and compared with what their SVG says. `--most N` takes N of each folder, evenly.
"""

from __future__ import annotations

import argparse
import tempfile
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from PIL import Image

from tests.drawing.svg.ink import HARMLESS, Verdict, against_ink, rendered
from wrapit.config import TracingConfig
from wrapit.errors import WrapItError

SIZES_PX = (400, 1000)
# Parts apart are joined, so that nearly all of an icon is judged; the links are known by their length.
JOINED = TracingConfig(components="join")
# Findings of what is done to lines that were all read: they excuse no missing ink.
ABOUT_LINES = {"joined", "drawn-twice", "left-out"}
GOOD = {"as drawn", "less, and said so", "refused"}
WORST = 12


def chosen(folder: Path, most: int | None) -> list[Path]:
    """Icons anywhere below a folder, evenly over all in order of their names."""
    found = sorted(path for path in folder.rglob("*.svg") if path.is_file())
    if most is None or len(found) <= most:
        return found
    return [found[k * len(found) // most] for k in range(most)]


def judged(verdict: Verdict) -> str:
    """In a few words, how a reading stands to the ink."""
    told = {finding.code for finding in verdict.findings} - ABOUT_LINES
    # Dashed lines are read whole, and say so: between the dashes there is no ink.
    if verdict.shares.extra >= HARMLESS + verdict.linked and "dashed" not in told:
        return "curves outside the ink"
    if verdict.true:
        return "as drawn"
    return "less, and said so" if told else "ink missing, not a word"


def as_svg(paths: list[Path]) -> Iterator[tuple[Path, str, float, str]]:
    """(icon, judgement, how bad, details) of each."""
    for path in paths:
        try:
            verdict = against_ink(path, JOINED, 400)
        except WrapItError as error:
            yield path, "refused", 0.0, error.problem
            continue
        except Exception as error:  # noqa: BLE001  a crash is a result here
            yield path, "crash", 1.0, f"{type(error).__name__}: {str(error)[-100:]}"
            continue
        shares, codes = verdict.shares, sorted({finding.code for finding in verdict.findings})
        details = f"ink missed {shares.missed:.3f}, curves without {shares.extra:.3f}, left out "
        details += f"{verdict.left_out:.3f}, links {verdict.linked:.3f} {' '.join(codes)}"
        yield path, judged(verdict), max(shares.missed - verdict.left_out, shares.extra), details


def as_pictures(paths: list[Path], compare: Any) -> Iterator[tuple[Path, str, float, str]]:
    """The same of the renderings of those icons that are read as they are drawn, in one piece.

    Of several pieces as long as each other either may stay, and a loop by itself may begin anywhere.
    """
    with tempfile.TemporaryDirectory() as folder:
        for path in paths:
            try:
                verdict = against_ink(path, TracingConfig(), 400)
            except Exception:  # noqa: BLE001  the other benchmark tells of these
                continue
            truth = compare.read(path)
            if judged(verdict) != "as drawn" or verdict.findings or truth["degrees"] == ((2, 1),):
                continue
            for size in SIZES_PX:
                picture = Path(folder) / f"{size}.png"
                Image.fromarray(rendered(path, size)[0]).save(picture)
                said = compare.wrong(compare.read(picture), truth, 0.02, True)
                yield path, f"{size} px: {'other' if said else 'as drawn'}", float(bool(said)), said


def main(words: list[str] | None = None) -> None:
    """Prints shares of each folder and of all, and the worst icons."""
    parser = argparse.ArgumentParser(prog="python -m tests.bench icons")
    parser.add_argument("folders", nargs="*", type=Path)
    parser.add_argument("--most", type=int)
    parser.add_argument("--rendered", action="store_true")
    asked = parser.parse_args(words or [])
    if not asked.folders:
        print("name a folder with icons: python -m tests.bench icons FOLDER … [--most N] [--rendered]")
        return
    whole: Counter[str] = Counter()
    bad: list[tuple[float, str, Path, str]] = []
    for folder in asked.folders:
        counts: Counter[str] = Counter()
        icons = chosen(folder, asked.most)
        for path, said, how_bad, details in _rows(icons, asked.rendered):
            counts[said] += 1
            if said not in GOOD and not said.endswith("as drawn"):
                bad.append((how_bad, said, path, details))
        whole += counts
        print(f"{str(folder)[-48:]:48} {len(icons):5} icons  {_shares(counts)}", flush=True)
    print(f"{'all':48} {'':5}        {_shares(whole)}")
    for _, said, path, details in sorted(bad, key=lambda row: (-row[0], str(row[2])))[:WORST]:
        print(f"  {said:24} {path}  {details}")


def _rows(icons: list[Path], as_rendered: bool) -> Iterator[tuple[Path, str, float, str]]:
    if not as_rendered:
        return as_svg(icons)
    from tests.bench.cases import scorer

    return as_pictures(icons, scorer())


def _shares(counts: Counter[str]) -> str:
    return ", ".join(f"{said} {count}" for said, count in sorted(counts.items()))


if __name__ == "__main__":
    import sys

    main(sys.argv[1:])
