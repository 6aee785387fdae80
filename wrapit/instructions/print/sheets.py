"""Drawings at true size: the piece, parted over pages where it is larger, and a ruler strip for each wire."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Final

from wrapit.config import LengthUnit
from wrapit.instructions.model import Strip, StripMark
from wrapit.instructions.print.painting import INK, LOOKS, MM, Brush
from wrapit.instructions.words.quantities import INCH_MM
from wrapit.instructions.words.speaking import Speaker
from wrapit.pages.model import Length, Picture, text

# Neighbouring parts show this much of one another, to be laid together.
OVERLAP_MM: Final = 10.0
# The lines to measure a print with, in mm and in inches; crosses and caption in mm.
CHECK_MM, CHECK_IN = 50, 2
CROSS_MM, CAPTION_MM = 4.0, 16.0
# A strip: its height with what stands above and below, of its body, and of its short and long ticks.
STRIP_MM, BODY_MM, TICK_MM, LONG_TICK_MM = 24.0, 7.0, 1.5, 3.0
# Sizes of letters in points: of captions, of marks on strips.
CAPTION_PT, MARK_PT = 9.0, 8.0
# What stands where a shape starts and ends, in any language.
ENDS: Final = {"start": "S", "end": "E"}


@dataclass(frozen=True)
class Slice:
    """A part of something long, in mm; `first` and `last` say that nothing comes before or after."""

    low: float
    high: float
    first: bool
    last: bool


def parts_of(length_mm: float, room_mm: float) -> tuple[Slice, ...]:
    """A length parted so that each part has room, with OVERLAP_MM in common with the next.

    >>> [(part.low, part.high) for part in parts_of(250.0, 100.0)]
    [(0.0, 100.0), (90.0, 190.0), (180.0, 250.0)]
    """
    if length_mm <= room_mm:
        return (Slice(0.0, length_mm, True, True),)
    step = room_mm - OVERLAP_MM
    count = math.ceil((length_mm - OVERLAP_MM) / step)
    return tuple(
        Slice(index * step, min(index * step + room_mm, length_mm), index == 0, index == count - 1)
        for index in range(count)
    )


def check_lines(canvas: Any, speaker: Speaker, font: str, left_pt: float, bottom_pt: float) -> None:
    """A line of 50 mm and one of 2 in, with the sentence that says so."""
    canvas.setStrokeColor(INK)
    canvas.setFillColor(INK)
    canvas.setFont(font, CAPTION_PT)
    canvas.drawString(left_pt, bottom_pt + 8 * MM, speaker.of("print-scale", mm=CHECK_MM, inches=CHECK_IN))
    canvas.setLineWidth(0.5)
    for row, (length_mm, name) in enumerate(
        ((CHECK_MM, f"{CHECK_MM} mm"), (CHECK_IN * INCH_MM, f"{CHECK_IN} in"))
    ):
        x, y = left_pt + row * 75 * MM, bottom_pt + 3 * MM
        canvas.line(x, y, x + length_mm * MM, y)
        for end in (x, x + length_mm * MM):
            canvas.line(end, y - 1.5 * MM, end, y + 1.5 * MM)
        canvas.drawString(x + length_mm * MM + 2 * MM, y - 3, name)


@dataclass(frozen=True)
class TrueSize:
    """The piece at true size, part after part, from the upper left."""

    picture: Picture
    room_mm: tuple[float, float]

    @property
    def parts(self) -> tuple[tuple[Slice, Slice], ...]:
        """(across, up) of each part; the picture's lower left corner is 0, 0."""
        width = self.picture.high[0] - self.picture.low[0]
        height = self.picture.high[1] - self.picture.low[1]
        rows = parts_of(height, self.room_mm[1])
        return tuple((across, up) for up in reversed(rows) for across in parts_of(width, self.room_mm[0]))

    def paint(self, brush: Brush, part: tuple[Slice, Slice], left_pt: float, bottom_pt: float) -> None:
        """One part with its lower left corner there, and crosses where neighbours are laid on."""
        across, up = part
        canvas = brush.canvas
        canvas.saveState()
        if len(self.parts) > 1:
            window = canvas.beginPath()
            window.rect(left_pt, bottom_pt, (across.high - across.low) * MM, (up.high - up.low) * MM)
            canvas.clipPath(window, stroke=0, fill=0)
        brush.paint(self.picture, left_pt - across.low * MM, bottom_pt - up.low * MM, 1.0)
        canvas.restoreState()
        for x, y in _crosses(across, up):
            at_x, at_y, arm = (
                left_pt + (x - across.low) * MM,
                bottom_pt + (y - up.low) * MM,
                CROSS_MM / 2 * MM,
            )
            canvas.setStrokeColor(INK)
            canvas.setLineWidth(0.3)
            canvas.line(at_x - arm, at_y, at_x + arm, at_y)
            canvas.line(at_x, at_y - arm, at_x, at_y + arm)


def _crosses(across: Slice, up: Slice) -> Iterator[tuple[float, float]]:
    """Two crosses in the middle of each overlap, a quarter from its ends."""
    half = OVERLAP_MM / 2
    columns = [
        x
        for x, there in ((across.low + half, not across.first), (across.high - half, not across.last))
        if there
    ]
    rows = [y for y, there in ((up.low + half, not up.first), (up.high - half, not up.last)) if there]
    for x in columns:
        for share in (0.25, 0.75):
            yield x, up.low + share * (up.high - up.low)
    for y in rows:
        for share in (0.25, 0.75):
            yield across.low + share * (across.high - across.low), y


@dataclass(frozen=True)
class StripPart:
    """One row of a wire's ruler strip: `part` of `count`."""

    strip: Strip
    span: Slice
    part: int
    count: int

    def paint(
        self, canvas: Any, speaker: Speaker, fonts: tuple[str, str], left_pt: float, bottom_pt: float
    ) -> None:
        """The row with its lower left corner there."""
        plain, bold = fonts
        strip, span = self.strip, self.span

        def x(at_mm: float) -> float:
            return left_pt + (at_mm - span.low) * MM

        foot, top = bottom_pt + 6 * MM, bottom_pt + (6 + BODY_MM) * MM
        canvas.setStrokeColor(INK)
        canvas.setFillColor(INK)
        canvas.setFont(bold, CAPTION_PT)
        canvas.drawString(left_pt, top + 5.5 * MM, speaker.say(self._title()))
        canvas.setLineWidth(0.3)
        canvas.line(x(span.low), foot, x(span.high), foot)
        canvas.line(x(span.low), top, x(span.high), top)
        for at_mm, there in ((span.low, span.first), (span.high, span.last)):
            if there:
                canvas.setLineWidth(1.0)
                canvas.line(x(at_mm), foot - 2 * MM, x(at_mm), top + 2 * MM)
        self._ruler(canvas, plain, x, foot, speaker.unit)
        for mark in strip.marks:
            self._mark(canvas, bold, x, foot, top, mark)
        self._triangles(canvas, x, top)

    def _title(self) -> Any:
        wire, length = text("wire-capital", wire=self.strip.wire), Length(self.strip.cut_mm)
        if self.count == 1:
            return text("strip-title", wire=wire, length=length)
        return text("strip-part", wire=wire, length=length, part=self.part, parts=self.count)

    def _ruler(self, canvas: Any, font: str, x: Any, foot: float, unit: LengthUnit) -> None:
        """Ticks every centimetre with numbers every fifth, or every quarter of an inch with whole inches."""
        canvas.setLineWidth(0.3)
        canvas.setFont(font, MARK_PT - 2)
        step_mm, numbered, named = (INCH_MM / 4, 4, 1 / INCH_MM) if unit == "in" else (10.0, 5, 1.0)
        first, last = math.ceil(self.span.low / step_mm), math.floor(self.span.high / step_mm)
        for tick in range(first, last + 1):
            at_mm, long = tick * step_mm, tick % numbered == 0
            canvas.line(x(at_mm), foot, x(at_mm), foot + (LONG_TICK_MM if long else TICK_MM) * MM)
            if long and tick:
                canvas.drawString(x(at_mm) + 1.5, foot + 1.2 * MM, f"{at_mm * named:.0f}")

    def _mark(self, canvas: Any, font: str, x: Any, foot: float, top: float, mark: StripMark) -> None:
        low, high = max(mark.start_mm, self.span.low), min(mark.end_mm, self.span.high)
        if low > high:
            return
        canvas.setFont(font, MARK_PT)
        if mark.kind == "wrap":
            canvas.setFillColor(LOOKS["wall"][0])
            canvas.setLineWidth(0.4)
            canvas.rect(x(low), top - 2.4 * MM, max(x(high) - x(low), 0.5), 2.4 * MM, stroke=1, fill=1)
            canvas.setFillColor(INK)
            if high - low >= 3:
                canvas.drawCentredString((x(low) + x(high)) / 2, top - 2.1 * MM, mark.label)
            return
        canvas.setFillColor(INK)
        canvas.setLineWidth(0.6)
        if mark.kind == "tie":
            canvas.line(x(low), foot - 1.5 * MM, x(low), foot + 1.5 * MM)
            canvas.drawCentredString(x(low), foot - 4.5 * MM, mark.label)
        else:
            canvas.line(x(low), foot - 1 * MM, x(low), top + 2 * MM)
            canvas.drawCentredString(x(low), top + 2.5 * MM, ENDS[mark.kind])

    def _triangles(self, canvas: Any, x: Any, top: float) -> None:
        """A triangle in the middle of each overlap, at the same place of the wire on both rows."""
        half = OVERLAP_MM / 2
        for at_mm, there in (
            (self.span.low + half, not self.span.first),
            (self.span.high - half, not self.span.last),
        ):
            if there:
                path = canvas.beginPath()
                path.moveTo(x(at_mm), top)
                path.lineTo(x(at_mm) - 1.2 * MM, top + 2.2 * MM)
                path.lineTo(x(at_mm) + 1.2 * MM, top + 2.2 * MM)
                path.close()
                canvas.drawPath(path, stroke=0, fill=1)


def strip_parts(strip: Strip, room_mm: float) -> tuple[StripPart, ...]:
    """All rows of one strip."""
    spans = parts_of(strip.cut_mm, room_mm)
    return tuple(StripPart(strip, span, index, len(spans)) for index, span in enumerate(spans, start=1))
