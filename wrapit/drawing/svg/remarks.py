"""What a maker should know about an SVG file: what in it is no line, and what to do about it."""

from __future__ import annotations

from pathlib import Path

from wrapit.drawing.svg.reading.model import Missing, Omission, Page
from wrapit.drawing.svg.seen.losses import Loss, What
from wrapit.errors import DrawingError, Finding

# How many places are named of many.
_NAMED = 3
_NO_COPY = "embed it in the file, or remove it"

# Of each kind: the code of the finding, one and several of them, and the remedy.
_KINDS: dict[Missing, tuple[str, str, str, str]] = {
    "text": (
        "text-left-out",
        "1 text is left out, as letters are no lines",
        "{} texts are left out, as letters are no lines",
        "draw the letters as strokes (a single-line font), or remove the text",
    ),
    "foreign": (
        "text-left-out",
        "1 frame with a web page's text is left out",
        "{} frames with a web page's text are left out",
        "draw the letters as strokes, or remove the text",
    ),
    "picture": (
        "picture-left-out",
        "1 picture within the SVG is left out",
        "{} pictures within the SVG are left out",
        "trace it to strokes, or remove it",
    ),
    "other-file": (
        "other-file",
        "the SVG file refers to another file ({text}), which is never loaded",
        "the SVG file refers to other files ({text}), which are never loaded",
        _NO_COPY,
    ),
    "style-sheet": (
        "other-file",
        "the SVG file names a style sheet in another file, which is never loaded",
        "the SVG file names style sheets in other files, which are never loaded",
        "embed its rules in a <style>, if lines are missing",
    ),
    "recursion": (
        "endless-copy",
        "1 <use> copies itself ({text}) and is left out, as in browsers",
        "{} <use> copy themselves ({text}) and are left out, as in browsers",
        "remove it",
    ),
    "markers": (
        "markers-left-out",
        "1 line has markers (arrowheads), which are left out",
        "{} lines have markers (arrowheads), which are left out",
        "draw them as lines of their own",
    ),
    "path-data": (
        "path-data",
        "the data of {text} is not complete or not in order; it is drawn up to there, as in browsers",
        "the data of {} paths is not complete or not in order ({text}); each is drawn up to there",
        "correct it, or delete the path",
    ),
    "transform": (
        "transform",
        "a transform ({text}) is not in order and is left out, as in browsers",
        "{} transforms ({text}) are not in order and are left out, as in browsers",
        "correct it: numbers or brackets are missing",
    ),
}
# Why no line of a file is seen, and the remedy.
_ALL_LOST: dict[What, tuple[str, str]] = {
    "clipped": (
        "all lines lie outside of the page, or are clipped away",
        "move them into the page, or enlarge the page to the drawing",
    ),
    "hidden": (
        "all lines lie hidden under other ink",
        "move them to the front, or delete what lies over them",
    ),
    "erasing": ("all strokes have the colour of what they lie on", "give the lines a dark colour"),
    "dots": ("the drawing has dots and no lines", "draw at least one line that is longer than a dot"),
    "undrawn": (
        "all lines have no dash on them, as before an animation",
        "remove stroke-dasharray and stroke-dashoffset, and save the file again",
    ),
}


def remarks(page: Page) -> tuple[Finding, ...]:
    """A finding for each kind of thing that is not drawn, or not as it is written."""
    kinds = dict.fromkeys(omission.what for omission in page.omissions)
    return tuple(_remark(kind, [each for each in page.omissions if each.what == kind]) for kind in kinds)


def _remark(kind: Missing, omissions: list[Omission]) -> Finding:
    code, one, several, remedy = _KINDS[kind]
    lines = list(dict.fromkeys(omission.line for omission in omissions))
    texts = list(dict.fromkeys(omission.text for omission in omissions if omission.text))
    text = ", ".join(texts[:_NAMED]) + (", …" if len(texts) > _NAMED else "")
    where = f"line{'s' if len(lines) > 1 else ''} {', '.join(map(str, lines[:_NAMED]))}"
    message = (one if len(omissions) == 1 else several).replace("{text}", text)
    return Finding(
        "warning",
        code,
        f"SVG, {where}{', …' if len(lines) > _NAMED else ''}",
        message.replace("{}", str(len(omissions))),
        remedy,
    )


def refusal(page: Page, filled: int, losses: list[Loss], path: Path) -> DrawingError:
    """Why a file has no lines, as far as it tells: what is left out, or what isn't stroked."""
    first = {omission.what: omission for omission in reversed(page.omissions)}
    stroked = sum(shape.stroke is not None for shape in page.shapes)
    for found in (first.get("path-data"), first.get("other-file")):
        if found:
            remark = _remark(found.what, [found])
            return DrawingError(remark.message, f"{path}:{found.line}", remark.remedy)
    if losses and stroked:
        return _all_lost(losses, path)
    if stroked:
        problem = f"the drawing's lines ({stroked} in all) have no length"
        return DrawingError(problem, str(path), "draw at least one line that is longer than a dot")
    if filled:
        shapes = "1 filled shape" if filled == 1 else f"{filled} filled shapes"
        return DrawingError(
            f"the drawing has {shapes} and no stroked lines",
            str(path),
            "draw centre lines with a stroke (in Canva or Figma: export strokes, not outlines), "
            "or set tracing.filled to outline",
        )
    for found in (first.get("picture"), first.get("text"), first.get("foreign")):
        if found:
            thing = "a picture" if found.what == "picture" else "text"
            remedy = (
                "save that picture as PNG and give that" if found.what == "picture" else _KINDS["text"][3]
            )
            return DrawingError(f"the SVG file holds {thing} and no lines", f"{path}:{found.line}", remedy)
    return DrawingError(
        "the drawing has no stroked lines that are shown",
        str(path),
        "give the lines a stroke (in Illustrator: untick Preserve Illustrator Editing Capabilities "
        "and save as SVG 1.1)",
    )


def _all_lost(losses: list[Loss], path: Path) -> DrawingError:
    """The refusal of a file none of whose lines is seen, by what most of them lack."""
    most = max(dict.fromkeys(loss.what for loss in losses), key=[loss.what for loss in losses].count)
    (first, *_) = (loss for loss in losses if loss.what == most)
    problem, remedy = _ALL_LOST[most]
    return DrawingError(problem, f"{path}:{first.line}", remedy)
