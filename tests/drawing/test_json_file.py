"""drawing.json: written exactly, read as it is, and refused with a place where it is wrong."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from wrapit.config import TracingConfig
from wrapit.drawing.json_file import drawing_json, read_drawing
from wrapit.drawing.model import Drawing, Junction, PixelFrame, Removal, Segment
from wrapit.drawing.stage import trace
from wrapit.errors import DrawingError
from wrapit.geometry import BezierChain, from_chain, straight


def wave() -> BezierChain:
    """Two Béziers with one tangent at a joint that no millionth can hold."""
    joint = np.array([10 + 1 / 3, 2 / 7])
    slope = np.array([np.pi, np.e])
    first = [[0, 0], [3, 4], joint - slope, joint]
    second = [joint, joint + 0.7 * slope, [20, 9], [30, 1 / 3]]
    return BezierChain(np.array([first, second]))


def example() -> Drawing:
    curve = wave()
    junctions = (Junction(0, curve.start), Junction(1, curve.end), Junction(2, np.array([0.1, 20.0])))
    segments = (
        Segment(0, 0, 1, curve),
        Segment(1, 1, 2, straight(junctions[1].point, junctions[2].point), "bridge"),
    )
    return Drawing(
        junctions,
        segments,
        0.6,
        PixelFrame(0.0625, (-1.5, 30.25)),
        (Removal("spur", (1.0, 2.0), 0.4, "short"),),
    )


def written(folder: Path, change: dict[str, Any] | None = None) -> Path:
    data = json.loads(drawing_json(example()))
    data.update(change or {})
    path = folder / "drawing.json"
    path.write_text(json.dumps(data))
    return path


def test_the_format_is_the_contract_s():
    data = json.loads(drawing_json(example()))
    assert data["format"] == "wrapit-drawing/1"
    assert data["unit"] == "mm"
    assert data["segments"][0].keys() == {"start", "end", "kind", "beziers"}
    assert data["segments"][0]["beziers"][0][3] == data["segments"][0]["beziers"][1][0]
    assert data["segments"][0]["beziers"][-1][3] == data["junctions"][1]
    assert data["segments"][1]["kind"] == "bridge"
    assert data["pixel_frame"] == {"mm_per_px": 0.0625, "origin_mm": [-1.5, 30.25]}
    assert data["removed"][0]["what"] == "spur"
    assert data["stroke_width_mm"] == 0.6


def test_reading_gives_the_same_drawing(tmp_path):
    drawing = read_drawing(written(tmp_path))
    for mine, theirs in zip(drawing.segments, example().segments, strict=True):
        assert (mine.start, mine.end, mine.kind) == (theirs.start, theirs.end, theirs.kind)
        assert np.abs(mine.curve.points - theirs.curve.points).max() < 2e-6
    assert drawing.pixel_frame == example().pixel_frame
    assert drawing.removed == example().removed
    assert drawing_json(drawing) == drawing_json(read_drawing(written(tmp_path)))


def test_rounding_leaves_joints_smooth(tmp_path):
    drawing = read_drawing(written(tmp_path))
    assert len(from_chain(drawing.segments[0].curve).poles) == 6


def test_size_scales_everything(tmp_path):
    drawing, _ = trace(written(tmp_path), TracingConfig(), 15.0)
    low, high = drawing.bounds_mm
    assert max(high - low) == pytest.approx(15, abs=0.01)
    frame = drawing.pixel_frame
    assert frame is not None
    assert frame.mm_per_px == pytest.approx(0.0625 * 15 / 30, rel=1e-3)


def test_a_joint_a_hair_off_is_put_on_its_junction(tmp_path):
    segments = json.loads(drawing_json(example()))["segments"]
    segments[0]["beziers"][0][0] = [0.0004, 0.0]
    drawing = read_drawing(written(tmp_path, {"segments": segments}))
    assert np.array_equal(drawing.segments[0].curve.start, drawing.junctions[0].point)


@pytest.mark.parametrize(
    ("change", "place"),
    [
        ({"format": "other/1"}, "no wrapit drawing"),
        ({"unit": "inch"}, "unit"),
        ({"junctions": [[0, 0], [1]]}, r"junctions\[1\]"),
        ({"junctions": "none"}, "junctions"),
        ({"segments": []}, "no segments"),
        ({"segments": [{"start": 0, "end": 9, "beziers": []}]}, r"segments\[0\].*'end'"),
        ({"segments": [{"start": 0, "end": 1, "beziers": [[[0, 0], [1, 1]]]}]}, "beziers"),
        ({"segments": [{"start": 0, "end": 1, "beziers": [[[0, 0], [1, 1], [2, 2], [5, 5]]]}]}, "away"),
        ({"segments": [{"start": 0, "end": 1, "kind": "x", "beziers": []}]}, "kind"),
        ({"pixel_frame": {"mm_per_px": -1, "origin_mm": [0, 0]}}, "pixel_frame"),
        ({"stroke_width_mm": "thin"}, "stroke_width_mm"),
    ],
)
def test_mistakes_are_named(change, place, tmp_path):
    with pytest.raises(DrawingError, match=place) as caught:
        read_drawing(written(tmp_path, change))
    assert caught.value.remedy


@pytest.mark.parametrize("text", ["", "{", '{"format": NaN}', "[]", '{"format": "wrapit-drawing/1"}'])
def test_broken_files_are_refused(text, tmp_path):
    (tmp_path / "drawing.json").write_text(text)
    with pytest.raises(DrawingError, match=r"drawing\.json"):
        read_drawing(tmp_path / "drawing.json")


def test_not_a_number_is_no_coordinate(tmp_path):
    path = written(tmp_path)
    path.write_text(path.read_text().replace("0.1", "NaN", 1))
    with pytest.raises(DrawingError, match="NaN"):
        read_drawing(path)
