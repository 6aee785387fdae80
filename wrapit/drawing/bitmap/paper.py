"""A photo of paper that lies on a darker table: the table is made paper."""

from __future__ import annotations

import numpy as np

from wrapit.drawing.bitmap.image import GreyImage, count_levels

# Shares of the picture's rim, of its size, of the picture, and of the paper.
_DARK_RIM = 0.05
_BROADER = 0.015
_PAPER = 0.2
_BRIGHT = 0.7
# Of the picture's contrast.
_EDGE = 0.5
_COARSE = 4


def without_table(grey: GreyImage) -> GreyImage | None:
    """The picture with broad dark ground at its rim made paper; nothing where the rim is paper.

    Light drawings on dark ground are left alone: most of what their ground surrounds is dark too.
    """
    from scipy.ndimage import binary_dilation, binary_erosion, label

    shares = np.cumsum(count_levels(grey)) / grey.size
    low, high = (int(np.searchsorted(shares, share)) for share in (0.02, 0.98))
    half = (low + high) / 2
    rim = np.concatenate([grey[0], grey[-1], grey[:, 0], grey[:, -1]])
    if (rim < half).mean() < _DARK_RIM:
        return None
    coarse = grey[::_COARSE, ::_COARSE]
    dark = coarse < half
    reach = max(3, int(_BROADER * max(dark.shape)))
    labels, _ = label(binary_erosion(dark, iterations=reach, border_value=1))
    touching = np.unique(np.concatenate([labels[0], labels[-1], labels[:, 0], labels[:, -1]]))
    core = np.isin(labels, touching[touching > 0])
    # A little more than what was eroded: the paper's edge is blurred.
    table = binary_dilation(core, iterations=reach + 3)
    paper = ~table
    if not core.any() or paper.mean() < _PAPER or (~dark[paper]).mean() < _BRIGHT:
        return None
    level = float(np.median(coarse[paper & ~dark]))
    before = binary_dilation(core, iterations=reach - 2) & ~core
    beside = binary_dilation(table, iterations=3) & paper
    # A shadow darkens the paper gradually, a table ends at an edge.
    if not beside.any() or np.median(coarse[beside]) - np.median(coarse[before]) < _EDGE * (high - low):
        return None
    height, width = grey.shape
    full = table.repeat(_COARSE, axis=0).repeat(_COARSE, axis=1)[:height, :width]
    return np.where(full, np.uint8(level), grey)
