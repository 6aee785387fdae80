"""The commands, each a thin wrapper: everything heavy is imported inside them."""

from __future__ import annotations

import json
import os
import shlex
import sys
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from wrapit import __version__

if TYPE_CHECKING:
    from wrapit.pipeline.build import Build
    from wrapit.pipeline.work import Stage

app = typer.Typer(
    name="wrapit",
    add_completion=False,
    context_settings={"help_option_names": ["-h", "--help"]},
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
    help="Turns a line drawing into wire-wrapped jewellery: wires, a jig that bends them, and the guide.",
    epilog="Exit codes: 0 ok, 1 failure while building, 2 usage or config, "
    "3 the drawing can't be made as asked.",
)

ConfigPath = Annotated[Path, typer.Argument(metavar="CONFIG", help="The piece's YAML config.")]
Overrides = Annotated[
    list[str] | None,
    typer.Option("--set", metavar="KEY=VALUE", help="Change one key, for example size='50 mm'."),
]
AsJson = Annotated[bool, typer.Option("--json", help="Print the report as one JSON document.")]
Quiet = Annotated[bool, typer.Option("--quiet", "-q", help="Print nothing but errors.")]
Verbose = Annotated[int, typer.Option("--verbose", "-v", count=True, help="Say more; -vv shows tracebacks.")]


def say(line: str) -> None:
    """One line for the person, on stderr."""
    print(line, file=sys.stderr)


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


@app.command()
def build(
    config: ConfigPath,
    output: Annotated[
        Path | None, typer.Option("-o", "--output", metavar="DIR", help="Default: build/<name>.")
    ] = None,
    overrides: Overrides = None,
    until: Annotated[
        str, typer.Option(metavar="STAGE", help="Stop after drawing, decomposition, wires, jig or exports.")
    ] = "exports",
    force: Annotated[bool, typer.Option("--force", help="Build even if nothing changed.")] = False,
    alternatives: Annotated[
        int,
        typer.Option(min=0, max=12, metavar="K", help="Also draw the K best ways to divide it into wires."),
    ] = 0,
    depfile: Annotated[
        Path | None,
        typer.Option("-MF", "--depfile", metavar="FILE", help="Write what the build depends on, for make."),
    ] = None,
    as_json: AsJson = False,
    quiet: Quiet = False,
    verbose: Verbose = 0,
) -> None:
    """Build a piece: drawing, wires, jig and guide."""
    from wrapit.pipeline.build import build as run

    stage = _stage(until)
    result = _with_progress(
        lambda progress: run(config, output, overrides or (), stage, force, alternatives, progress),
        quiet or as_json,
    )
    if depfile is not None:
        _write_depfile(depfile, result)
    _show(result, as_json, quiet, verbose)


def _write_depfile(path: Path, result: Build) -> None:
    from wrapit.pipeline.depfile import write_depfile
    from wrapit.pipeline.output.ownership import REPORT

    assert result.folder is not None, "a build has a folder"
    names = {a[key] for a in result.report["artifacts"] for key in ("path", "instead_of") if key in a}
    products = [result.folder / name for name in sorted(names)]
    write_depfile(path, result.folder / REPORT, result.sources, products)


@app.command()
def init(
    drawing: Annotated[Path, typer.Argument(metavar="DRAWING", help="A bitmap, SVG or JSON drawing.")],
    output: Annotated[
        Path | None,
        typer.Option("-o", "--output", metavar="FILE", help="Default: the drawing's name with .yaml."),
    ] = None,
) -> None:
    """Write a commented config for a drawing, with sizes proposed from it."""
    from wrapit.drawing.proposal import propose_config
    from wrapit.errors import ConfigError
    from wrapit.pipeline.textfile import write_whole

    text = propose_config(drawing, output.parent if output is not None else None)
    target = output if output is not None else drawing.with_suffix(".yaml")
    if os.path.lexists(target):
        raise ConfigError("exists already", str(target), "choose another file with -o")
    try:
        write_whole(target, text)
    except OSError as error:
        raise ConfigError(
            f"can't be written ({error.strerror})", str(target), "choose another file with -o"
        ) from None
    argument = shlex.quote(f"./{target}" if str(target).startswith("-") else str(target))
    print(f"written: {target}; build it with: wrapit build {argument}")


@app.command()
def check(
    config: ConfigPath,
    overrides: Overrides = None,
    as_json: AsJson = False,
    quiet: Quiet = False,
    verbose: Verbose = 0,
    exact: Annotated[
        bool,
        typer.Option("--exact", help="Also cut the jig with each wire: proof that they don't touch."),
    ] = False,
) -> None:
    """Say whether a piece can be made, and what to change; writes nothing."""
    from wrapit.pipeline.build import check as run

    result = _with_progress(lambda progress: run(config, overrides or (), progress, exact), quiet or as_json)
    _show(result, as_json, quiet, verbose)


@app.command()
def coupon(
    config: Annotated[
        Path | None,
        typer.Argument(metavar="[CONFIG]", help="Take wire, kerf and clearance from this config."),
    ] = None,
    output: Annotated[Path, typer.Option("-o", "--output", metavar="DIR", help="Where to write.")] = Path(
        "build"
    ),
    overrides: Overrides = None,
) -> None:
    """Write test pieces: a kerf coupon to cut, a clearance coupon to print."""
    from wrapit.config import load_config
    from wrapit.config.loading import default_config
    from wrapit.pipeline.coupon_files import write_coupons

    chosen = load_config(config, overrides or ()) if config else default_config(overrides or ())
    cut, printed = write_coupons(chosen, output)
    print(f"cut {cut}: the slot that takes the wire without play tells plate.kerf,")
    print("    the pocket that takes the key tells plate.fit")
    print(f"print {printed}: the narrowest channel that takes the wire easily tells jig.clearance")


@app.command()
def schema() -> None:
    """Print the JSON schema of the config."""
    from wrapit.config import schema as config_schema

    print(json.dumps(config_schema(), indent=1, ensure_ascii=False))


@app.command()
def materials() -> None:
    """Print the metals and wire gauges that wrapit knows."""
    from wrapit.materials import METALS, min_inner_bend_radius_mm
    from wrapit.units import SWG_MM, awg_diameter_mm

    print(f"{'metal':<18}{'density g/cm³':>14}{'E GPa':>8}   proof stress MPa (dead soft, half hard, hard)")
    for metal in METALS.values():
        stresses = ", ".join(f"{stress:g}" for stress in metal.proof_mpa.values())
        print(f"{metal.name:<18}{metal.density_g_per_cm3:>14.2f}{metal.young_gpa:>8.0f}   {stresses}")
    print(f"\n{'gauge':<9}{'mm':>6}   tightest inner bend of dead-soft wire, mm")
    gauges = [(f"{n} AWG", awg_diameter_mm(n)) for n in (*range(12, 22, 2), 21, *range(22, 32, 2))]
    for name, diameter in sorted(
        [*gauges, *((f"swg{n}", mm) for n, mm in SWG_MM.items())], key=lambda g: -g[1]
    ):
        print(f"{name:<9}{diameter:>6.2f}   {min_inner_bend_radius_mm(diameter, 'dead soft'):.2f}")


def _stage(name: str) -> Stage:
    from wrapit.pipeline.work import STAGES

    for stage in STAGES:
        if stage == name:
            return stage
    raise typer.BadParameter(f"{name!r} is not one of {', '.join(STAGES)}", param_hint="--until")


def _with_progress(run: Callable[[Callable[[str], None]], Build], quiet: bool) -> Build:
    if quiet or not sys.stderr.isatty():
        return run(lambda stage: None)
    from rich.console import Console

    with Console(stderr=True).status("starting") as status:
        return run(lambda stage: status.update(f"{stage} …"))


def _show(result: Build, as_json: bool, quiet: bool, verbose: int) -> None:
    if as_json:
        print(json.dumps({**result.report, "timings_s": result.timings_s}, allow_nan=False))
        return
    if quiet:
        return
    from wrapit.pipeline.summary import finding_lines, summary_lines

    for line in summary_lines(result):
        print(line)
    sys.stdout.flush()
    for line in finding_lines(result, every=verbose > 0):
        say(line)
    if verbose:
        for stage, seconds in result.timings_s.items():
            say(f"{stage:<14}{seconds:7.2f} s")
