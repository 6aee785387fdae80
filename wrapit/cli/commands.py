"""The commands, each a thin wrapper: everything heavy is imported inside them."""

from __future__ import annotations

import json
import os
import shlex
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from wrapit.cli.app import AsJson, ConfigPath, Overrides, Quiet, Verbose, app, show, with_progress

if TYPE_CHECKING:
    from wrapit.pipeline.build import Build
    from wrapit.pipeline.work import Stage


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
    result = with_progress(
        lambda progress: run(config, output, overrides or (), stage, force, alternatives, progress),
        quiet or as_json,
    )
    if depfile is not None:
        _write_depfile(depfile, result)
    show(result, as_json, quiet, verbose)


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

    result = with_progress(lambda progress: run(config, overrides or (), progress, exact), quiet or as_json)
    show(result, as_json, quiet, verbose)


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
