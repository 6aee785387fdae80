"""Where walls stand on both sides of a wire."""

from __future__ import annotations

import pytest
import shapely

from tests.jig.metal import line, wires_of
from wrapit.config import JigConfig
from wrapit.jig.channel import Channels
from wrapit.jig.wrapping.hemmed import BESIDE_MM, CROSSING_MM, hemmed_findings, hemmed_share


def channels() -> Channels:
    return Channels.of(wires_of([line((0, 0), (50, 0))], diameter_mm=1.0), JigConfig())


def walls(gap_mm: float, *spans: tuple[float, float]) -> list[shapely.Polygon]:
    """Walls over these spans of the wire, each on both of its sides."""
    low, high = 0.5 + gap_mm, 4.0
    return [shapely.box(a, s * low, b, s * high).normalize() for a, b in spans for s in (1, -1)]


def test_between_two_walls_a_wire_is_hemmed_in() -> None:
    both = walls(0.2, (10, 20))
    assert hemmed_share(channels(), both) == pytest.approx(0.2, abs=0.01)
    assert hemmed_share(channels(), both[:1]) == 0.0
    assert hemmed_share(channels(), walls(BESIDE_MM + 0.01, (10, 20))) == 0.0
    assert hemmed_share(channels(), []) == 0.0


def test_the_longest_place_is_named_and_the_others_counted() -> None:
    (told,) = hemmed_findings(channels(), walls(0.2, (5, 10), (20, 32), (40, 40 + CROSSING_MM - 0.5)))
    assert told.where == "wire-01 at 26 mm"
    assert "over 12 mm, and at 1 more places" in told.message


def test_a_crossing_is_not_told() -> None:
    assert hemmed_findings(channels(), walls(0.2, (5, 5 + CROSSING_MM - 0.5), (20, 23))) == ()
    assert hemmed_findings(channels(), walls(0.2, (5, 25))[:1]) == ()
