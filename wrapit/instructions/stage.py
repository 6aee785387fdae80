"""The step-by-step guide: planned once, told as a page and as a print."""

from __future__ import annotations

from wrapit.config import GuideConfig
from wrapit.instructions.model import Guide
from wrapit.instructions.words.speaking import Speaker


def write_page(guide: Guide, config: GuideConfig) -> str:
    """guide.html: one self-contained page in the language and units of the config."""
    from wrapit.instructions.page.write_page import guide_page

    return guide_page(guide, Speaker(config.language, config.units))
