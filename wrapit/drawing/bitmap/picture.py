"""A bitmap ready for tracing: its ink and skeleton at a scale where strokes are a dozen pixels wide."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from wrapit.config import TracingConfig
from wrapit.drawing.bitmap.hard_edges.pixels import block_side, is_hard, softened, stair_px
from wrapit.drawing.bitmap.hard_edges.slits import without_slits
from wrapit.drawing.bitmap.image import GreyImage, count_levels, load_grey
from wrapit.drawing.bitmap.ink import Ink, darker_ink, find_ink
from wrapit.drawing.bitmap.page.stage import Page, drawing_alone, is_bright_page
from wrapit.drawing.bitmap.refusals import is_ruled, refuse_crowd
from wrapit.drawing.bitmap.skeleton import Skeleton, thin_within
from wrapit.drawing.changes import Change, Notice
from wrapit.drawing.spots import Spot, spots_of_ink
from wrapit.errors import DrawingError
from wrapit.geometry import FloatArray

# At what scale are strokes traced? The recipe was measured at widths of 10 to 11 px. Thinner strokes than 4.5
# are enlarged (one of 2 px reads as 1.5 wide), thicker ones than 28 reduced: they take time and tell no more.
_THIN_PX = 4.5
_GOOD_PX = 10.0
_THICK_PX = 28.0
# How high are the stairs of grey edges, in pixels of the file? Half as high as those of hard ones; they only
# show in strokes so thin that they are enlarged. 26 drawings 100 px wide turn 1.02 times as much as at 660 px
# in the median, 3.4 times if these stairs are followed; with 0.35 and 0.65 as much as with this.
_GREY_STAIR = 0.5
# How large may a picture become by that? 60 million pixels take a byte each as grey and as many as ink.
_MOST_PIXELS = 60_000_000
# How broad is the line along the edge of a filled shape, where outlines are asked for?
_OUTLINE_PX = 8.0


@dataclass(frozen=True, eq=False)
class Picture:
    """Ink and skeleton in working pixels; `factor` source pixels make one of them.

    What was left out around the drawing is told in source pixels.
    """

    ink: Ink
    skeleton: Skeleton
    factor: float
    light_on_dark: bool = False
    changes: tuple[Change, ...] = ()
    notices: tuple[Notice, ...] = ()

    @property
    def uneven_px(self) -> float:
        """How high the stairs along the edges are, in working pixels; 0 where grey hides them."""
        return self.ink.stair_px or (_GREY_STAIR / self.factor if self.factor < 1 else 0.0)

    def source(self, points: FloatArray) -> FloatArray:
        """Places (..., 2) in pixels of the file, where the centre of the first pixel is (0, 0)."""
        return points * self.factor + (self.factor - 1) / 2

    @property
    def dots(self) -> list[Spot]:
        """Round dots of ink, in working pixels."""
        return spots_of_ink(self.skeleton.pixels, self.skeleton.pairs, self.skeleton.distance)

    def spots_in_source(self, spots: Sequence[Spot]) -> list[Spot]:
        """Spots in pixels of the file."""
        places = [self.source(np.array(spot.at_px)).tolist() for spot in spots]
        return [Spot((x, y), s.diameter_px * self.factor) for s, (x, y) in zip(spots, places, strict=True)]


def read_picture(path: Path, tracing: TracingConfig, *, alone: bool = True) -> Picture:
    """The picture in a bitmap file; with `alone` without what surrounds the drawing.

    Raises DrawingError where it can't be read, has no ink, is noise, or shows lines that run into a table
    or a dark edge.
    """
    page, light_on_dark = _page(path, tracing, alone)
    return _told(_picture(page.grey, path, tracing), page, light_on_dark)


def read_on_ruled_paper(path: Path, tracing: TracingConfig, *, alone: bool = True) -> Picture | None:
    """The picture without the paler lines that rule the paper, or nothing where there are no such.

    Raises DrawingError as `read_picture`.
    """
    page, light_on_dark = _page(path, tracing, alone)
    found = find_ink(page.grey, str(path))
    darker = darker_ink(found) if is_ruled(found.mask) else None
    return None if darker is None else _told(_picture(darker, path, tracing), page, light_on_dark)


def _page(path: Path, tracing: TracingConfig, alone: bool) -> tuple[Page, bool]:
    grey, light_on_dark = load_grey(path, tracing.pixel_limit)
    if not alone:
        return Page(grey, (), ()), light_on_dark
    if light_on_dark and is_bright_page(255 - grey):
        grey, light_on_dark = 255 - grey, False
    return drawing_alone(grey, str(path)), light_on_dark


def _told(picture: Picture, page: Page, light_on_dark: bool) -> Picture:
    return replace(picture, light_on_dark=light_on_dark, changes=page.changes, notices=page.notices)


def _picture(grey: GreyImage, path: Path, tracing: TracingConfig) -> Picture:
    found, factor, stair = find_ink(grey, str(path)), 1.0, 0.0
    if is_hard(found):
        side, stair = block_side(found.mask), 1.0
        if side > 1:
            grey, factor = _reduced(grey, side), float(side)
            found = find_ink(grey, str(path))
        else:
            stair = stair_px(found.mask)
    times = _reduction(found)
    if times > 1:
        grey = _reduced(softened(found, stair).grey if stair else found.grey, times)
        factor, stair = factor * times, stair / times
        found = replace(find_ink(grey, str(path)), shaded=found.shaded)
    if tracing.filled == "refuse" and (whole := without_slits(found)) is not found:
        found, grey = whole, whole.grey
    if stair and times == 1:
        found = softened(found, stair)
    ink = _inked(found, tracing)
    skeleton = _skeleton(ink, path)
    if skeleton.width_px < _THIN_PX:
        times = int(np.ceil(_GOOD_PX / max(skeleton.width_px, 1.0)))
        times = min(times, int(np.sqrt(_MOST_PIXELS / grey.size)))
        if times > 1:
            found, factor, stair = find_ink(_enlarged(grey, times), str(path)), factor / times, stair * times
            ink = _inked(softened(found) if stair else found, tracing)
            skeleton = _skeleton(ink, path)
    return Picture(replace(ink, stair_px=stair), skeleton, factor)


def _skeleton(ink: Ink, path: Path) -> Skeleton:
    if not ink.mask.any():
        raise DrawingError("the picture holds no lines", str(path), "draw at least one line")
    skeleton = thin_within(ink.mask)
    refuse_crowd(ink, skeleton, str(path))
    return skeleton


def _reduction(ink: Ink) -> int:
    """How many pixels may become one: thick strokes carry no more detail than thin ones."""
    mask = ink.mask
    steps = np.count_nonzero(mask[1:] != mask[:-1]) + np.count_nonzero(mask[:, 1:] != mask[:, :-1])
    width_px = 2 * np.count_nonzero(mask) / max(steps * np.pi / 4, 1.0)
    times = int(width_px / (_THICK_PX / 2))
    return times if width_px >= _THICK_PX and min(mask.shape) >= 64 * times else 1


def _reduced(grey: GreyImage, times: int) -> GreyImage:
    height, width = (side // times for side in grey.shape)
    blocks = grey[: height * times, : width * times].reshape(height, times, width, times)
    return (blocks.mean(axis=(1, 3), dtype=np.float32) + 0.5).astype(np.uint8)


def _enlarged(grey: GreyImage, times: int) -> GreyImage:
    from PIL import Image

    height, width = grey.shape
    return np.asarray(Image.fromarray(grey).resize((width * times, height * times), Image.Resampling.BICUBIC))


def _inked(ink: Ink, tracing: TracingConfig) -> Ink:
    """The ink itself, or on request the outline of what it fills, as a line of its own."""
    if tracing.filled == "refuse":
        return ink
    from scipy.ndimage import distance_transform_edt, gaussian_filter

    soft = gaussian_filter(ink.mask.astype(np.float32), 1.0) > 0.5
    apart = np.where(soft, distance_transform_edt(soft) - 0.5, distance_transform_edt(~soft) - 0.5)
    level = np.clip(apart - _OUTLINE_PX / 2 + 0.5, 0, 1)
    grey = (255 * level + 0.5).astype(np.uint8)
    return Ink(grey < 128, grey, 255.0, 0.0, ink.shaded, count_levels(grey))
