"""Drawings in several pieces: left out by name, or joined."""

from __future__ import annotations

from tests.drawing.bitmap.figures import (
    line,
)
from tests.drawing.generated import degrees
from wrapit.config import TracingConfig


def test_a_wide_gap_stays_open_and_the_smaller_piece_is_named(traced):
    drawing, findings = traced([line((60, 200), (200, 200)), line((260, 200), (360, 200))], 10.0)
    assert degrees(drawing) == [1, 1]
    (finding,) = (finding for finding in findings if finding.code == "left-out")
    assert "at (310, 200) px" in finding.where
    assert [removal.what for removal in drawing.removed] == ["piece"]


def test_near_pieces_are_joined_on_request(traced):
    pieces = [line((60, 200), (200, 200)), line((240, 120), (240, 280))]
    drawing, findings = traced(pieces, 10.0, TracingConfig(components="join"))
    # The link is a segment of its own: the end that it starts from has two.
    assert degrees(drawing) == [1, 1, 1, 2, 3]
    assert "joined" in {finding.code for finding in findings}
    assert any(removal.what == "link" for removal in drawing.removed)
