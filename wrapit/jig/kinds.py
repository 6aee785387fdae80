"""The kinds of jig. A new one is a subpackage, a block of the config, its name there, and a line here."""

from __future__ import annotations

from typing import Final

from wrapit.config import JigKind
from wrapit.jig.made import JigMaker
from wrapit.jig.pegs.stage import PEGS
from wrapit.jig.printed.printed_kind import PRINTED
from wrapit.jig.sheet.sheet_kind import SHEET

# In the order in which a config that names them all gets them.
JIGS: Final[dict[JigKind, JigMaker]] = {maker.kind: maker for maker in (PRINTED, SHEET, PEGS)}
