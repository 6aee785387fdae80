"""The guide as one self-contained page: cards to leaf through, or all at once where no script runs."""

from __future__ import annotations

from wrapit.instructions.model import Guide, Step
from wrapit.instructions.page.picture_svg import definitions, picture_svg
from wrapit.instructions.words.speaking import Speaker
from wrapit.pages.model import Length, text


def guide_page(guide: Guide, speaker: Speaker) -> str:
    """The page: no other file, no network; the same guide gives the same text."""
    from jinja2 import Environment, PackageLoader, StrictUndefined

    environment = Environment(
        loader=PackageLoader("wrapit.instructions.page", "."),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )

    def span(step: Step) -> str:
        return speaker.say(text("span", start=Length(step.start_mm), end=Length(step.end_mm)))

    steps = guide.steps
    return environment.get_template("guide.html.jinja").render(
        guide=guide,
        numbers={step: number for number, step in enumerate(steps, start=1)},
        say=speaker.of,
        speak=speaker.say,
        span=span,
        step_of=speaker.of("step-of", step="#", steps=len(steps)),
        picture=picture_svg,
        definitions=definitions(guide.shared),
    )
