"""Makes the README's pictures from the configs: each piece's drawing, wires and jig side by side.

Run it with `make pictures`, or `python examples/pictures.py [folder] [names…]`. The first of all, the
butterfly, also has each of them alone.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

from PIL import Image, ImageOps

from wrapit.config import Config, load_config
from wrapit.decomposition.stage import decompose
from wrapit.exports.preview_png import write_preview
from wrapit.exports.view_png import write_view
from wrapit.jig.kinds import JIGS
from wrapit.pipeline.trying.tried import read
from wrapit.wires.beside.side_by_side import room_of
from wrapit.wires.stage import draw_wires

CONFIGS = Path(__file__).parent.parent / "configs"
PICTURES = Path(__file__).parent / "pictures"
# Of one picture of a row: three of them fill the README's width on a wide screen.
TILE_PX = 300
PAPER = (250, 249, 246)


def take(config: Config, name: str, folder: Path) -> tuple[Path, Path, Path]:
    """Pictures of a piece's wires, and of its (first) jig from above and at an angle."""
    drawing, _ = read(config, CONFIGS / config.drawing)
    solution, _ = decompose(drawing, config.decomposition, room_of(config))
    wires, _ = draw_wires(solution, config)
    paths = folder / f"{name}-wires.png", folder / f"{name}-jig.png", folder / f"{name}-view.png"
    write_preview(paths[0], wires)
    first = next(view for view in JIGS["printed"].make(wires, config).views if view.plate is not None)
    write_preview(paths[1], first.wires, first.walls, first.plate)
    write_view(paths[2], first)
    return paths


def row(pictures: list[Path]) -> Image.Image:
    """Pictures side by side, each in a square of its own."""
    whole = Image.new("RGB", (TILE_PX * len(pictures), TILE_PX), PAPER)
    for index, path in enumerate(pictures):
        with Image.open(path) as picture:
            tile = ImageOps.pad(picture.convert("RGB"), (TILE_PX, TILE_PX), Image.Resampling.LANCZOS, PAPER)
        whole.paste(tile, (index * TILE_PX, 0))
    return whole


def ink_of(config: Config) -> Path:
    """The drawing as ink on paper, also where the config takes the SVG."""
    return (CONFIGS / config.drawing).with_suffix(".png")


if __name__ == "__main__":
    target = Path(sys.argv[1]) if len(sys.argv) > 1 else PICTURES
    target.mkdir(parents=True, exist_ok=True)
    for piece in sys.argv[2:] or sorted(path.stem for path in CONFIGS.glob("*.yaml")):
        settings = load_config(CONFIGS / f"{piece}.yaml")
        with tempfile.TemporaryDirectory() as elsewhere:
            taken = take(settings, piece, target if piece == "butterfly" else Path(elsewhere))
            picture = row([ink_of(settings), taken[0], taken[2]]).quantize(128)
        picture.save(target / f"{piece}.png", optimize=True)
        print(target / f"{piece}.png")
