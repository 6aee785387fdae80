"""`drawing.json`: the traced graph as a file that people and other programs may edit."""

from __future__ import annotations

import itertools
import json
import math
from pathlib import Path
from typing import Any

import numpy as np

from wrapit.drawing.model import Drawing, Junction, PixelFrame, Removal, Segment
from wrapit.errors import DrawingError
from wrapit.geometry import BezierChain, FloatArray, unit

FORMAT = "wrapit-drawing/1"

_DECIMALS = 6
# A joint that rounding moved off its tangent by no more than this (mm) is put back.
_ROUNDING_MM = 3e-6
_NEAR_MM = 1e-3


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
    junctions = [
        _point(entry, f"{path}: junctions[{index}]")
        for index, entry in enumerate(_list(data, "junctions", path))
    ]
    segments = []
    for index, entry in enumerate(_list(data, "segments", path)):
        segments.append(_segment(entry, index, junctions, f"{path}: segments[{index}]"))
    if not segments:
        raise DrawingError("the drawing has no segments", str(path), "draw at least one line")
    scale = 1.0
    if size_mm is not None:
        points = np.concatenate([segment.curve.sampled(0.05) for segment in segments])
        scale = size_mm / max(float(np.ptp(points, axis=0).max()), 1e-9)
    return _scaled(data, junctions, segments, scale, path)


def _scaled(
    data: dict[str, Any], junctions: list[FloatArray], segments: list[Segment], scale: float, path: Path
) -> Drawing:
    frame, width = data.get("pixel_frame"), data.get("stroke_width_mm")
    removed = data.get("removed", [])
    try:
        return Drawing(
            tuple(Junction(index, point * scale) for index, point in enumerate(junctions)),
            tuple(
                Segment(s.id, s.start, s.end, BezierChain(s.curve.points * scale), s.kind) for s in segments
            ),
            None if width is None else _positive(width) * scale,
            None
            if frame is None
            else PixelFrame(
                _positive(frame["mm_per_px"]) * scale,
                (float(frame["origin_mm"][0]) * scale, float(frame["origin_mm"][1]) * scale),
            ),
            tuple(
                Removal(
                    str(item["what"]),
                    (float(item["at"][0]) * scale, float(item["at"][1]) * scale),
                    float(item["length_mm"]) * scale,
                    str(item.get("reason", "")),
                )
                for item in removed
            ),
        )
    except (KeyError, TypeError, ValueError, IndexError) as error:
        raise DrawingError(
            f"pixel_frame, stroke_width_mm or removed is not as expected ({error})",
            str(path),
            "correct it, or leave it out",
        ) from None


def _load(path: Path) -> dict[str, Any]:
    def refuse(word: str) -> float:
        raise ValueError(f"{word} is no coordinate")

    try:
        data = json.loads(path.read_text(encoding="utf-8-sig"), parse_constant=refuse)
    except FileNotFoundError:
        raise DrawingError("no such drawing", str(path), "check `drawing:` in the config") from None
    except json.JSONDecodeError as error:
        raise DrawingError(
            f"not valid JSON: {error.msg.lower()}",
            f"{path}:{error.lineno}:{error.colno}",
            "correct it there; the file may be cut off",
        ) from None
    except (OSError, UnicodeDecodeError, ValueError, RecursionError) as error:
        raise DrawingError(
            f"the drawing can't be read ({error})", str(path), "give a JSON text file"
        ) from None
    if not isinstance(data, dict) or data.get("format") != FORMAT:
        raise DrawingError("the file is no wrapit drawing", str(path), f'it starts with "format": "{FORMAT}"')
    if data.get("unit", "mm") != "mm":
        raise DrawingError(f"unknown unit {data['unit']!r}", f"{path}: unit", 'drawings are in "mm"')
    return data


def _list(data: dict[str, Any], key: str, path: Path) -> list[Any]:
    value = data.get(key)
    if not isinstance(value, list):
        raise DrawingError(f"{key!r} is missing or no list", str(path), f"add a list of {key}")
    return value


def _point(entry: object, where: str) -> FloatArray:
    if (
        not isinstance(entry, list)
        or len(entry) != 2
        or not all(isinstance(x, int | float) and not isinstance(x, bool) and math.isfinite(x) for x in entry)
    ):
        raise DrawingError("expected a place [x, y] in mm", where, "write two finite numbers")
    return np.array(entry, dtype=np.float64)


def _positive(value: object) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or not 0 < value < math.inf:
        raise ValueError(f"{value!r} is not a positive number")
    return float(value)


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
        raise DrawingError(f"unknown kind {kind!r}", where, "write 'stroke' or 'bridge'")
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
            inner = ",\n  ".join(json.dumps(item, ensure_ascii=False) for item in value)
            lines.append(f' "{key}": [\n  {inner}\n ]')
        else:
            lines.append(f' "{key}": {json.dumps(value, ensure_ascii=False)}')
    return "{\n" + ",\n".join(lines) + "\n}\n"
