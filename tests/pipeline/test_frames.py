"""Where files lie: jig and wires in the piece's frame, prints at the origin, several jigs side by side."""

from __future__ import annotations

import itertools
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.conftest import CONFIGS
from wrapit.config import load_config
from wrapit.kernel.measures import box_mm
from wrapit.pipeline.build import Build
from wrapit.pipeline.solids import at_origin, side_by_side

Piece = Callable[[str], Build]
Box = tuple[np.ndarray, np.ndarray]

number = st.floats(-300, 300)
boxes = st.lists(
    st.tuples(st.tuples(number, number), st.tuples(st.floats(1, 200), st.floats(1, 200))),
    min_size=1,
    max_size=6,
)


def shapes_in(path: Path) -> list[Any]:
    """The solids of a STEP file."""
    from OCP.STEPControl import STEPControl_Reader
    from OCP.TopAbs import TopAbs_SOLID
    from OCP.TopExp import TopExp
    from OCP.TopTools import TopTools_IndexedMapOfShape

    reader = STEPControl_Reader()
    reader.ReadFile(str(path))
    reader.TransferRoots()
    found = TopTools_IndexedMapOfShape()
    TopExp.MapShapes_s(reader.OneShape(), TopAbs_SOLID, found)
    return [found.FindKey(index) for index in range(1, found.Extent() + 1)]


def stl_box(path: Path) -> Box:
    facets = np.frombuffer(
        path.read_bytes()[84:], dtype=[("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")]
    )
    corners = facets["corners"].reshape(-1, 3).astype(float)
    return corners.min(axis=0), corners.max(axis=0)


@given(boxes)
def test_boxes_in_a_row_dont_touch(rows: list[tuple[tuple[float, float], tuple[float, float]]]) -> None:
    made = [(np.array([x, y, 0.0]), np.array([x + width, y + depth, 8.0])) for (x, y), (width, depth) in rows]
    places = side_by_side(made)
    assert places[0] == (0.0, 0.0, 0.0)
    moved = [(low[0] + by[0], high[0] + by[0]) for (low, high), by in zip(made, places, strict=True)]
    for (_, end), (start, _) in itertools.pairwise(moved):
        # A move of up to 5e-7 mm counts as rounding of 0 (it is rounded to 1e-6 before it is rounded up).
        assert 10.0 - 1e-9 <= start - end < 10.001


@given(number, number)
def test_a_print_never_lies_below_zero(x: float, y: float) -> None:
    moved = np.array([x, y, 0.0]) + at_origin(np.array([x, y, 0.0]))
    assert (moved >= -1e-6).all()
    assert (moved < 2e-4).all()


@pytest.mark.parametrize("name", ["butterfly", "mandala"])
def test_the_report_says_where_each_file_lies(piece: Piece, name: str) -> None:
    build = piece(name)
    assert build.folder is not None
    frames = build.report["jig"]["frames"]
    solid_files = {path.name for path in build.folder.iterdir() if path.suffix in (".step", ".stl", ".3mf")}
    assert set(frames) == solid_files - {"wires.step"}
    by_jig = frames["jig.step"] if isinstance(frames["jig.step"], dict) else {"jig": frames["jig.step"]}
    in_one = [box_mm(solid) for solid in shapes_in(build.folder / "jig.step")]
    assert len(in_one) == len(by_jig) == build.report["jig"]["solids"]
    for (_, high), (low, _) in itertools.pairwise(sorted(in_one, key=lambda box: float(box[0][0]))):
        assert low[0] > high[0] + 9.9, "jigs stand apart"
    for jig, by in by_jig.items():
        at_home = (box - np.array(by) for box in min(in_one, key=lambda box: float(box[0][0] - by[0])))
        low, high = at_home if len(by_jig) == 1 else box_mm(*shapes_in(build.folder / f"{jig}.step"))
        assert any(np.abs(box[0] - low - by).max() < 1e-3 for box in in_one)
        print_low, print_high = stl_box(build.folder / f"{jig}.stl")
        assert (print_low >= 0).all()
        assert np.abs(print_low - np.array(frames[f"{jig}.stl"]) - low).max() < 0.02
        assert np.abs(print_high - np.array(frames[f"{jig}.stl"]) - high).max() < 0.02


@pytest.mark.parametrize("name", ["butterfly", "mandala"])
def test_wires_lie_on_the_plate_in_the_drawings_frame(piece: Piece, name: str) -> None:
    build = piece(name)
    assert build.folder is not None
    drawing = json.loads((build.folder / "drawing.json").read_text())
    points = np.concatenate([np.reshape(segment["beziers"], (-1, 2)) for segment in drawing["segments"]])
    wires = [box_mm(solid) for solid in shapes_in(build.folder / "wires.step")]
    assert len(wires) == len(build.report["wires"])
    low, high = np.min([box[0] for box in wires], axis=0), np.max([box[1] for box in wires], axis=0)
    upper_mm = load_config(CONFIGS / f"{name}.yaml").jig.base_thickness
    assert low[2] == pytest.approx(upper_mm, abs=2e-3), "the lowest wire touches the plate's upper face"
    assert (low[:2] > points.min(axis=0) - 3).all()
    assert (high[:2] < points.max(axis=0) + 3).all()
