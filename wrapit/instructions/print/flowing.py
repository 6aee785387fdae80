"""What reportlab is told of pages: numbers below each, and things that are drawn among words."""

from __future__ import annotations

from typing import Any

from wrapit.instructions.print.painting import MM
from wrapit.instructions.words.speaking import Speaker


def numbered_canvas(speaker: Speaker, font: str) -> Any:
    """A canvas that writes `page 3 of 12` below each page, once it knows how many there are."""
    from reportlab.pdfgen.canvas import Canvas

    class Numbered(Canvas):  # type: ignore[misc]
        def __init__(self, *args: Any, **options: Any) -> None:
            super().__init__(*args, **options)
            self._pages: list[dict[str, Any]] = []

        def showPage(self) -> None:  # noqa: N802  reportlab's name
            self._pages.append(dict(self.__dict__))
            self._startPage()

        def save(self) -> None:
            for number, page in enumerate(self._pages, start=1):
                self.__dict__.update(page)
                self.setFont(font, 8)
                said = speaker.of("page-of", page=number, pages=len(self._pages))
                self.drawCentredString(self._pagesize[0] / 2, 8 * MM, said)
                super().showPage()
            super().save()

    return Numbered


def drawn(width_pt: float, height_pt: float, paint: Any) -> Any:
    """Something drawn that takes so much room on a page."""
    from reportlab.platypus import Flowable

    class Drawn(Flowable):  # type: ignore[misc]
        def __init__(self) -> None:
            super().__init__()
            self.width, self.height, self.hAlign = width_pt, height_pt, "LEFT"

        def draw(self) -> None:
            self.canv.saveState()
            paint(self.canv)
            self.canv.restoreState()

    return Drawn()
