"""`drawing.json`: the traced graph as a file that people and other programs may edit."""

from __future__ import annotations

import itertools
import json
from pathlib import Path
from typing import Any

import numpy as np

from wrapit.drawing.json_entries import (
    LARGEST_MM,
    block,
    is_number,
    load_json,
    number,
    pair,
    positive,
    shown,
    words,
)
from wrapit.drawing.model import Drawing, Junction, PixelFrame, Removal, Segment
from wrapit.errors import DrawingError
from wrapit.geometry import BezierChain, FloatArray, unit

# Goes up when a reader of the old format would misread the new one.
FORMAT = "wrapit-drawing/1"

# How exactly are coordinates written? To a millionth of a mm, far below what a wire bends by.
_DECIMALS = 6
# A joint that rounding moved off its tangent by no more than this (mm) is put back: three
# rounded places, each off by half a millionth in x and y, stay below half of it.
_ROUNDING_MM = 3e-6
# An end that a careful hand put within this of its junction is meant to be there; a gap beyond it is a
# mistake.
_NEAR_MM = 1e-3
# Larger and smaller drawings are mistakes of their unit.
LARGEST_SIZE_MM = 10_000.0
_SMALLEST_SIZE_MM = 1e-3
# How much is still a drawing? As many segments as an SVG file may have parts, ten Béziers each: they bound
# time and memory, the largest of the configs has 56 segments.
_MOST_SEGMENTS = 20_000
_MOST_BEZIERS = 200_000
# How finely is a drawing measured before it is scaled? As finely as `Drawing.bounds_mm` does, unless it is so
# long that the places would fill the memory (two million are 32 MB).
_SAMPLED_MM = 0.05
_MOST_SAMPLES = 2_000_000


def drawing_json(drawing: Drawing) -> str:
    """The drawing as JSON text; coordinates in mm, rounded to a millionth, shared ones identical."""
    data: dict[str, Any] = {
        "format": FORMAT,
        "unit": "mm",
        "junctions": [_rounded(junction.point) for junction in drawing.junctions],
        "segments": [
            {
                "start": segment.start,
                "end": segment.end,
                "kind": segment.kind,
                "beziers": _rounded(segment.curve.points),
            }
            for segment in drawing.segments
        ],
    }
    if drawing.pixel_frame is not None:
        data["pixel_frame"] = {
            "mm_per_px": drawing.pixel_frame.mm_per_px,
            "origin_mm": _rounded(np.array(drawing.pixel_frame.origin_mm)),
        }
    if drawing.stroke_width_mm is not None:
        data["stroke_width_mm"] = round(drawing.stroke_width_mm, _DECIMALS)
    data["removed"] = [
        {
            "what": removal.what,
            "at": _rounded(np.array(removal.at)),
            "length_mm": round(removal.length_mm, _DECIMALS),
            "reason": removal.reason,
        }
        for removal in drawing.removed
    ]
    return _text(data)


def read_drawing(path: Path, size_mm: float | None = None) -> Drawing:
    """The drawing in a JSON file, as it is: same numbers, no clean-up; scaled only where a size is given.

    Raises DrawingError, naming the entry, for anything that is no such drawing.
    """
    data = _load(path)
    places, entries = _list(data, "junctions", path), _list(data, "segments", path)
    _refuse_many(data, entries, path)
    junctions = [_point(entry, f"{path}: junctions[{index}]") for index, entry in enumerate(places)]
    segments = [
        _segment(entry, index, junctions, f"{path}: segments[{index}]") for index, entry in enumerate(entries)
    ]
    if not segments:
        raise DrawingError("the drawing has no segments", str(path), "draw at least one line")
    return _scaled(data, junctions, segments, _scale(segments, size_mm, path), path)


def _refuse_many(data: dict[str, Any], entries: list[Any], path: Path) -> None:
    """Counts before anything is made of the entries, which takes a thousand times as long."""
    beziers = [entry.get("beziers") for entry in entries if isinstance(entry, dict)]
    removed = data.get("removed")
    for what, count, most in (
        ("segments", len(entries), _MOST_SEGMENTS),
        ("junctions", len(data["junctions"]), 2 * _MOST_SEGMENTS),
        ("Béziers", sum(len(chain) for chain in beziers if isinstance(chain, list)), _MOST_BEZIERS),
        ("removed entries", len(removed) if isinstance(removed, list) else 0, _MOST_BEZIERS),
    ):
        if count > most:
            raise DrawingError(
                f"the drawing has {count} {what}, more than the limit of {most}", str(path), "simplify it"
            )


def _scale(segments: list[Segment], size_mm: float | None, path: Path) -> float:
    """What to multiply the drawing by; refuses where the result would be no size for jewellery."""
    controls = np.concatenate([segment.curve.points.reshape(-1, 2) for segment in segments])
    extent, scale = float(np.ptp(controls, axis=0).max()), 1.0
    if extent < _SMALLEST_SIZE_MM:
        raise DrawingError(f"the drawing is only {extent:.2g} mm large", str(path), "draw it larger")
    if size_mm is not None:
        # Long drawings are sampled more coarsely: a place every 0.05 mm would fill the memory.
        length = sum(float(np.abs(np.diff(s.curve.points, axis=1)).sum()) for s in segments)
        step = max(_SAMPLED_MM, length / _MOST_SAMPLES)
        points = np.concatenate([segment.curve.sampled(step) for segment in segments])
        scale = size_mm / max(float(np.ptp(points, axis=0).max()), _SMALLEST_SIZE_MM)
    elif extent > LARGEST_SIZE_MM:
        raise DrawingError(
            f"the drawing is {extent:.3g} mm large, which is no size for jewellery",
            str(path),
            "add `size: 40 mm` to the config",
        )
    if float(np.abs(controls).max()) * scale > LARGEST_MM:
        raise DrawingError(
            f"the drawing lies too far from (0, 0) for its size of {extent:.2g} mm",
            str(path),
            "move it there",
        )
    return scale


def _scaled(
    data: dict[str, Any], junctions: list[FloatArray], segments: list[Segment], scale: float, path: Path
) -> Drawing:
    try:
        frame, width = data.get("pixel_frame"), data.get("stroke_width_mm")
        return Drawing(
            tuple(Junction(index, point * scale) for index, point in enumerate(junctions)),
            tuple(
                Segment(s.id, s.start, s.end, BezierChain(s.curve.points * scale), s.kind) for s in segments
            ),
            None if width is None else positive(width) * scale,
            None if frame is None else _frame(block(frame), scale),
            tuple(_removal(block(item), scale) for item in _removed(data)),
        )
    except (KeyError, ValueError) as error:
        reason = f"{error} is missing" if isinstance(error, KeyError) else str(error)
        raise DrawingError(
            f"pixel_frame, stroke_width_mm or removed is not as expected ({reason})",
            str(path),
            "correct it, or leave it out",
        ) from None


def _frame(entry: dict[str, Any], scale: float) -> PixelFrame:
    x, y = pair(entry["origin_mm"])
    return PixelFrame(positive(entry["mm_per_px"]) * scale, (x * scale, y * scale))


def _removed(data: dict[str, Any]) -> list[Any]:
    removed = data.get("removed", [])
    if not isinstance(removed, list):
        raise ValueError(f"{shown(removed)} is no list of what was removed")
    return removed


def _removal(entry: dict[str, Any], scale: float) -> Removal:
    x, y = pair(entry["at"])
    return Removal(
        words(entry["what"]),
        (x * scale, y * scale),
        number(entry["length_mm"]) * scale,
        words(entry.get("reason", "")),
    )


def _load(path: Path) -> dict[str, Any]:
    data = load_json(path)
    if not isinstance(data, dict) or data.get("format") != FORMAT:
        raise DrawingError("the file is no wrapit drawing", str(path), f'it starts with "format": "{FORMAT}"')
    if data.get("unit", "mm") != "mm":
        raise DrawingError(f"unknown unit {shown(data['unit'])}", f"{path}: unit", 'drawings are in "mm"')
    return data


def _list(data: dict[str, Any], key: str, path: Path) -> list[Any]:
    value = data.get(key)
    if not isinstance(value, list):
        raise DrawingError(f"{key!r} is missing or no list", str(path), f"add a list of {key}")
    return value


def _point(entry: object, where: str) -> FloatArray:
    if not isinstance(entry, list) or len(entry) != 2 or not all(map(is_number, entry)):
        raise DrawingError(
            "expected a place [x, y] in mm", where, f"write two numbers of at most {LARGEST_MM:g}"
        )
    return np.array(entry, dtype=np.float64)


def _segment(entry: object, index: int, junctions: list[FloatArray], where: str) -> Segment:
    if not isinstance(entry, dict):
        raise DrawingError("a segment is a block", where, "see drawing.json of any build")
    ends = []
    for key in ("start", "end"):
        value = entry.get(key)
        if isinstance(value, bool) or not isinstance(value, int) or not 0 <= value < len(junctions):
            raise DrawingError(
                f"{key!r} names no junction", where, f"write a number from 0 to {len(junctions) - 1}"
            )
        ends.append(value)
    kind = entry.get("kind", "stroke")
    if kind not in ("stroke", "bridge"):
        raise DrawingError(f"unknown kind {shown(kind)}", where, "write 'stroke' or 'bridge'")
    beziers = entry.get("beziers")
    if (
        not isinstance(beziers, list)
        or not beziers
        or not all(isinstance(b, list) and len(b) == 4 for b in beziers)
    ):
        raise DrawingError("'beziers' is no list of cubic Béziers", where, "give four places for each")
    points = np.array(
        [[_point(p, f"{where}.beziers[{k}]") for p in cubic] for k, cubic in enumerate(beziers)]
    )
    points = _rejoined(points, junctions[ends[0]], junctions[ends[1]], where)
    return Segment(index, ends[0], ends[1], BezierChain(points), kind)


def _rejoined(points: FloatArray, start: FloatArray, end: FloatArray, where: str) -> FloatArray:
    """Ends exactly on the junctions and on each other, joints exactly on their tangent again.

    What rounding (or a careful hand) moved is put back; a true gap is an error.
    """
    gaps = np.linalg.norm(
        np.vstack([start[None], points[:, 3]]) - np.vstack([points[:, 0], end[None]]), axis=1
    )
    if gaps.max() > _NEAR_MM:
        raise DrawingError(
            f"the curve is {gaps.max():.3g} mm away from a junction or from its own next part",
            where,
            "let each Bézier start where the one before ends",
        )
    points[0, 0], points[-1, 3] = start, end
    for before, after in itertools.pairwise(points):
        _straighten(before, after)
        after[0] = before[3]
    if float(np.abs(np.diff(points.reshape(-1, 2), axis=0)).max()) == 0:
        raise DrawingError("the segment has no length", where, "delete it")
    return points


def _straighten(before: FloatArray, after: FloatArray) -> None:
    """Puts a joint and its two handles back on one line, each moved as little as possible."""
    reach = after[1] - before[2]
    length = float(np.linalg.norm(reach))
    along = unit(reach)
    normal = np.array([-along[1], along[0]])
    off = before[3] - before[2]
    share, error = float(off @ along) / max(length, 1e-12), float(off @ normal)
    if 0 < share < 1 and abs(error) <= _ROUNDING_MM:
        step = error / (1 + (1 - share) ** 2 + share**2) * normal
        before[3] -= step
        before[2] += (1 - share) * step
        after[1] += share * step


def _rounded(values: FloatArray) -> Any:
    return (np.round(values, _DECIMALS) + 0.0).tolist()


def _text(data: dict[str, Any]) -> str:
    """One line per junction, segment and removal, so that versions of a drawing compare well."""
    lines = []
    for key, value in data.items():
        if isinstance(value, list) and value:
            inner = ",\n  ".join(json.dumps(item, ensure_ascii=False, allow_nan=False) for item in value)
            lines.append(f' "{key}": [\n  {inner}\n ]')
        else:
            lines.append(f' "{key}": {json.dumps(value, ensure_ascii=False, allow_nan=False)}')
    return "{\n" + ",\n".join(lines) + "\n}\n"
