"""The step-by-step guide as one self-contained page."""

from __future__ import annotations

from collections.abc import Sequence

from wrapit.config import GuideConfig, WireConfig
from wrapit.decomposition.model import Solution
from wrapit.instructions.laser_page import plan_laser_page
from wrapit.instructions.pictures import Pictures
from wrapit.instructions.plan import plan_guide
from wrapit.instructions.wording import listed, millimetres
from wrapit.jig.model import JigSet
from wrapit.jig.sheet.model import LaserJig
from wrapit.wires.model import JumpRing, Wire


def write_instructions(
    solution: Solution,
    wires: Sequence[Wire],
    guide_config: GuideConfig,
    wire_config: WireConfig,
    *,
    name: str = "wire jewellery",
    jigset: JigSet | None = None,
    laser: LaserJig | None = None,
    ring: JumpRing | None = None,
) -> str:
    """guide.html: materials, the making of each wire stretch by stretch, ties, assembly.

    With a laser-cut jig, also how to glue it; with a jump ring, where it goes. The page needs no other
    file, no network and no script; the same input gives the same text.
    Raises ValueError when there are no wires.
    """
    from jinja2 import Environment, PackageLoader, StrictUndefined

    if not wires:
        raise ValueError("a guide needs at least one wire")
    guide = plan_guide(solution, wires, guide_config, wire_config, name=name, jigset=jigset, ring=ring)
    environment = Environment(
        loader=PackageLoader("wrapit.instructions", "templates"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters |= {"mm": millimetres, "listed": listed}
    page = plan_laser_page(laser) if laser is not None else None
    template = environment.get_template("guide.html.jinja")
    return template.render(guide=guide, pictures=Pictures(guide), page=page)
