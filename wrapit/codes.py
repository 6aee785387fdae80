"""What each code of a finding or an error means, and what helps: `make docs` writes a page of it."""

from __future__ import annotations

from typing import Final, NamedTuple


class Saying(NamedTuple):
    """What a code means, and what helps in general; the message itself says where, how much and what next."""

    means: str
    helps: str


NOTHING: Final = "nothing needs to be done"
"""Where a finding only tells what was done."""

DRAWING: Final = {
    "clipped": Saying(
        "lines lie outside of the page, or are clipped away", "enlarge the page, or release the clip"
    ),
    "coarse-picture": Saying(
        "lines are few pixels wide, so places are less sure", "scan at a higher resolution"
    ),
    "dark-edge": Saying("a dark edge of the picture is left out", "crop it if lines are missing"),
    "dark-table": Saying("the ground around the sheet of paper is left out", "crop it if lines are missing"),
    "dashed": Saying("dashed lines are read as whole ones", "remove them if they are guides or folds"),
    "dots": Saying("dots are left out, as a wire needs a length", "draw small circles instead"),
    "drawn-twice": Saying("stretches lie twice upon one another; each is taken once", NOTHING),
    "drawn-twice-by-hand": Saying(
        "two wobbly strokes are taken for one line drawn over by hand", "move them apart if both are meant"
    ),
    "endless-copy": Saying("a `<use>` of an SVG file copies itself and is left out", "remove it"),
    "erasing": Saying(
        "strokes in the colour of what they lie on are no lines", "give them a dark colour if they are meant"
    ),
    "filled-shapes": Saying(
        "filled shapes without a stroke are left out", "give them a stroke, or set `tracing.filled: outline`"
    ),
    "frame": Saying(
        "a rectangle around the drawing is left out", "connect the drawing to it if it belongs to the piece"
    ),
    "gap-closed": Saying("ends of strokes that nearly touch were joined", "leave a wider gap if it is meant"),
    "hidden": Saying("lines under other ink are left out, as nobody sees them", "move them to the front"),
    "joined": Saying(
        "pieces that touch nowhere were joined by a straight link", "draw the link as you like it"
    ),
    "left-out": Saying(
        "a piece that touches nothing else is left out", "connect it, or set `tracing.components: join`"
    ),
    "light-on-dark": Saying("light lines on dark ground were traced", NOTHING),
    "markers-left-out": Saying("arrowheads are left out", "draw them as lines of their own"),
    "masked": Saying("a mask of an SVG file isn't read: all of the line is taken", "release the mask"),
    "misread": Saying(
        "ink and lines differ here by more than a pen's edge is uneven",
        "draw it larger or with a thinner pen, so that lines keep apart, or correct that place",
    ),
    "no-bead": Saying(
        "a dot or ring of the drawing becomes no bead", "draw it beside a line, or as a ring on one"
    ),
    "other-file": Saying(
        "an SVG file refers to another file, which is never loaded", "embed it, or remove it"
    ),
    "path-data": Saying(
        "a path's data is damaged; it is drawn up to there", "correct it, or delete the path"
    ),
    "picture-left-out": Saying("a picture within an SVG file is left out", "give that picture as drawing"),
    "punched-holes": Saying(
        "dark spots near the side are left out", "connect them to the drawing if they belong to it"
    ),
    "ruled-paper": Saying(
        "lines that rule the paper were left out, or traced as part of the drawing", "draw on plain paper"
    ),
    "solid-shapes": Saying("shapes filled in their stroke's colour hide what is inside", "remove the fill"),
    "text-left-out": Saying(
        "text is left out, as letters are no lines", "draw letters as strokes (a single-line font)"
    ),
    "touching": Saying(
        "strokes that touch side by side are taken as apart",
        "leave white paper between them, or let them cross",
    ),
    "transform": Saying(
        "a transform of an SVG file is damaged and left out", "correct its numbers and brackets"
    ),
    "undrawn": Saying("no dash falls on a line, as before an animation", "remove `stroke-dasharray`"),
    "uneven-paper": Saying("uneven light was divided out", NOTHING),
    "unfit": Saying(
        "something stays that wire can't follow, though the drawing was made fit",
        "drop or keep what the message names, or make the piece larger",
    ),
}
"""What was read from the drawing, and what wasn't."""

WIRES: Final = {
    "bail": Saying("a wire's end is bent into a loop to hang the piece from", NOTHING),
    "cramped-double": Saying(
        "a line is too short or bends too tightly for two wires side by side",
        "allow more wires with `decomposition.max_wires`, make the piece larger, or use thinner wire",
    ),
    "doubled-wire": Saying(
        "wire runs along lines twice: back over hanging ones, or to make do with fewer wires",
        "set `decomposition.refine_dangling: never`, or a larger `decomposition.max_wires`",
    ),
    "hairpin-short": Saying(
        "a wire turns back beyond the end of its line, which is too short for the bend",
        "lengthen the line, or use thinner or softer wire",
    ),
    "jump-ring": Saying(
        "no wire ends where the bail is to be; the guide lists a jump ring", "set `bail.at` to a free end"
    ),
    "more-wires-than-needed": Saying(
        "fewer wires could cover the drawing, but would bend or swing more",
        "lower `decomposition.weights`, or drop constraints, for fewer",
    ),
    "not-proven-best": Saying(
        "better wires may exist, by no more than the message says", "raise the limit that the message names"
    ),
    "separate-pieces": Saying(
        "the wires make pieces that nothing joins",
        "join them with a line, or set `decomposition.bridges: true`",
    ),
    "slight-turn": Saying("a slight bend is left to the hand, without a wall", "lower `jig.turn_angle`"),
    "tight-double": Saying(
        "two runs along one line lie upon one another, as it bends too tightly for both side by side",
        "draw the line with wider bends, or use thinner wire",
    ),
    "tight-bend": Saying(
        "the drawing asks for a bend that damages the wire, or can't be made",
        "make the piece larger, use thinner or softer wire, or set `fit: gentle`",
    ),
    "weak-wire": Saying(
        "a wire is tied to the others at one junction only and can swing",
        "extend its line, or set `decomposition.refine_dangling: auto`",
    ),
    "wire-without-solid": Saying(
        "a wire's round solid isn't sound; `wires.step` holds its centreline alone",
        "make the piece larger, or set `fit: gentle`",
    ),
}
"""How the drawing became wires."""

JIG: Final = {
    "bead-below-plate": Saying(
        "a bead reaches through the plate", "lay the jig on strips, or raise `jig.base_thickness`"
    ),
    "bead-between-runs": Saying(
        "a bead is where another run lies close beside its wire", "move the bead to where the wire runs alone"
    ),
    "bead-without-seat": Saying(
        "a bead has no seat: something else is too near", "put it on when the wire is out, or build larger"
    ),
    "form": Saying("wires of one shape share a form", "turn mirrored ones over after bending"),
    "hemmed": Saying("walls stand on both sides of a wire", "press the wire in with a rounded stick"),
    "jig-left-out": Saying(
        "a kind of jig would hold too little and isn't made", "leave it out of `jigs`, or go larger"
    ),
    "loose-end": Saying(
        "let go, a wire's end springs past its hole", "hold it with pliers until it is bent down"
    ),
    "no-course": Saying("the plate has no grooves that show the wires' course", "look at the guide"),
    "no-jig": Saying("a wire has nothing that a jig could hold", "bend it by hand over the drawing"),
    "no-peg": Saying(
        "no peg on the board stands right for a turn", "add to `pegs.diameters`, or bend it by hand"
    ),
    "no-room-for-number": Saying("the plate has no room for a number", "write it on by hand"),
    "not-judged": Saying(
        "`check --exact` can't judge a wire that bends too tightly", "make the piece larger"
    ),
    "pin": Saying("a turn is too tight for a wall", "put a pin into its hole and bend the wire around it"),
    "plain-outline": Saying("an outline is made of short straight lines, within 0.001 mm", NOTHING),
    "plain-wall": Saying("a wall's sides are short straight lines", NOTHING),
    "small-wall": Saying(
        "walls too small to print are left out", "make the piece larger, or lower `jig.min_wall_area`"
    ),
    "split": Saying("one jig would let wires stray, so there are several", "set `jig.split: single` for one"),
    "springback": Saying(
        "a jig bends its wire further than drawn", "let go before you lay it beside the others"
    ),
    "strays": Saying(
        "wrapped tight, a wire cuts a corner", "press it by hand there, or set `jig.split: per-wire`"
    ),
    "unheld-wire": Saying(
        "the jig holds too little of a wire", "go larger, thinner, or `jig.split: per-wire`"
    ),
    "weak-stretch": Saying("a long stretch has wall along a part only", "keep it straight by hand"),
    "weak-turn": Saying(
        "a turn has wall along a part only", "bend it by hand there, or make the piece larger"
    ),
}
"""What the printed jig and the board of pegs hold."""

SHEET: Final = {
    "crossing-cut": Saying("cuts cross or touch", "change the size a little"),
    "cuts-too-near": Saying(
        "cuts lie so near that what is between them burns", "go larger, or reduce `plate.fit`"
    ),
    "hole-in-wall": Saying("a hole has no room beside a wall", "hold the tail with tape there"),
    "kerf-too-wide": Saying(
        "something is narrower than what the laser removes", "measure `plate.kerf` with a coupon"
    ),
    "larger-than-sheet": Saying(
        "a part doesn't fit on the sheet", "set `plate.sheet_width` and `plate.sheet_height`"
    ),
    "narrow-web": Saying("material between two cuts is narrow", "handle with care, or make the piece larger"),
    "number-without-room": Saying("the plate has no room for a wire's number", "write it on by hand"),
    "offset-by-lines": Saying("a wall's cut is made of short straight lines", NOTHING),
    "open-cut": Saying("a cut isn't closed: a fault of the program's", "report the drawing"),
    "plate-of-one": Saying("the DXF is for one of a pair", "mirror it in the laser's program"),
    "seats-in-print-only": Saying(
        "only the printed jig has seats for beads", "hold beads by hand, or print the jig"
    ),
    "shop-dxf-version": Saying(
        "the shop asks for another release of DXF", "set `plate.profile: plain`, save as R12"
    ),
    "shop-kerf": Saying(
        "the shop's lasers remove more or less than `plate.kerf`", "set it to the shop's number"
    ),
    "shop-many-parts": Saying("the shop asks for one part a file", "save each part to a file of its own"),
    "shop-narrow-hole": Saying(
        "holes are narrower than the shop asks for", "take a thinner sheet, or another shop"
    ),
    "shop-narrow-part": Saying(
        "parts are narrower than the shop asks for", "take a thinner sheet, or another shop"
    ),
    "shop-not-cut": Saying("the shop asks for cuts alone", "delete numbers and engraving before you send it"),
    "small-piece": Saying("a wall piece is small to handle", "set it with tweezers"),
    "stacked-walls": Saying(
        "walls are several pieces glued upon one another", "set `plate.wall_sheet` thicker"
    ),
    "turn-without-wall": Saying(
        "turns leave no room for a wall cut from sheet", "bend by hand, or print the jig"
    ),
}
"""What the laser-cut jig, and the shop that cuts it, ask for."""

FILES: Final = {
    "cache": Saying(
        "nothing of this build could be kept for the next one", "free space, or set `WRAPIT_CACHE`"
    ),
    "file-kept": Saying(
        "somebody wrote or changed a file of the output folder, so it stays", "move it away, and build again"
    ),
    "letters-missing": Saying(
        "the print has no letters for the piece's name", "print `guide.html` from a browser"
    ),
    "renamed": Saying("the config's file name can't be a folder's everywhere", "give the piece a `name:`"),
}
"""Names and files."""

ERRORS: Final = {
    "config": Saying(
        "the config or an option is wrong, or a folder can't be used", "change what the message names"
    ),
    "decomposition": Saying("no wires are as the config asks", "drop the constraint that the message names"),
    "drawing": Saying("the file can't be read, or is no line drawing", "save or draw it as the message says"),
    "export": Saying(
        "a file can't be written or replaced", "close programs that have it open; look at the disk"
    ),
    "interrupted": Saying("somebody ended the program", "run it again: earlier files are untouched"),
    "jig": Saying("no jig that works can be made as asked", "change the sizes that the message names"),
    "kernel": Saying(
        "the solid modeller failed, crashed or took too long", "raise `jig.time_limit`, or simplify"
    ),
    "memory": Saying("memory ran out", "close other programs, or simplify the drawing"),
    "system": Saying("the system refused to read or write", "check path, permissions and disk"),
    "unexpected": Saying(
        "a fault of the program's that nobody foresaw", "run again with `-vv`, and report it"
    ),
    "unheld": Saying(
        "walls would hold too little of the turns", "take the size, gauge or fit that the message names"
    ),
    "usage": Saying("the command line isn't one that wrapit knows", "see `wrapit --help`"),
    "wire": Saying("a wire can't be bent as the drawing asks", "make the piece larger, or the wire thinner"),
}
"""Why a command ended without what it was to make; `--json` gives the code in `error.code`."""

FINDINGS: Final = {
    "What was read from the drawing": DRAWING,
    "The wires": WIRES,
    "The jig": JIG,
    "The laser-cut jig": SHEET,
    "Files": FILES,
}
"""By what they are about."""
