"""guide.pdf: the guide on paper, with the piece and a ruler strip of each wire at true size."""

from __future__ import annotations

import io
from collections.abc import Iterator, Sequence
from typing import Any, Final
from xml.sax.saxutils import escape

from wrapit.config import Paper
from wrapit.instructions.model import Guide, Step
from wrapit.instructions.print.flowing import drawn, numbered_canvas
from wrapit.instructions.print.fonts import letters_for
from wrapit.instructions.print.painting import MM, Brush
from wrapit.instructions.print.sheets import (
    CAPTION_MM,
    STRIP_MM,
    StripPart,
    TrueSize,
    check_lines,
    strip_parts,
)
from wrapit.instructions.words.speaking import Speaker
from wrapit.pages.model import (
    Block,
    Caution,
    Facts,
    Figure,
    Heading,
    Length,
    Paragraph,
    Points,
    Table,
    Text,
    text,
)

# Paper in mm; margins that printers leave; between columns of steps.
PAPERS: Final[dict[Paper, tuple[float, float]]] = {"A4": (210.0, 297.0), "letter": (215.9, 279.4)}
MARGIN_MM, GUTTER_MM = 12.0, 5.0
# Steps stand in so many columns: as wide as a sentence of theirs in two or three lines.
COLUMNS: Final = 3
# The most that pictures take of a page: the cover's and a jig's, and a step's in its column.
LARGE_MM, STEP_MM = (120.0, 110.0), (57.0, 50.0)


def guide_pdf(guide: Guide, speaker: Speaker, paper: Paper) -> tuple[bytes, frozenset[str]]:
    """The print, the same bytes for the same guide, and the letters of its name that no font has."""
    from reportlab.platypus import SimpleDocTemplate

    plain, bold, missing = letters_for([guide.name, speaker.letters])
    width, height = PAPERS[paper]
    made = io.BytesIO()
    document = SimpleDocTemplate(
        made,
        pagesize=(width * MM, height * MM),
        leftMargin=MARGIN_MM * MM,
        rightMargin=MARGIN_MM * MM,
        topMargin=MARGIN_MM * MM,
        bottomMargin=(MARGIN_MM + 4) * MM,
        title=speaker.of("page-title", name=guide.name),
        author="wrapit",
        lang=speaker.language,
        invariant=1,
        pageCompression=1,
    )
    writer = _Writer(guide, speaker, (plain, bold), (document.width, document.height))
    document.build(list(writer.story()), canvasmaker=numbered_canvas(speaker, plain))
    return made.getvalue(), missing


class _Writer:
    """Turns the guide into what reportlab sets on pages."""

    def __init__(
        self, guide: Guide, speaker: Speaker, fonts: tuple[str, str], room_pt: tuple[float, float]
    ) -> None:
        from reportlab.lib.styles import ParagraphStyle

        self.guide, self.speaker, self.fonts, self.room_pt = guide, speaker, fonts, room_pt
        plain, bold = fonts
        body = ParagraphStyle("body", fontName=plain, fontSize=9.5, leading=13, spaceAfter=4)
        self.styles = {
            "body": body,
            "step": ParagraphStyle("step", body, fontSize=9, leading=12, spaceAfter=3),
            "small": ParagraphStyle("small", body, fontSize=8.5, leading=11.5, textColor="#404040"),
            "title": ParagraphStyle(
                "title", body, fontName=bold, fontSize=22, leading=27, spaceAfter=6, keepWithNext=1
            ),
            "h2": ParagraphStyle(
                "h2",
                body,
                fontName=bold,
                fontSize=15,
                leading=19,
                spaceBefore=12,
                spaceAfter=6,
                keepWithNext=1,
            ),
            "h3": ParagraphStyle(
                "h3", body, fontName=bold, fontSize=10.5, leading=14, spaceBefore=4, keepWithNext=1
            ),
            "caution": ParagraphStyle(
                "caution", body, leftIndent=8, borderPadding=(1, 3, 1, 4), borderWidth=0, textColor="#7a3b00"
            ),
        }

    def story(self) -> Iterator[Any]:
        """Cover, pages to get ready, true size with strips, steps."""
        from reportlab.platypus import PageBreak

        guide = self.guide
        yield self._words(guide.name, "title")
        yield self._said(guide.lead)
        yield from self._block(guide.cover)
        for page in guide.pages:
            yield self._said(page.title, "h2")
            for block in page.blocks:
                yield from self._block(block)
        yield PageBreak()
        yield from self._true_size()
        yield from self._strips()
        yield PageBreak()
        yield self._words(self.speaker.of("steps-title"), "h2")
        yield self._words(self.speaker.of("read-steps"), "body")
        number = 0
        for chapter in guide.chapters:
            yield self._said(chapter.heading, "h2")
            yield from self._steps(chapter.steps, number)
            number += len(chapter.steps)

    def _words(self, words: str, style: str = "body") -> Any:
        from reportlab.platypus import Paragraph as Printed

        # Names may hold what reads as markup; they stay text.
        return Printed(escape(words), self.styles[style])

    def _said(self, said: Text, style: str = "body") -> Any:
        return self._words(self.speaker.say(said), style)

    def _block(self, block: Block) -> Iterator[Any]:
        match block:
            case Paragraph():
                yield self._said(block.text)
            case Caution():
                yield self._caution(block.text)
            case Heading():
                yield self._said(block.text, "h3")
            case Facts():
                yield self._table(
                    [[self._said(name), self._said(what)] for name, what in block.rows], (0.22, 0.78)
                )
            case Points():
                yield self._points(block)
            case Table():
                yield self._said(block.caption, "h3")
                rows = [block.head, *block.rows]
                yield self._table(
                    [[self._said(cell, "small") for cell in row] for row in rows], _shares(block)
                )
            case Figure():
                yield self._picture(block, LARGE_MM)
                if block.caption is not None:
                    yield self._said(block.caption, "small")

    def _caution(self, said: Text) -> Any:
        return self._words(f"{self.speaker.of('caution')}. {self.speaker.say(said)}", "caution")

    def _points(self, points: Points) -> Any:
        from reportlab.platypus import ListFlowable, ListItem

        items = [ListItem(self._said(item)) for item in points.items]
        options = {"bulletType": "1"} if points.numbered else {"bulletType": "bullet", "start": "•"}
        return ListFlowable(items, bulletFontName=self.fonts[0], bulletFontSize=9, leftIndent=14, **options)

    def _table(self, rows: Sequence[Sequence[Any]], shares: Sequence[float]) -> Any:
        from reportlab.platypus import Table as Printed

        widths = [share * self.room_pt[0] for share in shares]
        style = [
            ("VALIGN", (0, 0), (-1, -1), "TOP"),
            ("LINEBELOW", (0, 0), (-1, -1), 0.3, "#8c8c8c"),
            ("LEFTPADDING", (0, 0), (-1, -1), 0),
            ("TOPPADDING", (0, 0), (-1, -1), 1),
            ("BOTTOMPADDING", (0, 0), (-1, -1), 1),
        ]
        return Printed(rows, colWidths=widths, style=style, hAlign="LEFT", spaceAfter=6)

    def _picture(self, figure: Figure, most_mm: tuple[float, float]) -> Any:
        picture = figure.picture
        width, height = picture.high[0] - picture.low[0], picture.high[1] - picture.low[1]
        scale = min(most_mm[0] / width, most_mm[1] / height)

        def paint(canvas: Any) -> None:
            self._brush(canvas).paint(picture, 0, 0, scale)

        return drawn(width * scale * MM, height * scale * MM, paint)

    def _brush(self, canvas: Any) -> Brush:
        return Brush(canvas, self.fonts[1], self.guide.shared)

    def _steps(self, steps: Sequence[Step], before: int) -> Iterator[Any]:
        """Rows of COLUMNS steps; a row stays on one page unless it is taller than that."""
        from reportlab.platypus import Table as Printed

        cells: list[list[Any]] = [
            self._step(step, before + place) for place, step in enumerate(steps, start=1)
        ]
        width = (self.room_pt[0] + GUTTER_MM * MM) / COLUMNS
        style = [
            ("VALIGN", (0, 0), (-1, -1), "TOP"),
            ("LEFTPADDING", (0, 0), (-1, -1), 0),
            ("RIGHTPADDING", (0, 0), (-1, -1), GUTTER_MM * MM),
            ("BOTTOMPADDING", (0, 0), (-1, -1), 8),
        ]
        for index in range(0, len(cells), COLUMNS):
            row = [*cells[index : index + COLUMNS], *([[]] * COLUMNS)][:COLUMNS]
            tall = max(sum(part.wrap(width - GUTTER_MM * MM, 1e6)[1] for part in cell) for cell in row)
            yield Printed(
                [row],
                colWidths=[width] * COLUMNS,
                style=style,
                hAlign="LEFT",
                splitInRow=int(tall > 0.9 * self.room_pt[1]),
            )

    def _step(self, step: Step, number: int) -> list[Any]:
        cell = [self._words(f"{number}. {self.speaker.say(step.heading)}", "h3")]
        if step.figure is not None:
            cell.append(self._picture(step.figure, STEP_MM))
        cell += [self._said(each, "step") for each in step.texts]
        cell += [self._caution(each) for each in step.cautions]
        if step.kind in ("shape", "end") and step.end_mm > step.start_mm:
            cell.append(
                self._said(text("span", start=Length(step.start_mm), end=Length(step.end_mm)), "small")
            )
        return cell

    def _true_size(self) -> Iterator[Any]:
        """The piece, on as many pages as it takes, each with the lines to check its scale."""
        from reportlab.platypus import PageBreak

        width, height = self.room_pt[0] / MM, self.room_pt[1] / MM
        heading_mm = 14.0
        sheet = TrueSize(self.guide.true_size, (width, height - CAPTION_MM - heading_mm))
        parts = sheet.parts
        for index, part in enumerate(parts, start=1):
            title = self.speaker.of("true-size-title")
            if len(parts) > 1:
                title = self.speaker.of("tile", name=title, part=index, parts=len(parts))
            yield self._words(title, "h2")
            tall = (part[1].high - part[1].low + CAPTION_MM) * MM

            def paint(canvas: Any, part: Any = part) -> None:
                sheet.paint(self._brush(canvas), part, 0, CAPTION_MM * MM)
                check_lines(canvas, self.speaker, self.fonts[0], 0, 0)

            yield drawn(self.room_pt[0], tall, paint)
            if len(parts) > 1:
                yield PageBreak()

    def _strips(self) -> Iterator[Any]:
        yield self._words(self.speaker.of("strips-title"), "h2")
        yield self._words(self.speaker.of("strip-how"))
        for strip in self.guide.strips:
            for part in strip_parts(strip, self.room_pt[0] / MM):
                yield self._strip(part)

    def _strip(self, part: StripPart) -> Any:
        def paint(canvas: Any) -> None:
            part.paint(canvas, self.speaker, self.fonts, 0, 0)

        return drawn(self.room_pt[0], STRIP_MM * MM, paint)


def _shares(table: Table) -> tuple[float, ...]:
    """Widths of columns: the first is as wide as two where there are more than three."""
    count = len(table.head)
    return tuple((2 if index == 0 else 1) / (count + 1) for index in range(count))
