"""The step-by-step guide as one self-contained page."""

from __future__ import annotations

from collections.abc import Sequence

from wrapit.config import GuideConfig, WireConfig
from wrapit.decomposition.model import Solution
from wrapit.errors import Finding
from wrapit.instructions.pictures import Pictures
from wrapit.instructions.plan import plan_guide
from wrapit.instructions.wording import duration, listed, millimetres
from wrapit.jig.made import GuidePage, Handling
from wrapit.wires.model import JumpRing, Wire


def write_instructions(
    solution: Solution,
    wires: Sequence[Wire],
    guide_config: GuideConfig,
    wire_config: WireConfig,
    *,
    name: str = "wire jewellery",
    handling: Handling | None = None,
    findings: Sequence[Finding] = (),
    pages: Sequence[GuidePage] = (),
    ring: JumpRing | None = None,
) -> str:
    """guide.html: materials, the making of each wire stretch by stretch, ties, assembly.

    `handling` says which jig holds each wire, `findings` what was found of that jig, `pages` tell of jigs
    themselves, as how to glue one; with a jump ring, where it goes. The page needs no other file, no network
    and no script; the same input gives the same text.
    Raises ValueError when there are no wires.
    """
    from jinja2 import ChoiceLoader, Environment, PackageLoader, StrictUndefined

    if not wires:
        raise ValueError("a guide needs at least one wire")
    guide = plan_guide(
        solution,
        wires,
        guide_config,
        wire_config,
        name=name,
        handling=handling,
        findings=findings,
        ring=ring,
    )
    environment = Environment(
        loader=ChoiceLoader(
            # The pages of jigs lie in the subpackages of their kinds.
            [PackageLoader("wrapit.instructions", "templates"), PackageLoader("wrapit.jig", ".")]
        ),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters |= {"mm": millimetres, "listed": listed, "duration": duration}
    template = environment.get_template("guide.html.jinja")
    return template.render(guide=guide, pictures=Pictures(guide), pages=pages)
