"""Each breach of a shop's rules is found where it is, with its number; what keeps to them is not."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from wrapit.config import PlateConfig
from wrapit.geometry import Line, Region
from wrapit.geometry.outlines.loops import circle, rounded_rectangle
from wrapit.jig.contours import Contour
from wrapit.jig.sheet.model import LaserPart, LaserSheet, Placed
from wrapit.jig.sheet.narrow import narrow_parts, small_holes
from wrapit.jig.sheet.shops import SHOPS, check_shop

KERF_MM = 0.2
LARGE = rounded_rectangle(0, 0, 40, 30, 1)


def sheet_of(*contours: Contour, copies: int = 1, thickness_mm: float = 3.0) -> LaserSheet:
    part = LaserPart("7", "wall", "jig", Region(LARGE), thickness_mm, contours)
    placed = tuple(Placed(part, 0, (50.0 * index, 5.0)) for index in range(copies))
    return LaserSheet(1, thickness_mm, 300, 200, placed)


def outline() -> Contour:
    return Contour("CUT_OUTER", LARGE.edges)


def hole(diameter_mm: float, at: tuple[float, float] = (20, 15)) -> Contour:
    """Drawn half a kerf within the hole that remains."""
    return Contour("CUT_INNER", circle(at, (diameter_mm - KERF_MM) / 2).edges)


def dumbbell(neck_mm: float, first_mm: float, second_mm: float) -> Contour:
    """Two squares, a bar of 10 mm between them about 0, 0; drawn half a kerf outside."""
    out = KERF_MM / 2
    half, left, right = neck_mm / 2 + out, first_mm / 2 + out, second_mm / 2 + out
    a, b = -5 + out, 5 - out
    corners = [
        (a, half), (a, left), (a - 2 * left, left), (a - 2 * left, -left), (a, -left), (a, -half),
        (b, -half), (b, -right), (b + 2 * right, -right), (b + 2 * right, right), (b, right), (b, half),
    ]  # fmt: skip
    return Contour("CUT_OUTER", tuple(map(Line, corners, [*corners[1:], corners[0]])))


@given(st.floats(0.5, 6), st.floats(0.5, 6))
def test_a_hole_is_small_if_its_diameter_is(diameter_mm: float, least_mm: float) -> None:
    found = list(small_holes(sheet_of(outline(), hole(diameter_mm)), least_mm, KERF_MM))
    if abs(diameter_mm - least_mm) < 5e-3:
        return
    assert bool(found) == (diameter_mm < least_mm)
    for each in found:
        assert each.width_mm == pytest.approx(diameter_mm, abs=0.01)
        assert each.at == pytest.approx((20, 20), abs=0.05)


@given(st.floats(0.5, 2.5), st.floats(0.4, 4), st.floats(0.4, 4), st.floats(0.5, 5))
def test_a_neck_is_found_between_large_and_small_ends(
    neck_mm: float, more_mm: float, other_mm: float, least_mm: float
) -> None:
    part = dumbbell(neck_mm, neck_mm + more_mm, neck_mm + other_mm)
    found = list(narrow_parts(sheet_of(part), least_mm, KERF_MM))
    if abs(neck_mm - least_mm) < 5e-3:
        return
    assert bool(found) == (neck_mm < least_mm)
    for each in found:
        assert each.width_mm == pytest.approx(neck_mm, abs=0.01)
        assert abs(each.at[0]) <= 5 + KERF_MM
        assert each.at[1] == pytest.approx(5, abs=neck_mm)


@given(st.floats(0.3, 4), st.floats(0.5, 4))
def test_a_web_beside_a_hole_is_part_of_it(web_mm: float, least_mm: float) -> None:
    part = sheet_of(outline(), hole(6, (KERF_MM / 2 + web_mm + 3, 15)))
    found = list(narrow_parts(part, least_mm, KERF_MM))
    if abs(web_mm - least_mm) < 5e-3:
        return
    assert bool(found) == (web_mm < least_mm)
    assert all(each.width_mm == pytest.approx(web_mm, abs=2e-3) for each in found)


def codes(sheet: LaserSheet, **settings: object) -> set[str]:
    config = PlateConfig.model_validate({"kerf": f"{KERF_MM} mm", **settings})
    findings = check_shop([sheet], config)
    assert all(finding.where and finding.remedy for finding in findings)
    return {finding.code for finding in findings}


def test_what_each_shop_says_of_a_sheet_of_parts() -> None:
    sheet = sheet_of(outline(), hole(2), Contour("ENGRAVE", (Line((1, 1), (2, 2)),)), copies=2)
    shop = {"shop-many-parts", "shop-not-cut"}
    assert codes(sheet, shop="none") == set()
    assert codes(sheet, shop="ponoko") == set()
    assert codes(sheet, shop="ponoko", kerf="0.15 mm") == {"shop-kerf"}
    assert codes(sheet, shop="sendcutsend") == shop
    assert codes(sheet, shop="lasercut.parts") == {*shop, "shop-narrow-hole", "shop-dxf-version"}
    thick = sheet_of(outline(), hole(2), thickness_mm=6)
    assert codes(thick, shop="sendcutsend") == {"shop-narrow-hole"}


def test_one_plain_part_is_fine_everywhere() -> None:
    for shop in SHOPS:
        assert codes(sheet_of(outline(), hole(8)), shop=shop) <= {"shop-dxf-version"}
