"""Makes the README's pictures from the configs: wires, jig from above, jig at an angle.

Run it with `python examples/pictures.py [folder] [names…]`.
"""

from __future__ import annotations

import sys
from pathlib import Path

from wrapit.config import load_config
from wrapit.decomposition.stage import decompose
from wrapit.drawing.stage import trace
from wrapit.exports.preview_png import write_preview
from wrapit.exports.view_png import write_view
from wrapit.jig.kinds import JIGS
from wrapit.wires.stage import draw_wires

CONFIGS = Path(__file__).parent.parent / "configs"
PICTURES = Path(__file__).parent / "pictures"


def take(name: str, folder: Path) -> None:
    """Three pictures of one piece."""
    config = load_config(CONFIGS / f"{name}.yaml")
    drawing, _ = trace(CONFIGS / config.drawing, config.tracing, config.size)
    solution, _ = decompose(drawing, config.decomposition)
    wires, _ = draw_wires(solution, config)
    write_preview(folder / f"{name}-wires.png", wires)
    made = JIGS["printed"].make(wires, config)
    for view in made.views:
        if view.plate is not None:
            which = view.stem.removeprefix("preview")
            write_preview(folder / f"{name}-jig{which}.png", view.wires, view.walls, view.plate)
            write_view(folder / f"{name}-view{which}.png", view)


if __name__ == "__main__":
    target = Path(sys.argv[1]) if len(sys.argv) > 1 else PICTURES
    target.mkdir(parents=True, exist_ok=True)
    for piece in sys.argv[2:] or ["butterfly"]:
        take(piece, target)
        print(f"{piece}: pictures in {target}")
