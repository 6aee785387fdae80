"""`build` and `check`: a piece from its config."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from wrapit.calling import argument, pasted
from wrapit.cli import completing
from wrapit.cli.app import (
    AsJson,
    Configs,
    DumpConfig,
    Overrides,
    Quiet,
    Verbose,
    app,
    dump,
    show,
    with_progress,
)

if TYPE_CHECKING:
    from wrapit.pipeline.build import Build
    from wrapit.pipeline.work import Stage


@app.command()
def build(
    configs: Configs,
    output: Annotated[
        Path | None, typer.Option("-o", "--output", metavar="DIR", help="Default: build/<name>.")
    ] = None,
    overrides: Overrides = None,
    until: Annotated[
        str,
        typer.Option(
            metavar="STAGE",
            autocompletion=completing.stages,
            help="Stop after drawing, decomposition, wires, jig or exports.",
        ),
    ] = "exports",
    force: Annotated[bool, typer.Option("--force", help="Build even if nothing changed.")] = False,
    alternatives: Annotated[
        int,
        typer.Option(
            min=0,
            max=12,
            metavar="K",
            help="Also draw the K best ways to divide it into wires, and what fewer wires cost.",
        ),
    ] = 0,
    choose: Annotated[
        int | None,
        typer.Option(
            min=1, max=1000, metavar="N", help="Take the N-th best of them: --set decomposition.choice=N."
        ),
    ] = None,
    depfile: Annotated[
        Path | None,
        typer.Option("-MF", "--depfile", metavar="FILE", help="Write what the build depends on, for make."),
    ] = None,
    dump_config: DumpConfig = False,
    as_json: AsJson = False,
    quiet: Quiet = False,
    verbose: Verbose = 0,
) -> None:
    """Build a piece: drawing, wires, jig and guide."""
    chosen = [*(overrides or ()), *([f"decomposition.choice={choose}"] if choose is not None else [])]
    if dump_config:
        dump(configs, chosen, as_json)
        return
    from wrapit.pipeline.build import build as run

    stage = _stage(until)
    result = with_progress(
        lambda progress: run(configs, output, chosen, stage, force, alternatives, progress),
        quiet or as_json,
    )
    if depfile is not None:
        _write_depfile(depfile, result)
    more: dict[str, str] = {}
    if alternatives > 1:
        more["alternatives"] = _command(configs, output, overrides, "--choose", "2")
    if alternatives and len(front := result.report.get("fewer_wires", [])) > 1:
        least = f"decomposition.max_wires={front[-1]['max_wires']}"
        more["fewer wires"] = _command(configs, output, [*(overrides or ()), least])
    show(result, as_json, quiet, verbose, more)


def _command(configs: list[Path], output: Path | None, overrides: list[str] | None, *options: str) -> str:
    """The build once more, with options of another kind."""
    where = ["-o", str(output)] if output is not None else []
    changes = [word for override in overrides or () for word in ("--set", override)]
    return pasted("build", *map(argument, configs), *where, *changes, *options)


def _write_depfile(path: Path, result: Build) -> None:
    from wrapit.pipeline.depfile import write_depfile
    from wrapit.pipeline.output.ownership import REPORT

    assert result.folder is not None, "a build has a folder"
    names = {a[key] for a in result.report["artifacts"] for key in ("path", "instead_of") if key in a}
    products = [result.folder / name for name in sorted(names)]
    write_depfile(path, result.folder / REPORT, result.sources, products)


@app.command()
def check(
    configs: Configs,
    overrides: Overrides = None,
    dump_config: DumpConfig = False,
    as_json: AsJson = False,
    quiet: Quiet = False,
    verbose: Verbose = 0,
    exact: Annotated[
        bool,
        typer.Option("--exact", help="Also cut the jig with each wire: proof that they don't touch."),
    ] = False,
) -> None:
    """Say whether a piece can be made, and what to change; writes nothing."""
    if dump_config:
        dump(configs, overrides, as_json)
        return
    from wrapit.pipeline.build import check as run

    result = with_progress(lambda progress: run(configs, overrides or (), progress, exact), quiet or as_json)
    show(result, as_json, quiet, verbose)


def _stage(name: str) -> Stage:
    from wrapit.pipeline.work import STAGES

    for stage in STAGES:
        if stage == name:
            return stage
    raise typer.BadParameter(f"{name!r} is not one of {', '.join(STAGES)}", param_hint="--until")
