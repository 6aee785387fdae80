"""Refuses pictures that are no line drawings, and says what they are instead."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from wrapit.drawing.bitmap.cleanup import components
from wrapit.drawing.bitmap.ink import Ink, separability
from wrapit.drawing.bitmap.skeleton import Skeleton
from wrapit.drawing.bitmap.strand_graph import StrandGraph
from wrapit.errors import DrawingError

# Limits between line drawings and the rest. On one sample of each kind, good drawings against bad ones:
# separability .84 to .99 against .65 (photo); unevenness of the width .03 to .12 against .53 (hatching), .63
# (photo), .69 (mixed widths), 2.2 (filled); ink share .08 against .93 (inverted), .48 (photo). Varied by 30 %
# each on the pictures and pages of the tests, only two matter: with a larger `_THICK_SHARE` a table around a
# page is no longer left out, with a smaller `_FAT_WIDTH` a drawing in a thinner frame is taken for filled.
# What is a photo or noise? More midtones and less separable than these, with more branches per stroke width
# of skeleton, or more uneven in width.
_MIDTONES = 0.12
_SEPARABLE = 0.88
_BRANCHES = 0.10
_UNEVEN = 0.35
# What is noise in coarse pictures, whose strokes are thinner than this (pixels)? Branches alone tell; and
# very many branches do so before a graph is made of them. These three were not varied.
_COARSE_PX = 2.2
_COARSE_BRANCHES = 0.12
_CROWD = 5000
# What has filled shapes? Ink thicker than this share of the drawing, unless it has many strands, or this
# share of the ink in places this many times as wide as usual. A thick pen may be broader, if it is as broad
# all over: the middle nine tenths of the widths lie within 0.45 of the median, and a part of a pixel, on 44
# icons of lines thicker than 0.12 of themselves (arrows, chevrons, ticks), 0.64 on arrows with filled heads,
# 0.9 and more on filled lenses. Of 25 solid icons so thick ten are read; all but an eye are of lines.
_THICK_SHARE = 0.12
_THICK_PEN = 0.2
_EVEN_PEN = 0.46
_EVEN_PX = 0.6
_PIECES = 40
_FAT_AREA = 0.25
_FAT_WIDTH = 3.0
# What is dots, and what ink all over? In stroke widths, and a share of the picture.
_LONGEST = 3.0
_INK_SHARE = 0.6
# What is text or hatching? More pieces than these, the largest of them less than this share of the whole.
_LOOSE = 15
_MAIN_SHARE = 0.2
# What is ruled paper? As many lines at least that fill this share of each of eight strips across the picture;
# in a strip, lines askew by a degree or two still keep to their rows.
_STRIPS = 8
_RULED_SHARE = 0.6
_RULED_LINES = 5
# Along a skeleton, steps to the side and diagonally mixed, a pixel is this long (not varied).
_PIXEL_LENGTH = 1.1


def refuse_crowd(ink: Ink, skeleton: Skeleton, where: str) -> None:
    """Refuses noise before a graph is made of its hundreds of thousands of branches.

    Raises DrawingError.
    """
    degree = np.bincount(skeleton.pairs.ravel(), minlength=len(skeleton.pixels))
    branches = int((degree >= 3).sum()) / 2
    per_width = branches * skeleton.width_px / len(skeleton.pixels)
    if branches > _CROWD and per_width > _BRANCHES:
        raise _no_line_drawing(ink, where)


def refuse_other_pictures(
    ink: Ink, skeleton: Skeleton, graph: StrandGraph, where: str, *, outlined: bool
) -> None:
    """Raises DrawingError for photos, noise, filled shapes, dots and pages of text.

    `outlined` says that the ink is the outline of what was filled, as `tracing.filled` asks for.
    """
    low, middle, high, ninety = np.percentile(skeleton.distance, [25, 50, 75, 90])
    uneven = (high - low) / middle
    length = _PIXEL_LENGTH * len(skeleton.pixels)
    branches = sum(graph.degree(node) >= 3 for node in graph.nodes) * skeleton.width_px / length
    if (
        midtones(ink) > _MIDTONES
        and separability(ink) < _SEPARABLE
        and (branches > _BRANCHES or uneven > _UNEVEN)
    ):
        raise _no_line_drawing(ink, where)
    if skeleton.width_px < _COARSE_PX and branches > _COARSE_BRANCHES:
        raise _no_line_drawing(ink, where)
    lengths = sorted((graph.length(strand) for strand in graph.strands), reverse=True)
    longest = lengths[0] if lengths else 0.0
    spread = float(np.ptp(skeleton.pixels, axis=0).max()) + skeleton.width_px
    thin, broad = np.percentile(skeleton.distance, [5, 95])
    thickest = _THICK_PEN if broad - thin < _EVEN_PEN * middle + _EVEN_PX else _THICK_SHARE
    if skeleton.width_px > thickest * spread and len(lengths) < _PIECES:
        detail = f"the ink is {skeleton.width_px:.0f} px thick and {spread:.0f} px long"
        raise _filled(where, detail, outlined, ink.shaded)
    if longest < _LONGEST * skeleton.width_px:
        raise DrawingError(
            "the picture holds only dots and short strokes, no lines", where, "connect them with a pen"
        )
    fat = fat_share(ink, skeleton)
    if (ninety > _FAT_WIDTH * middle or fat > _FAT_AREA) and is_ruled(ink.mask):
        raise DrawingError(
            "the paper is ruled or squared, in lines as dark as the drawing",
            where,
            "draw on plain paper, or with a pen much darker than the ruling",
        )
    if ninety > _FAT_WIDTH * middle or fat > _FAT_AREA:
        detail = f"{100 * fat:.0f} % of the ink is much thicker than the lines"
        raise _filled(where, detail, outlined, ink.shaded)
    share = np.count_nonzero(ink.mask) / ink.mask.size
    if share > _INK_SHARE:
        raise DrawingError(
            f"ink covers {100 * share:.0f} % of the picture", where, "draw lines on empty paper"
        )


def refuse_loose_strokes(graph: StrandGraph, where: str) -> None:
    """Raises DrawingError where no piece of the picture is more than a small part of it: text, hatching."""
    pieces = components(graph)
    lengths = [sum(graph.length(strand) for strand in strands) for strands in pieces]
    if len(pieces) > _LOOSE and lengths[0] < _MAIN_SHARE * sum(lengths):
        raise DrawingError(
            f"the picture falls into {len(pieces)} pieces that don't touch (text or hatching?)",
            where,
            "draw one connected figure",
        )


def is_ruled(mask: NDArray[np.bool_]) -> bool:
    """Whether at least five lines run straight across the whole picture, which may lie a little askew."""
    for picture in (mask, mask.T):
        strips = np.array_split(picture[:, ::4], _STRIPS, axis=1)
        # Most drawings have too few in the first strip already.
        if all(_full_rows(strip) >= _RULED_LINES for strip in strips):
            return True
    return False


def _full_rows(strip: NDArray[np.bool_]) -> int:
    """How many runs of rows that are nearly all ink follow on rows that are not."""
    full = strip.mean(axis=1) > _RULED_SHARE
    return int(np.count_nonzero(full[1:] & ~full[:-1]))


def midtones(ink: Ink) -> float:
    """Share of the pixels that are neither ink nor paper, 0…1."""
    contrast = ink.paper - ink.ink
    low, high = int(ink.ink + 0.25 * contrast), int(ink.paper - 0.25 * contrast)
    return float(ink.histogram[low : high + 1].sum() / ink.histogram.sum())


def fat_share(ink: Ink, skeleton: Skeleton) -> float:
    """Share of the ink that lines of the usual width don't account for, 0…1."""
    usual = float(np.median(skeleton.distance))
    if float(skeleton.distance.max()) < (_FAT_WIDTH + 0.5) * usual:
        return 0.0
    thin = skeleton.distance < _FAT_WIDTH * usual
    covered = _PIXEL_LENGTH * float((2 * skeleton.distance[thin] - 1).sum())
    return max(0.0, 1 - covered / np.count_nonzero(ink.mask))


def _no_line_drawing(ink: Ink, where: str) -> DrawingError:
    between = f"({100 * midtones(ink):.0f} % of it is neither ink nor paper)"
    if ink.shaded:
        return DrawingError(
            f"this looks like a photo or noise, or like a drawing under a shadow or on a table {between}",
            where,
            "photograph the drawing in even light, or with a scanner app, and crop it to the paper",
        )
    return DrawingError(
        f"this looks like a photo or noise, not like a line drawing {between}",
        where,
        "trace its lines by hand on white paper first",
    )


def _filled(where: str, detail: str, outlined: bool, shaded: bool) -> DrawingError:
    if outlined:
        problem = f"even the outlines of the filled shapes are no lines ({detail})"
        return DrawingError(problem, where, "draw their outlines by hand, larger and with a thin pen")
    if shaded:
        return DrawingError(
            f"the drawing has filled shapes, or lies under a shadow or on a table ({detail})",
            where,
            "draw outlines only; photograph them in even light, or with a scanner app, and crop to the paper",
        )
    return DrawingError(
        f"the drawing has filled shapes ({detail})",
        where,
        "draw their outlines only, or set tracing.filled to outline",
    )
