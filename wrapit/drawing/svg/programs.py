"""Which program made an SVG file, as far as the file tells, and how things are done in it."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import Literal

Program = Literal[
    "Adobe Illustrator", "Inkscape", "Figma", "Canva", "Excalidraw", "CorelDRAW", "Affinity", "Sketch", ""
]
# What is to be done: draw lines with strokes, let hidden things go, show what is dashed away.
Task = Literal["stroke", "text", "mask", "picture", "clip", "order", "dash"]

# What a file of each program has in its comments, title, or languages; the
# first that fits counts, as files that went through several programs keep the traces of all.
_TRACES: tuple[tuple[str, Program], ...] = (
    ("excalidraw", "Excalidraw"),
    ("generator: adobe illustrator", "Adobe Illustrator"),
    (r"\bcanva\b", "Canva"),
    ("figma", "Figma"),
    ("coreldraw", "CorelDRAW"),
    ("generator: sketch", "Sketch"),
    ("bohemiancoding", "Sketch"),
    ("serif.com", "Affinity"),
    ("inkscape", "Inkscape"),
    ("sodipodi", "Inkscape"),
    ("adobe illustrator", "Adobe Illustrator"),
    ("ns.adobe.com", "Adobe Illustrator"),
)

# Programs that draw each line as two wobbly strokes.
SKETCHED: tuple[Program, ...] = ("Excalidraw",)

# In the words of the programs' own menus.
_HOW: dict[tuple[Task, Program], str] = {
    (
        "stroke",
        "Adobe Illustrator",
    ): "in Illustrator draw with a stroke and no fill (not Object > Expand or Path > "
    "Outline Stroke) and save it with File > Save As, SVG",
    (
        "stroke",
        "Inkscape",
    ): "in Inkscape give the lines a stroke (Object > Fill and Stroke) and no fill, and undo "
    "Path > Stroke to Path",
    (
        "stroke",
        "Figma",
    ): "in Figma draw with a stroke, don't flatten it or use Outline Stroke, and export it as SVG "
    "with 'Simplify stroke' ticked",
    (
        "stroke",
        "Canva",
    ): "in Canva draw with its lines or its pen tool: graphics from its library are filled shapes",
    ("stroke", "Excalidraw"): "in Excalidraw draw with the line tool: the pencil makes filled shapes",
    (
        "stroke",
        "CorelDRAW",
    ): "in CorelDRAW give the lines an outline and no fill, and don't use Object > Convert Outline to Object",
    (
        "stroke",
        "Affinity",
    ): "in Affinity give the lines a stroke and no fill, and don't use Layer > Expand Stroke",
    (
        "stroke",
        "Sketch",
    ): "in Sketch draw with a border and no fill, and don't use Layer > Convert to Outlines",
    (
        "text",
        "Inkscape",
    ): "in Inkscape draw the letters with Extensions > Text > Hershey Text, or remove the text",
    (
        "mask",
        "Adobe Illustrator",
    ): "in Illustrator choose Object > Clipping Mask > Release, and delete what it hid",
    ("mask", "Inkscape"): "in Inkscape choose Object > Mask > Release, and delete what it hid",
    ("mask", "Figma"): "in Figma select the mask, choose Remove mask, and delete what it hid",
    ("clip", "Adobe Illustrator"): "in Illustrator choose Object > Artboards > Fit to Artwork Bounds, or "
    "Object > Clipping Mask > Release",
    ("clip", "Inkscape"): "in Inkscape choose Edit > Resize Page to Selection, or Object > Clip > Release",
    ("clip", "Figma"): "in Figma untick 'Clip content' of the frame, or enlarge it",
    (
        "order",
        "Adobe Illustrator",
    ): "in Illustrator choose Object > Arrange > Bring to Front for the lines, or delete what lies over them",
    (
        "order",
        "Inkscape",
    ): "in Inkscape choose Object > Raise to Top for the lines, or delete what lies over them",
    ("order", "Figma"): "in Figma choose Bring to front for the lines, or delete what lies over them",
    ("order", "Canva"): "in Canva choose Position > To front for the lines, or delete what lies over them",
    (
        "picture",
        "Inkscape",
    ): "in Inkscape choose Path > Trace Bitmap > Centerline tracing, or save the picture as PNG "
    "and give that",
    ("picture", "Canva"): "in Canva choose Share > Download, PNG, and give that",
    ("picture", "Figma"): "in Figma export the picture as PNG and give that",
    ("dash", "Adobe Illustrator"): "in Illustrator untick 'Dashed Line' in the Stroke panel",
    (
        "dash",
        "Inkscape",
    ): "in Inkscape choose whole lines in Object > Fill and Stroke > Stroke style > Dashes",
}


def program_of(texts: Iterable[str]) -> Program:
    """The program whose traces are in the comments and languages of a file; empty where there are none.

    >>> program_of(["Generator: Adobe Illustrator 27.0, SVG Export Plug-In"])
    'Adobe Illustrator'
    """
    together = "\n".join(texts).lower()
    return next((program for trace, program in _TRACES if re.search(trace, together)), "")


def how(task: Task, program: Program, otherwise: str) -> str:
    """How something is done in a program; what is said otherwise where that is not known."""
    return _HOW.get((task, program), otherwise)
