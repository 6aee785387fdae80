"""What a picture shows around the drawing: a darker table under the paper, a frame drawn on it."""

from __future__ import annotations

import numpy as np

from wrapit.drawing.bitmap.cleanup import components
from wrapit.drawing.bitmap.image import GreyImage, count_levels
from wrapit.drawing.bitmap.strand_graph import StrandGraph
from wrapit.geometry import FloatArray

# What is a table under the paper? Dark ground that takes this share of the picture's rim and stays when as
# much of the picture's size as `_BROADER` is taken off all around, which no stroke does.
_DARK_RIM = 0.05
_BROADER = 0.015
# What is the paper on it? At least this share of the picture, and bright to this share: the ground of a light
# drawing surrounds dark fields.
_PAPER = 0.2
_BRIGHT = 0.7
# What is the paper's edge, not a shadow's? A step by this share of the picture's contrast.
_EDGE = 0.5
# Every how many pixels is looked? A table is hundreds of pixels broad.
_COARSE = 4
# What is a frame? A rectangle that may be askew as a photo is (1 degree is 0.017 of its side), with this
# share of its points on the sides of its box, around at least this share of its own length.
_ASKEW = 0.02
_ON_SIDES = 0.98
_LEAST_INSIDE = 0.05


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


def drop_frames(graph: StrandGraph, width_px: float) -> None:
    """Drops rectangles that surround all other pieces without touching them, and says so."""
    while _drop_frame(graph, width_px):
        pass


def _drop_frame(graph: StrandGraph, width_px: float) -> bool:
    pieces = components(graph)
    if len(pieces) < 2:
        return False
    chains = [np.concatenate([graph.path(strand) for strand in strands]) for strands in pieces]
    boxes = [(chain.min(axis=0), chain.max(axis=0)) for chain in chains]
    lengths = [sum(graph.length(strand) for strand in strands) for strands in pieces]
    for k, (low, high) in enumerate(boxes):
        others = [box for index, box in enumerate(boxes) if index != k]
        around = all((inner > low).all() and (outer < high).all() for inner, outer in others)
        enough = sum(lengths) - lengths[k] > _LEAST_INSIDE * lengths[k]
        if around and enough and _is_rectangle(chains[k], low, high, width_px):
            graph.note("frame", (low + high) / 2, lengths[k], "a rectangle around the drawing")
            graph.tell(
                "warning",
                "frame",
                low,
                "the rectangle around the drawing is taken for its frame and left out",
                "connect the drawing to it if it belongs to the piece",
            )
            for strand in pieces[k]:
                graph.drop_strand(strand)
            graph.drop_lonely()
            return True
    return False


def _is_rectangle(points: FloatArray, low: FloatArray, high: FloatArray, width_px: float) -> bool:
    """Whether nearly all points lie on the sides of their box, and all four sides are there."""
    slack = np.maximum(_ASKEW * (high - low)[::-1], width_px)
    near = np.column_stack([points - low < slack, high - points < slack])
    covered = [np.ptp(points[near[:, side], 1 - side % 2]) for side in range(4) if near[:, side].any()]
    whole = (high - low)[[1, 0, 1, 0]]
    return bool(
        near.any(axis=1).mean() > _ON_SIDES
        and len(covered) == 4
        and (np.array(covered) > 0.9 * whole).all()
        and min(high - low) > 6 * width_px
    )
