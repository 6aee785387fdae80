"""`init` and `coupon`: what comes before a first piece."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Annotated

import typer

from wrapit.calling import argument, pasted
from wrapit.cli import completing
from wrapit.cli.app import Overrides, app, say


@app.command()
def init(
    drawing: Annotated[
        Path,
        typer.Argument(
            metavar="DRAWING", autocompletion=completing.drawings, help="A bitmap, SVG or JSON drawing."
        ),
    ],
    output: Annotated[
        Path | None,
        typer.Option("-o", "--output", metavar="FILE", help="Default: the drawing's name with .yaml."),
    ] = None,
    preset: Annotated[
        str,
        typer.Option(
            metavar="NAME",
            autocompletion=completing.presets,
            help="Start from what comes with wrapit: pendant, earrings or charm.",
        ),
    ] = "",
) -> None:
    """Write a commented config for a drawing, with sizes proposed from it."""
    target = write_proposal(drawing, output, preset)
    print(f"written: {target}; build it with: {pasted('build', argument(target))}")


def write_proposal(drawing: Path, output: Path | None = None, preset: str = "") -> Path:
    """Writes the config that is proposed for a drawing, and says on stderr what was found; returns its path.

    Raises ConfigError where there is a file already or none can be written, and what `propose_makeable` does.
    """
    from wrapit.errors import ConfigError
    from wrapit.pipeline.textfile import write_whole
    from wrapit.pipeline.trying.proposing import propose_makeable

    target = output if output is not None else drawing.with_suffix(".yaml") if drawing.name else drawing
    elsewhere = f"choose another file: {pasted('init', argument(drawing), '-o', 'FILE')}"
    if drawing.is_file():
        _refuse_taken(target, elsewhere)  # before anybody waits for a proposal
    proposal, held = propose_makeable(drawing, output.parent if output is not None else None, preset)
    _refuse_taken(target, elsewhere)
    try:
        write_whole(target, proposal.text())
    except OSError as error:
        raise ConfigError(f"can't be written ({error.strerror})", str(target), elsewhere) from None
    for finding in proposal.findings:
        say(f"{finding.level}: {finding.where}: {finding.message}")
    remedy = f"see {pasted('check', argument(target))}"
    if proposal.fit:
        say(f"note: {proposal.about_fit} (fit: {proposal.fit})")
    if held == "unheld":
        say(f"warning: no usual size was found at which a jig holds it; {remedy}")
    if held == "tight":
        say(f"warning: at every usual size some bends are tighter than this wire takes; {remedy}")
    return target


def _refuse_taken(target: Path, elsewhere: str) -> None:
    from wrapit.errors import ConfigError

    if os.path.lexists(target):
        raise ConfigError("exists already", str(target), elsewhere)


@app.command()
def coupon(
    configs: Annotated[
        list[Path] | None,
        typer.Argument(
            metavar="CONFIG",
            autocompletion=completing.configs,
            help="Take wire, kerf and clearance from these configs.",
        ),
    ] = None,
    output: Annotated[Path, typer.Option("-o", "--output", metavar="DIR", help="Where to write.")] = Path(
        "build"
    ),
    overrides: Overrides = None,
) -> None:
    """Write test pieces: a kerf coupon to cut, a clearance coupon to print."""
    from wrapit.config.loading import config_without_drawing
    from wrapit.pipeline.coupon_files import write_coupons

    chosen = config_without_drawing(configs or (), overrides or ())
    cut, printed = write_coupons(chosen, output)
    print(f"cut {cut}: the slot that takes the wire without play tells plate.kerf,")
    print("    the pocket that takes the key tells plate.fit")
    print(f"print {printed}: the narrowest channel that takes the wire easily tells jig.clearance")
