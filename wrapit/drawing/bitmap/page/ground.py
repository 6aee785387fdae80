"""The ground that paper lies on: a table, a scanner's lid, a mat, a thumb; and shadows that hide its end.

Paper is what can be reached from its brightest inked part without a step of the level: a soft shadow is
crossed, the paper's edge is not. What then lies outside and reaches the picture's rim is ground.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from wrapit.drawing.bitmap.page.cells import STEP, BoolCells, Cells, depth, rim_of
from wrapit.drawing.bitmap.page.extremes import highest, lowest

# Through how narrow a place does paper not go on, in cells more than half the look past strokes? Where a
# paper's slanted edge meets the side, the ground beside it is as narrow as a stroke: its step is gone.
_LEAK = 1
# What may be paper? This share of the picture at least, with this share of the ink of the region that has
# most; and this bright: the ground of a light drawing surrounds dark fields.
_PAPER = 0.15
_INKED = 0.15
_BRIGHT = 0.7
# How different is ground from the paper beside it? By this ratio at least, a sixth; a level a few cells away
# from the edge on either side is compared.
_OTHER = 1.18
_BESIDE = 6
# How far around the ground is painted over? The paper's edge is blurred and has a rim of shade.
_BLURRED = 3
# How much farther than the look past strokes may ink that touches the ground reach into the paper, if it is
# the ground's own rim and no line that runs into it?
_SHADE = 2


# How long is an edge of light that would be read as a line, in shares of the longer side? On 140 pictures of
# drawings no step is longer than .2 but those of tables and mats. What stays so near to the picture's sides,
# in shares of the shorter one, is what is left of a table. And how dark is a shadow at most? What is darker
# than this share of the paper beside it is ink.
_EDGE = 0.2
_ALONG_SIDE = 0.08
_SHADOW = 0.4


@dataclass(frozen=True, eq=False)
class Ground:
    """Cells that are no paper; how bright they are in shares of the paper; whether lines run into them."""

    where: BoolCells
    level: float
    crossed: bool


def find_ground(cells: Cells) -> Ground | None:
    """The ground around the paper; nothing where the paper fills the picture."""
    from scipy.ndimage import binary_dilation, binary_erosion, label

    if cells.is_even:
        return None
    flat = _steps(cells, 3) < STEP
    if flat.all():
        return None
    narrow = cells.look // 2 + _LEAK
    regions, count = label(binary_erosion(flat, iterations=narrow, border_value=1))
    number = _paper_region(cells, regions, count)
    if number is None:
        return None
    paper = binary_dilation(regions == number, iterations=narrow, mask=flat)
    paper = binary_dilation(paper, iterations=1)
    outside = _at_rim(~paper)
    outside = _other(cells, outside, paper)
    if not outside.any():
        return None
    rest = ~outside
    if rest.mean() < _PAPER or (~cells.ink[rest]).mean() < _BRIGHT:
        return None
    usual = float(np.median(cells.paper[paper]))
    grown = binary_dilation(outside, iterations=_BLURRED)
    rim, crossed = _beside(cells.ink & ~grown, grown, cells.look + _SHADE)
    return Ground(grown | rim, float(np.median(cells.level[outside])) / usual, crossed)


def edge_of_light(cells: Cells) -> BoolCells:
    """The cells of a long step of the paper's level, as a shadow's edge is; none where there is no such."""
    from scipy.ndimage import find_objects, label

    if cells.is_even:
        return np.zeros(cells.paper.shape, dtype=np.bool_)
    steps = _steps(cells, 3) >= STEP
    if not steps.any():
        return steps
    labels, _ = label(steps, np.ones((3, 3)))
    drop, away = _steps(cells, 2 * _BESIDE + 1), depth(steps.shape)
    found = np.zeros_like(steps)
    for number, box in enumerate(find_objects(labels), 1):
        piece = labels[box] == number
        long = max(piece.shape) > _EDGE * max(steps.shape)
        deep = int(away[box][piece].max()) > _ALONG_SIDE * min(steps.shape)
        if long and deep and float(np.median(drop[box][piece])) < -np.log(_SHADOW):
            found[box] |= piece
    return found


def _steps(cells: Cells, reach: int) -> NDArray[np.float32]:
    """By how much the paper's level changes within so many cells, as a logarithm."""
    level = cells.paper.astype(np.uint8)
    high, low = highest(level, reach), lowest(level, reach)
    steps: NDArray[np.float32] = np.log(high, dtype=np.float32) - np.log(low, dtype=np.float32)
    return steps


def _paper_region(cells: Cells, regions: NDArray[np.int32], count: int) -> int | None:
    """The brightest of the large regions that hold much of the ink."""
    sizes = np.bincount(regions.ravel(), minlength=count + 1)
    inked = np.bincount(regions[cells.ink], minlength=count + 1)
    large = [k for k in range(1, count + 1) if sizes[k] >= _PAPER * regions.size]
    if not large:
        return None
    most = max(inked[k] for k in large)
    inked_enough = [k for k in large if inked[k] >= _INKED * most]
    return max(inked_enough, key=lambda k: float(np.median(cells.paper[regions == k])))


def _at_rim(where: BoolCells) -> BoolCells:
    from scipy.ndimage import label

    labels, _ = label(where)
    touching = np.unique(rim_of(labels))
    at_rim: BoolCells = np.isin(labels, touching[touching > 0])
    return at_rim


def _other(cells: Cells, outside: BoolCells, paper: BoolCells) -> BoolCells:
    """Those pieces of the outside that differ from the paper beside them, which a stroke may part from it."""
    from scipy.ndimage import binary_dilation, label

    labels, count = label(outside)
    result = np.zeros_like(outside)
    for number in range(1, count + 1):
        piece = labels == number
        beside = binary_dilation(piece, iterations=_BESIDE) & paper
        near = binary_dilation(beside, iterations=_BESIDE) & piece
        if not beside.any() or not near.any():
            continue
        ratio = float(np.median(cells.paper[beside]) / np.median(cells.level[near]))
        if max(ratio, 1 / ratio) > _OTHER:
            result |= piece
    return result


def _beside(ink: BoolCells, ground: BoolCells, reach: int) -> tuple[BoolCells, bool]:
    """Ink that touches the ground and stays beside it or the picture's side; whether other ink touches it.

    Where the ground tapers to a sliver it is ink to all looks, so the picture's side counts as ground too.
    """
    from scipy.ndimage import distance_transform_edt, label

    labels, count = label(ink, np.ones((3, 3)))
    if not count:
        return np.zeros_like(ink), False
    nearest, farthest = np.full(count + 1, np.inf), np.zeros(count + 1)
    np.minimum.at(nearest, labels.ravel(), distance_transform_edt(~ground).ravel())
    inside = distance_transform_edt(np.pad(~ground, 1))[1:-1, 1:-1]
    np.maximum.at(farthest, labels.ravel(), inside.ravel())
    touching = nearest < 2
    touching[0] = False
    rim: BoolCells = (touching & (farthest <= reach))[labels]
    return rim, bool((touching & (farthest > reach)).any())
