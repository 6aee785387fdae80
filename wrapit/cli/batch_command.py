"""The command that builds many pieces."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from wrapit.cli import completing
from wrapit.cli.app import AsJson, Overrides, Quiet, Verbose, app, say

if TYPE_CHECKING:
    from wrapit.batch.model import Outcome
    from wrapit.batch.stage import Batch


@app.command()
def batch(
    configs: Annotated[
        list[Path],
        typer.Argument(
            metavar="CONFIG",
            autocompletion=completing.config_files,
            help="Configs, and folders of them.",
            show_default=False,
        ),
    ],
    output: Annotated[
        Path, typer.Option("-o", "--output", metavar="DIR", help="Holds <name>/ for each, and index.html.")
    ] = Path("build"),
    jobs: Annotated[
        int | None,
        typer.Option(
            min=1, metavar="N", help="Pieces at once; half the cores unless given.", show_default=False
        ),
    ] = None,
    scheduler: Annotated[
        str | None,
        typer.Option(metavar="ADDRESS", help="Build on the workers of a Dask scheduler, tcp://HOST:PORT."),
    ] = None,
    resume: Annotated[
        bool, typer.Option("--resume", help="Go on: start only what failed, is missing or changed.")
    ] = False,
    price: Annotated[
        list[str] | None,
        typer.Option(metavar="METAL=AMOUNT", help="What a kilogram costs, for example 'copper=12.50 EUR'."),
    ] = None,
    overrides: Overrides = None,
    as_json: AsJson = False,
    quiet: Quiet = False,
    verbose: Verbose = 0,
) -> int:
    """Build many pieces, and a catalogue of them."""
    from wrapit.batch.pricing import read_prices
    from wrapit.batch.stage import run_batch

    if jobs is not None and scheduler is not None:
        raise typer.BadParameter("a scheduler's workers say how many run at once", param_hint="--jobs")
    with _progress(quiet, verbose) as (begun, told):
        result = run_batch(
            configs,
            output,
            jobs=jobs,
            scheduler=scheduler,
            resume=resume,
            overrides=overrides or (),
            prices=read_prices(price or ()),
            begun=begun,
            told=told,
            say=say,
        )
    _show(result, output, as_json, quiet)
    return 1 if result.any_failed else 0


@contextmanager
def _progress(
    quiet: bool, verbose: int
) -> Iterator[tuple[Callable[[int], None], Callable[[Outcome, dict[str, Any]], None]]]:
    """Tells of each piece as it is done, on stderr; in a terminal also how many there are yet to come."""
    from rich.console import Console

    from wrapit.batch.telling import done_line

    console = Console(stderr=True, highlight=False, markup=False, emoji=False)
    status = console.status("starting")
    count, number = 0, 0

    def begun(pieces: int) -> None:
        nonlocal count
        count = pieces

    def told(outcome: Outcome, entry: dict[str, Any]) -> None:
        nonlocal number
        number += 1
        status.update(f"{number} of {count} pieces …")
        if not quiet or entry["status"] != "ok":
            say(done_line(outcome, entry, number=number, count=count))
        if verbose:
            for stage, seconds in outcome.ended.timings_s.items():
                say(f"  {stage:<14}{seconds:7.2f} s")

    if quiet or not sys.stderr.isatty():
        yield begun, told
        return
    with status:
        yield begun, told


def _show(result: Batch, folder: Path, as_json: bool, quiet: bool) -> None:
    from wrapit.batch.telling import summary_lines

    if as_json:
        print(json.dumps({**result.document, "timings_s": result.timings_s}, allow_nan=False))
    elif not quiet:
        for line in summary_lines(result.document, folder):
            print(line)
