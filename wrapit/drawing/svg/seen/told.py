"""What is told of lines that are not read, or not as they are drawn: one finding of each kind."""

from __future__ import annotations

from wrapit.drawing.svg.programs import Program, Task, how
from wrapit.drawing.svg.seen.losses import Loss, What
from wrapit.errors import Finding, Level

# How many names or places are given of many.
NAMED = 3

# Of each kind: how grave it is, what is said of one and of several with their length, and the remedy.
_WORDS: dict[What, tuple[Level, str, str, str]] = {
    "clipped": (
        "warning",
        "{mm} mm of lines lie outside of the page, or are clipped away, and are left out",
        "{mm} mm of lines lie outside of the page, or are clipped away, and are left out",
        "enlarge the page to the drawing, or release the clip",
    ),
    "hidden": (
        "warning",
        "{mm} mm of lines lie hidden under other ink and are left out, as they are not seen",
        "{mm} mm of lines ({count} stretches) lie hidden under other ink and are left out, as "
        "they are not seen",
        "if they are meant, move them to the front, or delete what lies over them",
    ),
    "erasing": (
        "note",
        "1 stroke ({mm} mm) has the colour of what it lies on and is no line",
        "{count} strokes ({mm} mm) have the colour of what they lie on and are no lines",
        "if they are meant, give them a dark colour",
    ),
    "dots": (
        "warning",
        "1 dot is left out, as a wire needs a length",
        "{count} dots are left out, as a wire needs a length",
        "draw small circles instead",
    ),
    "dashed": (
        "note",
        "1 dashed line ({mm} mm) is read as a whole line",
        "{count} dashed lines ({mm} mm) are read as whole lines",
        "remove them if they are no lines of the piece, as guides and folds",
    ),
    "undrawn": (
        "warning",
        "{mm} mm of a line have no dash on them, as before an animation, and are left out",
        "{mm} mm of {count} lines have no dash on them, as before an animation, and are left out",
        "if they are meant, remove stroke-dasharray and stroke-dashoffset",
    ),
    "masked": (
        "warning",
        "1 line has a mask ({names}), which is not read: all of the line is taken",
        "{count} lines have a mask ({names}), which is not read: all of the lines are taken",
        "release the mask, and delete what of the lines it hides",
    ),
}

# What is to be done about it in the program that made the file.
TASKS: dict[What, Task] = {"clipped": "clip", "hidden": "order", "masked": "mask", "undrawn": "dash"}


def told(losses: list[Loss], mm_per_px: float, program: Program) -> list[Finding]:
    """A finding for each kind of loss: how much in all, and where the longest are, in px and by line."""
    kinds = dict.fromkeys(loss.what for loss in losses)
    return [_told([loss for loss in losses if loss.what == kind], mm_per_px, program) for kind in kinds]


def _told(losses: list[Loss], mm_per_px: float, program: Program) -> Finding:
    """The finding for losses of one kind."""
    level, one, several, remedy = _WORDS[losses[0].what]
    if (task := TASKS.get(losses[0].what)) is not None:
        remedy = how(task, program, remedy)
    longest = sorted(losses, key=lambda loss: -loss.length_px)[:NAMED]
    length = mm_per_px * sum(loss.length_px for loss in losses)
    names = list(dict.fromkeys(loss.name for loss in losses))
    said = ", ".join(map(repr, names[:NAMED])) + (", …" if len(names) > NAMED else "")
    message = (one if len(losses) == 1 else several).format(mm=_mm(length), count=len(losses), names=said)
    return Finding(level, losses[0].what, where(longest, len(losses)), message, remedy, length)


def where(losses: list[Loss], count: int) -> str:
    """The places of some losses of many, in px of the file, and in which lines of its text they are."""
    places = ", ".join(f"({loss.at[0]:.1f}, {loss.at[1]:.1f})" for loss in losses)
    lines = ", ".join(map(str, sorted({loss.line for loss in losses})))
    plural = "s" if "," in lines else ""
    return f"at {places}{', …' if count > len(losses) else ''} px, line{plural} {lines}"


def _mm(length: float) -> str:
    """A length in words: never 0.0 for what is there."""
    return f"{length:.1f}" if length >= 0.05 else f"{length:.2g}"
