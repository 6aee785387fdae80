"""The story of the paper's Figure 2: what each term of the energy does to the wires of the butterfly.

Run it with `python examples/figure2.py [folder]`.
"""

from __future__ import annotations

import math
import sys
import tempfile
from pathlib import Path

from PIL import Image, ImageDraw, ImageFont

from wrapit.config import Config, load_config
from wrapit.config.decomposition import WeightsConfig
from wrapit.decomposition.model import Energy
from wrapit.decomposition.stage import decompose
from wrapit.drawing.model import Drawing
from wrapit.drawing.stage import trace
from wrapit.exports.preview_png import write_preview
from wrapit.wires.stage import draw_wires

CONFIGS = Path(__file__).parent.parent / "configs"
PICTURES = Path(__file__).parent / "pictures"
STORY = (
    ("fewest wires", WeightsConfig(smoothness=0, robustness=0)),
    ("fewest, smoothest", WeightsConfig(robustness=0)),
    ("fewest, smoothest, strongest", WeightsConfig()),
)
WIDTH_PX, CAPTION_PX, TITLE_PX, TEXT_PX = 560, 84, 24, 19
PAPER, INK = (250, 249, 246), (40, 40, 40)


def panel(title: str, weights: WeightsConfig, drawing: Drawing, config: Config, folder: Path) -> Image.Image:
    """The wires that these weights lead to, and below them what they are like."""
    wishes = config.decomposition.model_copy(update={"weights": weights})
    solution, _ = decompose(drawing, wishes)
    wires, _ = draw_wires(solution, config)
    preview = folder / "preview.png"
    write_preview(preview, wires)
    with Image.open(preview) as picture:
        height_px = round(picture.height * WIDTH_PX / picture.width)
        small = picture.convert("RGB").resize((WIDTH_PX, height_px), Image.Resampling.LANCZOS)
    page = Image.new("RGB", (WIDTH_PX, height_px + CAPTION_PX), PAPER)
    page.paste(small, (0, 0))
    pen = ImageDraw.Draw(page)
    for text, size_px, y_px in ((title, TITLE_PX, 8), (described(solution.energy), TEXT_PX, 44)):
        font = ImageFont.load_default(size_px)
        pen.text(((WIDTH_PX - pen.textlength(text, font)) / 2, height_px + y_px), text, INK, font)
    return page


def described(energy: Energy) -> str:
    """Number of wires, their bends at junctions, and how many can swing."""
    bends_deg = math.degrees(energy.smoothness_rad)
    loose = f"{energy.robustness} hangs loose" if energy.robustness else "none hangs loose"
    return f"{energy.complexity} wires, {bends_deg:.0f}° of bends, {loose}"


def main(folder: Path) -> Path:
    """Writes `figure2.png`: the three side by side."""
    config = load_config(CONFIGS / "butterfly.yaml")
    drawing, _ = trace(CONFIGS / config.drawing, config.tracing, config.size)
    with tempfile.TemporaryDirectory() as scratch:
        panels = [panel(title, weights, drawing, config, Path(scratch)) for title, weights in STORY]
    sheet = Image.new("RGB", (len(panels) * WIDTH_PX, max(each.height for each in panels)), PAPER)
    for index, each in enumerate(panels):
        sheet.paste(each, (index * WIDTH_PX, 0))
    folder.mkdir(parents=True, exist_ok=True)
    target = folder / "figure2.png"
    sheet.quantize(128, dither=Image.Dither.NONE).save(target, optimize=True)
    return target


if __name__ == "__main__":
    print(main(Path(sys.argv[1]) if len(sys.argv) > 1 else PICTURES))
