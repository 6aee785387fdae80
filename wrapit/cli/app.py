"""The program that commands belong to, and what they share: options, progress, what is shown at the end."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from wrapit import __version__
from wrapit.calling import PROGRAM
from wrapit.cli import completing
from wrapit.cli.ending import heed
from wrapit.units import printable

if TYPE_CHECKING:
    from wrapit.pipeline.build import Build

app = typer.Typer(
    name=PROGRAM,
    context_settings={"help_option_names": ["-h", "--help"]},
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
    help="Turns a line drawing into wire-wrapped jewellery: wires, a jig that bends them, and the guide.",
    epilog="Exit codes: 0 ok, 1 failure while building, 2 usage or config, "
    "3 the drawing can't be made as asked.",
)

Configs = Annotated[
    list[Path],
    typer.Argument(
        metavar="CONFIG",
        autocompletion=completing.configs,
        help="The piece's YAML config; several are merged left to right, :pendant and the like come with it.",
    ),
]
Overrides = Annotated[
    list[str] | None,
    typer.Option(
        "--set",
        metavar="KEY=VALUE",
        autocompletion=completing.overrides,
        help="Change one key, for example size='50 mm'.",
    ),
]
DumpConfig = Annotated[
    bool, typer.Option("--dump-config", help="Print the whole config, defaults too, and stop.")
]
AsJson = Annotated[bool, typer.Option("--json", help="Print the report as one JSON document.")]
Quiet = Annotated[bool, typer.Option("--quiet", "-q", help="Print nothing but errors.")]
Verbose = Annotated[int, typer.Option("--verbose", "-v", count=True, help="Say more; -vv shows tracebacks.")]


def say(line: str) -> None:
    """One line for the person, on stderr; what names of files hold for the terminal is spelled out."""
    print(printable(line), file=sys.stderr)


def _version(wanted: bool) -> None:
    if wanted:
        print(f"wrapit {__version__}")
        raise typer.Exit


@app.callback()
def _options(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Print the version.")
    ] = False,
) -> None:
    pass


def dump(configs: list[Path], overrides: list[str] | None, as_json: bool) -> None:
    """Prints the effective config, as `config.lock.yaml` has it; raises ConfigError."""
    from wrapit.config import load_config, lock_text

    config = load_config(configs, overrides or ())
    if as_json:
        print(json.dumps(config.model_dump(mode="json", exclude_none=True)))
    else:
        print(lock_text(config), end="")


def with_progress(run: Callable[[Callable[[str], None]], Build], quiet: bool) -> Build:
    """What `run` returns; in a terminal, the stage that it says it is at is shown meanwhile."""
    if quiet or not sys.stderr.isatty():
        return run(lambda stage: heed())
    from rich.console import Console

    with Console(stderr=True).status("starting") as status:

        def told(stage: str) -> None:
            heed()
            status.update(f"{stage} …")

        return run(told)


def show(result: Build, as_json: bool, quiet: bool, verbose: int, take: Mapping[str, str] = {}) -> None:
    """Prints what a build made: the report as one document, or its summary and findings.

    `take` are commands that build it with other wires, by what they are.
    """
    if as_json:
        print(json.dumps({**result.report, "timings_s": result.timings}, allow_nan=False))
        return
    if quiet:
        return
    from wrapit.pipeline.summary import finding_lines, summary_lines, timing_lines

    for line in summary_lines(result, take):
        print(line)
    sys.stdout.flush()
    for line in finding_lines(result, every=verbose > 0):
        say(line)
    if verbose:
        for line in timing_lines(result):
            say(line)
