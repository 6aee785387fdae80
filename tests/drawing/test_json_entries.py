"""Drawings in JSON made to break the reader, or by mistake: read and written strictly, or refused."""

from __future__ import annotations

import json
import time
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tests.drawing.mutations import damaged
from wrapit.drawing.json_file import drawing_json, read_drawing
from wrapit.errors import DrawingError

PATIENCE_S = 15.0


def line(start: list[float], end: list[float]) -> list[Any]:
    return [start, *([a + (b - a) * k / 3 for a, b in zip(start, end, strict=True)] for k in (1, 2)), end]


def example(**changes: object) -> dict[str, Any]:
    places = [[0, 0], [30, 0], [30, 20.5]]
    return {
        "format": "wrapit-drawing/1",
        "unit": "mm",
        "junctions": places,
        "segments": [
            {"start": k, "end": k + 1, "kind": "stroke", "beziers": [line(places[k], places[k + 1])]}
            for k in (0, 1)
        ],
        "pixel_frame": {"mm_per_px": 0.1, "origin_mm": [1, 2]},
        "stroke_width_mm": 0.8,
        "removed": [{"what": "spur", "at": [1, 2], "length_mm": 0.5, "reason": "short"}],
    } | changes


VALID = json.dumps(example()).encode()


def check(folder: Path, data: bytes, size_mm: float | None = None) -> str | None:
    """The refusal, or nothing where the drawing is read and what is written of it is strict JSON."""
    path = folder / "drawing.json"
    path.write_bytes(data)
    begin = time.process_time()
    refused, text = None, "{}"
    try:
        text = drawing_json(read_drawing(path, size_mm))
    except DrawingError as error:
        refused = error
    assert time.process_time() - begin < PATIENCE_S
    text.encode("utf-8")
    json.loads(text, parse_constant=pytest.fail)
    if refused is None:
        return None
    assert refused.remedy
    assert refused.where.startswith(str(path))
    assert "()" not in str(refused)
    return str(refused)


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-32"])
def test_any_unicode_encoding_is_read(tmp_path, encoding):
    assert check(tmp_path, VALID.decode().encode(encoding)) is None


def test_a_key_twice_is_harmless(tmp_path):
    assert check(tmp_path, VALID.replace(b'{"format"', b'{"format": "other", "format"')) is None


@pytest.mark.parametrize(
    ("data", "reason"),
    [
        (b"[" * 1_000_000, "nested"),
        (b'{"a":' * 100_000, "nested"),
        (VALID.replace(b"30", b"3" * 5000), "digits"),
        (VALID.replace(b"30", b"3" * 399), "1e+06"),
        (VALID.replace(b"30", b"Infinity"), "Infinity"),
        (VALID.replace(b"20.5", b"1e999"), "1e+06"),
        (VALID.replace(b"spur", b"\\ud800"), "surrogate"),
        (VALID.replace(b'"stroke"', b'"\\ud800"'), "kind"),
        (bytes(range(128, 256)), "no text"),
        (VALID + b"x", "not valid JSON"),
    ],
    ids=lambda value: value[:20] if isinstance(value, str) else "",
)
def test_texts_that_break_readers_are_refused(tmp_path, data, reason):
    assert reason in (check(tmp_path, data) or "")


@pytest.mark.parametrize(
    ("changes", "reason"),
    [
        ({"segments": example()["segments"] * 10_001}, "20002 segments"),
        ({"junctions": [[0, 0]] * 40_001}, "40001 junctions"),
        ({"removed": [{"what": "a", "at": [0, 0], "length_mm": 1}] * 200_001}, "200001 removed"),
        (
            {"segments": [{"start": 0, "end": 1, "beziers": [line([0, 0], [30, 0])] * 200_001}]},
            "200001 Béziers",
        ),
    ],
    ids=["segments", "junctions", "removed", "Béziers"],
)
def test_too_much_is_refused_with_its_number(tmp_path, changes, reason):
    assert reason in (check(tmp_path, json.dumps(example(**changes)).encode()) or "")


@pytest.mark.parametrize("size_mm", [None, 40.0])
@pytest.mark.parametrize("length", [1e-300, 1e-5, 0.01, 3.0, 9_000.0, 1e5, 1e6, 1.01e6, 1e12, 1e300])
def test_a_line_of_any_length_is_read_or_refused(tmp_path, length, size_mm):
    drawn = example(
        junctions=[[0, 0], [length, 0]],
        segments=[{"start": 0, "end": 1, "beziers": [line([0, 0], [length, 0])]}],
    )
    refused = check(tmp_path, json.dumps(drawn).encode(), size_mm)
    fits = 1e-3 <= length <= (1e4 if size_mm is None else 1e6)
    assert (refused is None) == fits, refused


def test_a_small_drawing_far_away_is_refused_when_scaling_would_carry_it_off(tmp_path):
    drawn = example(
        junctions=[[9e5, 0], [9e5 + 1, 0]],
        segments=[{"start": 0, "end": 1, "beziers": [line([9e5, 0], [9e5 + 1, 0])]}],
    )
    assert "too far" in (check(tmp_path, json.dumps(drawn).encode(), 40.0) or "")


ODD = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(-(10**400), 10**400),
    st.floats(),
    st.text(max_size=5),
    st.sampled_from(([], {}, [1], [True, 0], ["a", "b"], [[0, 0]], {"what": 1}, 1e300, -1, 0, "\ud800")),
)
PLACES = (
    ("junctions",), ("junctions", 0), ("junctions", 0, 1), ("segments",), ("segments", 0),
    ("segments", 0, "start"), ("segments", 0, "kind"), ("segments", 0, "beziers"),
    ("segments", 0, "beziers", 0), ("segments", 0, "beziers", 0, 1), ("segments", 0, "beziers", 0, 1, 0),
    ("pixel_frame",), ("pixel_frame", "mm_per_px"), ("pixel_frame", "origin_mm"), ("stroke_width_mm",),
    ("removed",), ("removed", 0), ("removed", 0, "what"), ("removed", 0, "at"), ("removed", 0, "length_mm"),
    ("removed", 0, "reason"), ("unit",), ("format",),
)  # fmt: skip


@settings(max_examples=200, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(place=st.sampled_from(PLACES), odd=ODD, size_mm=st.sampled_from((None, 40.0)))
def test_an_odd_value_anywhere_is_read_or_refused(tmp_path, place, odd, size_mm):
    data = example()
    entry: Any = data
    for key in place[:-1]:
        entry = entry[key]
    entry[place[-1]] = odd
    check(tmp_path, json.dumps(data).encode(), size_mm)


@settings(max_examples=200, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(data=damaged(VALID))
def test_damaged_files_are_read_or_refused(tmp_path, data):
    check(tmp_path, data)
