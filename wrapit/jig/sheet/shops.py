"""What cutting services publish that they ask of a file; each breach is a finding with place and numbers."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Final

from wrapit.config import PlateConfig
from wrapit.config.plate import ShopName
from wrapit.errors import Finding
from wrapit.jig.sheet.model import LaserSheet
from wrapit.jig.sheet.narrow import Narrow, narrow_parts, small_holes

# A kerf that is off by this much makes the fit twice as tight or loose as the default `plate.fit` of 0.05 mm.
KERF_OFF_MM = 0.05


@dataclass(frozen=True)
class ShopRules:
    """A shop's own numbers; None where it publishes none. Least sizes are shares of the sheet's thickness."""

    name: str
    least_hole: float | None = None
    least_bridge: float | None = None
    single_part: bool = False
    cuts_only: bool = False
    kerf_mm: float | None = None
    dxf_versions: str | None = None


# Only rules that a shop publishes and that could be read; the pages stand beside them.
SHOPS: Final[dict[ShopName, ShopRules]] = {
    # sendcutsend.com/education/video/designing-parts-to-pass-dfm: holes and bridges at least half of the
    # thickness. sendcutsend.com/guidelines/sheet-cutting: only the part's cut path, closed, nothing twice, no
    # text, mm or inches. sendcutsend.com/blog/10-common-reasons-your-design-is-failing-sendcutsend-preflight:
    # one part a file. Read in November 2026.
    "sendcutsend": ShopRules("SendCutSend", 0.5, 0.5, single_part=True, cuts_only=True),
    # help.ponoko.com/en/articles/3149752-how-does-laser-cutting-work: cuts on the line's centre, 0.2 mm wide
    # on average. Read in November 2026; sizes stand on the pages of single materials, which were not read.
    "ponoko": ShopRules("Ponoko", kerf_mm=0.2),
    # lasercut.parts/en/design-guide: one part a file, nothing but cuts, engraving by a PDF drawing only.
    # lasercut.parts/en/blog/how-to-prepare-dxf-file: a hole is at least as wide as the sheet is thick; R12 or
    # R14. Read in November 2026.
    "lasercut.parts": ShopRules(
        "lasercut.parts", 1.0, single_part=True, cuts_only=True, dxf_versions="R12 or R14"
    ),
}


def check_shop(sheets: Sequence[LaserSheet], config: PlateConfig) -> tuple[Finding, ...]:
    """A finding for each sheet and rule of `plate.shop` that it breaks; none without a shop.

    What all shops ask (closed cuts, none that crosses or repeats another) is asked by `checks.check_sheets`.
    """
    if config.shop == "none":
        return ()
    rules = SHOPS[config.shop]
    return tuple(finding for finding in _findings(rules, sheets, config) if finding is not None)


def _findings(
    rules: ShopRules, sheets: Sequence[LaserSheet], config: PlateConfig
) -> Iterator[Finding | None]:
    yield _kerf(rules, config)
    yield _version(rules)
    for sheet in sheets:
        if rules.least_hole is not None:
            least_mm = rules.least_hole * sheet.thickness_mm
            yield _narrow(rules, sheet, "hole", least_mm, small_holes(sheet, least_mm, config.kerf))
        if rules.least_bridge is not None:
            least_mm = rules.least_bridge * sheet.thickness_mm
            yield _narrow(rules, sheet, "part", least_mm, narrow_parts(sheet, least_mm, config.kerf))
        if rules.single_part:
            yield _many_parts(rules, sheet)
        if rules.cuts_only:
            yield _more_than_cuts(rules, sheet)


def _kerf(rules: ShopRules, config: PlateConfig) -> Finding | None:
    # Not by a rounding error less than the limit.
    if rules.kerf_mm is None or abs(config.kerf - rules.kerf_mm) < KERF_OFF_MM - 1e-9:
        return None
    return Finding(
        "warning",
        "shop-kerf",
        "plate.kerf",
        f"the files reckon with {config.kerf:g} mm; {rules.name}'s lasers remove "
        f"{rules.kerf_mm:g} mm on average",
        f"set plate.kerf to {rules.kerf_mm:g} mm, or to what the page of your material says",
    )


def _version(rules: ShopRules) -> Finding | None:
    if rules.dxf_versions is None:
        return None
    return Finding(
        "note",
        "shop-dxf-version",
        "the laser's DXF files",
        f"they are of release R2010; {rules.name} asks for {rules.dxf_versions}",
        "set plate.profile to plain (lines and arcs, which R12 has), and save them as R12 in LibreCAD",
    )


def _narrow(
    rules: ShopRules, sheet: LaserSheet, what: str, least_mm: float, found: Iterable[Narrow]
) -> Finding | None:
    narrow = sorted(found, key=lambda each: each.width_mm)
    if not narrow:
        return None
    worst, count = narrow[0], len(narrow)
    labels = ", ".join(sorted({each.label for each in narrow}))
    subject = f"{count} {what}s are" if count > 1 else f"a {what} is"
    return Finding(
        "warning",
        f"shop-narrow-{what}",
        f"sheet {sheet.number} at ({worst.at[0]:.1f}, {worst.at[1]:.1f})",
        f"{subject} narrower than the {least_mm:g} mm that {rules.name} asks in a sheet of "
        f"{sheet.thickness_mm:g} mm, the narrowest {worst.width_mm:.2f} mm (in part {labels})",
        "take a thinner sheet, make the piece larger, or ask another shop",
    )


def _many_parts(rules: ShopRules, sheet: LaserSheet) -> Finding | None:
    if len(sheet.placed) < 2:
        return None
    return Finding(
        "warning",
        "shop-many-parts",
        f"sheet {sheet.number}",
        f"{len(sheet.placed)} parts lie in one file; {rules.name} asks for one part a file",
        "save each part to a file of its own in a drawing program, or ask a shop that cuts whole sheets",
    )


def _more_than_cuts(rules: ShopRules, sheet: LaserSheet) -> Finding | None:
    layers = sorted({contour.layer for contour in sheet.contours if not contour.is_cut})
    if not layers:
        return None
    count = sum(not contour.is_cut for contour in sheet.contours)
    names = " and ".join(layers)
    return Finding(
        "warning",
        "shop-not-cut",
        f"sheet {sheet.number}",
        f"{count} lines on {names} are not cuts; {rules.name} asks for nothing but cuts",
        f"delete what is on {names} before you send it, and mark the parts by hand",
    )
