"""A handle for the jig, made with build123d; and the wires in it as a cadquery assembly.

Run it with `python examples/handle.py [folder]`; FreeCAD opens the two STEP files that it writes.
"""

from __future__ import annotations

import sys
from pathlib import Path

from build123d import Align, Box, Cylinder, Pos, export_step, export_stl

from wrapit import build_jigs, cad, decompose, draw_wires, load_config, trace

CONFIGS = Path(__file__).parent.parent / "configs"
LENGTH_MM, WIDTH_MM, BORE_MM, OVERLAP_MM = 30.0, 14.0, 6.0, 2.0


def main(folder: Path) -> None:
    config = load_config(CONFIGS / "butterfly.yaml")
    drawing, _ = trace(CONFIGS / config.drawing, config)
    solution, _ = decompose(drawing, config)
    wires, _ = draw_wires(solution, config)
    jigs, _ = build_jigs(wires, config)
    jig = jigs.jigs[0]

    # The handle reaches a little into the plate's lower edge, and has a bore to hang the jig from a nail.
    body = cad.jig_part(jig)
    plate = body.bounding_box()
    thickness_mm = jig.plan.plate.thickness_mm
    foot = Pos(plate.center().X, plate.min.Y + OVERLAP_MM, 0)
    bar = Box(WIDTH_MM, LENGTH_MM, thickness_mm, align=(Align.CENTER, Align.MAX, Align.MIN))
    bore = Pos(0, WIDTH_MM / 2 - LENGTH_MM, thickness_mm / 2) * Cylinder(BORE_MM / 2, thickness_mm)
    handled = body + foot * (bar - bore)
    handled.label = f"{body.label} with handle"
    print(f"{handled.label}: {len(handled.solids())} solid, {handled.volume - body.volume:.0f} mm³ more")

    piece = cad.assembly(config.name, wires, jigs)
    print(f"{piece.name}: {', '.join(child.name for child in piece.children)}")

    folder.mkdir(parents=True, exist_ok=True)
    export_step(handled, folder / "jig-with-handle.step")
    export_stl(handled, folder / "jig-with-handle.stl")
    piece.export(str(folder / "wires-in-jig.step"))


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else Path("build/handle"))
