"""`wrapit studio`: a page on this machine to work on a piece."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from wrapit.calling import argument, pasted
from wrapit.cli import completing
from wrapit.cli.app import app, say
from wrapit.cli.starting import write_proposal


@app.command()
def studio(
    piece: Annotated[
        Path,
        typer.Argument(
            metavar="CONFIG|DRAWING",
            autocompletion=completing.pieces,
            help="A config, or a drawing that gets one beside it.",
        ),
    ],
    output: Annotated[
        Path | None, typer.Option("-o", "--output", metavar="DIR", help="Default: build/<name>.")
    ] = None,
    port: Annotated[int, typer.Option(min=0, max=65535, help="Where to listen; 0 takes a free one.")] = 0,
    no_browser: Annotated[
        bool, typer.Option("--no-browser", help="Print the link, and open no browser.")
    ] = False,
) -> None:
    """Work on a piece in the browser: see it, click what should change; the YAML follows."""
    from wrapit.studio.server import serve

    serve(_config(piece), output, port, browser=not no_browser)


def _config(piece: Path) -> Path:
    """The config that is meant: the file itself, or the one beside a drawing, which is made where none is."""
    from wrapit.config.texts.presets import is_preset, preset_file
    from wrapit.errors import ConfigError

    if is_preset(piece):
        command = pasted("init", "DRAWING", "--preset", preset_file(piece).stem)
        raise ConfigError("a preset has no drawing of its own", str(piece), f"make a config of it: {command}")
    if piece.suffix.lower() in (".yaml", ".yml") or not piece.suffix:
        if not piece.is_file():
            raise ConfigError("no such config", str(piece), "give a config, or a drawing to begin with")
        return piece
    config = piece.with_suffix(".yaml")
    if not config.is_file():
        say(f"written: {write_proposal(piece)}")
    elif named := _another_drawing(config, piece):
        other = argument(piece.with_name(f"{piece.stem}-2.yaml"))
        command = pasted("init", argument(piece), "-o", other)
        problem = f"the config beside the drawing is another's ({named})"
        raise ConfigError(problem, str(config), f"give the config itself, or make one more: {command}")
    return config


def _another_drawing(config: Path, drawing: Path) -> str | None:
    """What a config names instead of a drawing; None where it names that, or the page has to say more."""
    from wrapit.config import load_config
    from wrapit.errors import WrapItError

    try:
        name = load_config(config).drawing
    except WrapItError:
        return None
    return None if (config.parent / name).resolve() == drawing.resolve() else name
