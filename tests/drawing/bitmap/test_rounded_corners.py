"""Polygons with rounded corners, as a renderer draws them: small ones stay round, true corners corners."""

from __future__ import annotations

import io
import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from PIL import Image
from shapely.geometry import LinearRing, Point

from tests.drawing.bitmap.figures import in_pixels
from tests.drawing.generated import degrees
from wrapit.config import TracingConfig
from wrapit.drawing.model import Drawing
from wrapit.drawing.stage import trace
from wrapit.geometry import FloatArray

resvg_py = pytest.importorskip("resvg_py", reason="the renderer is not here: pip install resvg_py")

some = settings(
    max_examples=8,
    deadline=None,
    derandomize=True,
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)
JOINS = [(3, "round"), (4, "round"), (5, "round"), (4, "miter"), (4, "bevel"), (5, "bevel")]
WIDTHS = st.floats(6, 16)
TURNS = st.floats(0, 2 * math.pi)


def polygon(corners: int, radius: float, turn: float) -> tuple[str, FloatArray, float]:
    """A regular polygon in stroke widths: its path, points on it, and the side of the square it fits in.

    Its corners are arcs of this radius, with straight sides of nine widths between them.
    """
    half = math.pi / corners
    around = (4.5 + radius * math.tan(half)) / math.sin(half)
    angles = turn + 2 * half * np.arange(corners)
    centre = around + 2
    apexes = centre + around * np.column_stack([np.cos(angles), np.sin(angles)])
    middles = apexes * (1 - radius / math.cos(half) / around) + centre * (radius / math.cos(half) / around)
    bend = np.linspace(-half, half, 60)
    arcs = [
        middle + radius * np.column_stack([np.cos(angle + bend), np.sin(angle + bend)])
        for middle, angle in zip(middles, angles, strict=True)
    ]
    outline = np.vstack([*arcs, arcs[0][:1]])
    path = "M" + "L".join(f"{arc[0][0]} {arc[0][1]}" + _bend(arc, radius) for arc in arcs) + "Z"
    return path, outline, 2 * centre


def _bend(arc: FloatArray, radius: float) -> str:
    return f"A{radius} {radius} 0 0 1 {arc[-1][0]} {arc[-1][1]}" if radius else ""


def drawn(folder: Path, path: str, side: float, width_px: float, join: str = "round") -> Drawing:
    svg = (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{side * width_px}" height="{side * width_px}" '
        f'viewBox="0 0 {side} {side}"><path d="{path}" fill="none" stroke="black" stroke-width="1" '
        f'stroke-linejoin="{join}"/></svg>'
    )
    picture = bytes(resvg_py.svg_to_bytes(svg_string=svg, background="white"))
    Image.open(io.BytesIO(picture)).save(folder / "polygon.png")
    return trace(folder / "polygon.png", TracingConfig(), 50.0)[0]


@some
@given(st.integers(3, 5), st.floats(0.42, 3), WIDTHS, TURNS)
def test_a_rounded_corner_stays_round(tmp_path, corners, radius, width_px, turn):
    path, outline, side = polygon(corners, radius, turn)
    drawing = drawn(tmp_path, path, side, width_px)
    assert degrees(drawing) == [2]
    # The first pixel's centre is half a pixel from the picture's rim.
    places = (in_pixels(drawing, drawing.segments[0].curve.sampled(0.2)) + 0.5) / width_px
    truth = LinearRing(outline)
    assert max(truth.distance(Point(place)) for place in places) < 0.12


@some
@given(st.sampled_from(JOINS), st.floats(9, 16), TURNS)
def test_a_true_corner_stays_one_however_it_is_joined(tmp_path, kind, width_px, turn):
    corners, join = kind
    path, _, side = polygon(corners, 0.0, turn)
    assert degrees(drawn(tmp_path, path, side, width_px, join)) == [2] * corners


@pytest.mark.parametrize("radius", [0.0, 0.15, 0.45, 0.55, 0.75, 1.0, 1.5])
def test_the_graph_is_the_same_at_any_resolution(tmp_path, radius):
    path, _, side = polygon(4, radius, 0.4)
    expected = [2] * 4 if radius < 0.3 else [2]
    for picture_px in (200, 400, 1000):
        assert degrees(drawn(tmp_path, path, side, picture_px / side)) == expected
