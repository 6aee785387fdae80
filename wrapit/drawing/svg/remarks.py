"""What a maker should know about an SVG file: what in it is no line, and what to do about it."""

from __future__ import annotations

from pathlib import Path

from wrapit.drawing.svg.programs import Program, Task, how
from wrapit.drawing.svg.reading.model import Missing, Omission, Page, Shape
from wrapit.drawing.svg.seen.losses import Loss, What
from wrapit.drawing.svg.seen.parting import middle
from wrapit.drawing.svg.seen.told import NAMED, TASKS
from wrapit.errors import DrawingError, Finding

# What helps where a file refers to another.
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
# What to do where the program is not known.
_STROKE = (
    "draw centre lines with a stroke (in Illustrator or Inkscape: not expanded, no stroke to path; in Canva "
    "or Figma: export strokes, not outlines)"
)
_PICTURE = "save that picture as PNG and give that"
_NO_LINES = (
    "give the lines a stroke (in Illustrator: untick Preserve Illustrator Editing Capabilities and save as "
    "SVG 1.1)"
)
# What is to be done about it in the program that made the file.
_TASKS: dict[Missing, Task] = {"text": "text", "picture": "picture"}
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
    return tuple(
        _remark(kind, [each for each in page.omissions if each.what == kind], page.program) for kind in kinds
    )


def _remark(kind: Missing, omissions: list[Omission], program: Program) -> Finding:
    code, one, several, remedy = _KINDS[kind]
    if (task := _TASKS.get(kind)) is not None:
        remedy = how(task, program, remedy)
    lines = list(dict.fromkeys(omission.line for omission in omissions))
    texts = list(dict.fromkeys(omission.text for omission in omissions if omission.text))
    text = ", ".join(texts[:NAMED]) + (", …" if len(texts) > NAMED else "")
    where = f"line{'s' if len(lines) > 1 else ''} {', '.join(map(str, lines[:NAMED]))}"
    message = (one if len(omissions) == 1 else several).replace("{text}", text)
    return Finding(
        "warning",
        code,
        f"SVG, {where}{', …' if len(lines) > NAMED else ''}",
        message.replace("{}", str(len(omissions))),
        remedy,
    )


def refusal(page: Page, filled: list[Shape], losses: list[Loss], path: Path) -> DrawingError:
    """Why a file has no lines, as far as it tells: what is left out, or what isn't stroked."""
    first = {omission.what: omission for omission in reversed(page.omissions)}
    stroked = sum(shape.stroke is not None for shape in page.shapes)
    for found in (first.get("path-data"), first.get("other-file")):
        if found:
            remark = _remark(found.what, [found], page.program)
            return DrawingError(remark.message, f"{path}:{found.line}", remark.remedy)
    # What erases is no reason where there is something to erase.
    lost = [loss for loss in losses if loss.what in _ALL_LOST and not (filled and loss.what == "erasing")]
    if lost:
        return _all_lost(lost, path, page.program)
    if filled:
        shapes = "1 filled shape" if len(filled) == 1 else f"{len(filled)} filled shapes"
        problem = f"the drawing has {shapes} and no stroked lines"
        remedy = f"{how('stroke', page.program, _STROKE)}, or set tracing.filled to outline"
        return DrawingError(problem, f"{path}:{filled[0].line}", remedy)
    if stroked:
        problem = f"the drawing's lines ({stroked} in all) have no length"
        return DrawingError(problem, str(path), "draw at least one line that is longer than a dot")
    for found in (first.get("picture"), first.get("text"), first.get("foreign")):
        if found:
            thing = "a picture" if found.what == "picture" else "text"
            remedy = how("picture", page.program, _PICTURE) if thing == "a picture" else _KINDS["text"][3]
            return DrawingError(f"the SVG file holds {thing} and no lines", f"{path}:{found.line}", remedy)
    remedy = how("stroke", page.program, _NO_LINES)
    return DrawingError("the drawing has no stroked lines that are shown", str(path), remedy)


def _all_lost(losses: list[Loss], path: Path, program: Program) -> DrawingError:
    """The refusal of a file none of whose lines is seen, by what most of them lack."""
    most = max(dict.fromkeys(loss.what for loss in losses), key=[loss.what for loss in losses].count)
    (first, *_) = (loss for loss in losses if loss.what == most)
    problem, remedy = _ALL_LOST[most]
    if (task := TASKS.get(most)) is not None:
        remedy = how(task, program, remedy)
    return DrawingError(problem, f"{path}:{first.line}", remedy)


def of_fills(filled: list[Shape], solid: list[Shape], how_filled: str, program: Program) -> list[Finding]:
    """What is told of filled shapes: those without a stroke, and those whose stroke has their colour."""
    found = []
    if filled and how_filled != "outline":
        shapes = "1 filled shape" if len(filled) == 1 else f"{len(filled)} filled shapes"
        message = f"{shapes} without a stroke {'is' if len(filled) == 1 else 'are'} left out"
        remedy = f"{how('stroke', program, 'give them a stroke')}, or set tracing.filled to outline"
        found.append(Finding("warning", "filled-shapes", _where(filled), message, remedy))
    if solid:
        shapes = "1 shape is" if len(solid) == 1 else f"{len(solid)} shapes are"
        message = f"{shapes} filled in the colour of the stroke; the outline is read, not what is inside"
        found.append(
            Finding("note", "solid-shapes", _where(solid), message, "remove the fill to see the lines")
        )
    return found


def _where(shapes: list[Shape]) -> str:
    """The places of shapes in the page, and their lines in the file."""
    places = ", ".join("({:.1f}, {:.1f})".format(*middle(shape.curves[0])) for shape in shapes[:NAMED])
    lines = ", ".join(map(str, sorted({shape.line for shape in shapes[:NAMED]})))
    plural = "s" if "," in lines else ""
    return f"at {places}{', …' if len(shapes) > NAMED else ''} px, line{plural} {lines}"
