"""Contours become one chain, or lines and arcs, and keep their lengths in the file."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET

import numpy as np
import pytest
from svgelements import Path as SvgPath

from tests.exports.pieces_for_tests import arc_chain, eye
from tests.jig.sheet.laser import laser_of
from wrapit.config import JigConfig, PlateConfig
from wrapit.exports.contour_edges import as_bulges, as_chain
from wrapit.exports.plate_svg import plate_svg
from wrapit.geometry import Arc, Line
from wrapit.jig.contours import FlatDrawing
from wrapit.jig.sheet.checks import length_mm


def test_mixed_edges_become_one_chain_without_gaps() -> None:
    edges = (
        Line((0, 0), (4, 0)),
        Arc((4, 1), 1.0, -math.pi / 2, math.pi),
        Line((4 + 1e-9, 2), (0, 2)),
        Arc((0, 1), 1.0, math.pi / 2, math.pi),
    )
    chain = as_chain(edges, closed=True)
    assert np.array_equal(chain.start, chain.end)
    assert chain.length == pytest.approx(8 + 2 * math.pi, abs=1e-6)
    with pytest.raises(ValueError, match="apart"):
        as_chain((Line((0, 0), (1, 0)), Line((1.1, 0), (0, 0))), closed=True)


def test_bulges_are_the_arcs() -> None:
    vertices = as_bulges((Arc((0, 0), 2.0, 0.0, math.pi), Line((-2, 0), (2, 0))), closed=True)
    assert vertices[0] == pytest.approx((2, 0, 1.0))
    assert vertices[1] == pytest.approx((-2, 0, 0.0), abs=1e-12)
    with pytest.raises(ValueError, match="Bézier"):
        as_bulges((arc_chain((0, 0), 1, 0, 1),), closed=False)


def test_svg_is_at_true_size_with_the_lengths_of_the_contours() -> None:
    # All turns held on their inside: one wall goes round another part, so that there are inner cuts too.
    laser, _ = laser_of(eye()[1], PlateConfig(), JigConfig(support="turns"))
    sheet = laser.sheets[-1]
    root = ET.fromstring(
        plate_svg(FlatDrawing("plate", "a & b", sheet.contours, sheet.width_mm, sheet.height_mm))
    )
    assert root.get("width") == f"{sheet.width_mm:g}mm"
    assert root.get("viewBox") == f"0 0 {sheet.width_mm:g} {sheet.height_mm:g}"
    groups = {group.get("id"): group for group in root if group.tag.endswith("}g")}
    assert list(groups) == ["NOTE", "ENGRAVE", "CUT_INNER", "CUT_OUTER"]
    assert groups["CUT_OUTER"].get("stroke") == "#ff0000"
    for layer, group in groups.items():
        assert group.get("fill") == "none"
        drawn = sorted(SvgPath(path.get("d")).length(error=1e-6) for path in group)
        planned = sorted(length_mm(contour) for contour in sheet.contours if contour.layer == layer)
        assert drawn == pytest.approx(planned, abs=5e-3)
