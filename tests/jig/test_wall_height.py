"""Two laws of wall height, held to their words."""

from __future__ import annotations

import math

from hypothesis import given
from hypothesis import strategies as st

from wrapit.config import JigConfig, PlateConfig
from wrapit.jig.sheet.parts import copies_needed
from wrapit.jig.wall_height import HEADROOM_MM, glued_height_mm, wall_height_mm

LAYERS = st.integers(1, 8)
DIAMETERS = st.floats(0.2, 4)


@given(LAYERS, DIAMETERS, st.floats(0.1, 20))
def test_a_printed_wall_has_room_for_one_layer_more(layers: int, diameter_mm: float, asked_mm: float) -> None:
    height_mm = wall_height_mm(layers, diameter_mm, JigConfig.model_construct(min_wall_height=asked_mm))
    assert height_mm >= asked_mm
    assert height_mm - HEADROOM_MM >= (layers + 1) * diameter_mm - 1e-9
    assert height_mm == asked_mm or math.isclose(height_mm, (layers + 1) * diameter_mm + HEADROOM_MM)


@given(LAYERS, DIAMETERS, st.floats(1, 10), st.floats(1, 10))
def test_glued_pieces_are_the_fewest_that_reach_the_wires(
    layers: int, diameter_mm: float, sheet_mm: float, wall_sheet_mm: float
) -> None:
    config = PlateConfig.model_construct(sheet=sheet_mm, wall_sheet=wall_sheet_mm)
    copies = copies_needed(layers, diameter_mm, config)
    needed_mm = sheet_mm + glued_height_mm(layers, diameter_mm)
    assert copies * wall_sheet_mm >= needed_mm - 0.1 - 1e-9
    assert copies == 1 or (copies - 1) * wall_sheet_mm < needed_mm - 0.1


def test_glued_walls_of_18_awg_are_one_piece_where_the_printed_law_asks_for_two() -> None:
    sheet = PlateConfig()
    assert copies_needed(1, 1.0237, sheet) == 1
    assert wall_height_mm(1, 1.0237, JigConfig()) > sheet.wall_sheet - sheet.sheet
