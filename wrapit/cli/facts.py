"""`schema`, `materials` and `doctor`: what the program knows and what it finds on this machine."""

from __future__ import annotations

import json
from typing import Annotated

import typer

from wrapit.cli.app import app


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


@app.command()
def doctor(as_json: Annotated[bool, typer.Option("--json", help="Print one JSON document.")] = False) -> None:
    """Say what wrapit finds on this machine, and how to get what is missing; exit code 1 if it can't work."""
    from wrapit.cli.health import as_document, as_lines, examined, works

    found = list(examined())
    if as_json:
        print(json.dumps(as_document(found)))
    else:
        for line in as_lines(found):
            print(line)
    raise typer.Exit(0 if works(found) else 1)
