"""The step-by-step guide: planned once, told as a page and as a print."""

from __future__ import annotations

from wrapit.config import GuideConfig
from wrapit.errors import Finding
from wrapit.instructions.model import Guide
from wrapit.instructions.words.speaking import Speaker


def write_page(guide: Guide, config: GuideConfig) -> str:
    """guide.html: one self-contained page in the language and units of the config."""
    from wrapit.instructions.page.write_page import guide_page

    return guide_page(guide, Speaker(config.language, config.units))


def write_print(guide: Guide, config: GuideConfig) -> tuple[bytes, tuple[Finding, ...]]:
    """guide.pdf: for the config's paper; and a note where no font has letters of the piece's name."""
    from wrapit.instructions.print.write_print import guide_pdf

    made, missing = guide_pdf(guide, Speaker(config.language, config.units), config.paper)
    if not missing:
        return made, ()
    unknown = Finding(
        "note",
        "letters-missing",
        "guide.pdf",
        f"the print has no letters for {' '.join(sorted(missing))} in the piece's name",
        "give the piece a name in another script, or print guide.html from a browser",
    )
    return made, (unknown,)
