"""A dependency file for make, as compilers write it: what a piece was built from, and what was built.

GNU make has no one way to write any name: it looks at a line several times, each time for other characters,
and each time takes away the backslashes before them. So two backslashes before such a character stand for one
(elsewhere each stands for itself), and what has no escape comes from a variable, which make looks into later.
"""

from __future__ import annotations

import os
import re
from collections.abc import Sequence
from pathlib import Path
from typing import Final

from wrapit.errors import ExportError
from wrapit.pipeline.textfile import write_whole

# What make takes for something else in a name, and how it is said instead.
_VARIABLES: Final = {
    "$": "$$",
    "=": "$(wrapit.equals)",  # else the line would set a variable
    ";": "$(wrapit.semicolon)",  # else the rest of the line would be a recipe
    "\t": "$(wrapit.tab)",
    "\n": "$(wrapit.newline)",
}
# These variables, for characters that have no escape.
_HEAD: Final = """\
wrapit.equals := =
wrapit.semicolon := ;
wrapit.tab := $()\t$()
define wrapit.newline


endef
"""
# Something that make has no name for can't be looked at, so what needs it is built each time.
_ALWAYS: Final = "wrapit.always"


def write_depfile(path: Path, target: Path, sources: Sequence[Path], products: Sequence[Path]) -> None:
    """Writes a rule by which the target needs each source and each product, and an empty rule for these.

    By the empty rules, make builds the target again when one of them is gone (and says nothing against a
    source that was renamed). Where make can't name one of them, it builds the target each time. Raises
    ExportError when make can't name the target, or the file can't be written.
    """
    if not _has_name(target):
        raise ExportError("make can't handle a file of that name", str(target), "choose another -o")
    needed = dict.fromkeys((*sources, *products))
    lines = [line for each in needed for line in _rules(target, each)]
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        write_whole(path, _HEAD + "\n".join(lines) + "\n")
    except (OSError, UnicodeError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise ExportError(f"can't be written ({reason.lower()})", str(path), "choose another -MF") from None


def as_needed(path: Path) -> str:
    r"""A path as make reads it right of a rule's colon.

    >>> as_needed(Path("art/my $1 #2.png"))
    'art/my\\ $$1\\ \\#2.png'
    """
    return _escaped(_text(path), " \\t#:;|")


def as_target(path: Path) -> str:
    r"""A path as make reads it left of a rule's colon, where a percent sign would make the rule a pattern.

    >>> as_target(Path("art/100%|.png"))
    'art/100\\%|.png'
    """
    return _escaped(_text(path), " \\t#:;%")


def _rules(target: Path, needed: Path) -> list[str]:
    """A line for each pair: among others on its line, a lone parenthesis would begin a list of members.

    The `|` (nothing follows that is needed only to be there) and the space before the colon keep a last
    backslash from the line's end, and a last `&` from the colon, where they mean something.
    """
    if not _has_name(needed):
        return [f".PHONY: {_ALWAYS}", f"{as_target(target)} : {_ALWAYS}"]
    return [f"{as_target(target)} : {as_needed(needed)} |", f"{as_target(needed)} :"]


def _has_name(path: Path) -> bool:
    """Whether make can name a file: `a(b)` is an archive's member, and bytes may be no text."""
    text = _text(path)
    return not (text.endswith(")") and "(" in text) and not re.search("[\ud800-\udfff]", text)


def _text(path: Path) -> str:
    """A path that is neither somebody's home (`~`) nor one of make's words, and begins with no space."""
    tidy = Path(os.path.normpath(path)) if ".." not in path.parts else path
    text = tidy.as_posix()  # make's separator is a slash on every system
    if text[0] == "~" or text[0].isspace():
        return tidy.absolute().as_posix()  # for make takes away a `./`
    return text if "/" in text else f"./{text}"


def _escaped(text: str, special: str) -> str:
    r"""A name with a backslash before each special character, and twice those that stand before one or last.

    >>> print(_escaped(r"a\b\#c" + "\\", "#"))
    a\b\\\#c\\
    """
    if re.search(r"[*?\[]", text):  # make takes it for a pattern, in which no backslash stands for itself
        text = re.sub(r"[*?\[\\]", r"\\\g<0>", text)
    text = re.sub(rf"\\+(?=[{special}]|\Z)", r"\g<0>\g<0>", text)
    text = re.sub(rf"[{special}]", r"\\\g<0>", text)
    return "".join(_VARIABLES.get(each, each) for each in text)
