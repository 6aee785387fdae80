"""Small gaps are closed, branches too short to bend are dropped."""

from __future__ import annotations

from tests.drawing.bitmap.figures import ACROSS, CENTRE, line
from tests.drawing.generated import degrees
from wrapit.config import TracingConfig


def test_ends_that_nearly_touch_are_joined_and_listed(traced):
    halves = [line((60, 200), (200, 200)), line((216, 200), (360, 200))]
    drawing, findings = traced(halves, 10.0)
    assert degrees(drawing) == [1, 1]
    assert [removal.what for removal in drawing.removed] == ["gap"]
    assert any(finding.code == "gap-closed" and " px, (" in finding.where for finding in findings)


def test_an_end_that_nearly_touches_a_stroke_is_joined_to_it(traced):
    drawing, findings = traced([ACROSS, line((CENTRE, CENTRE + 13), (CENTRE, 360))], 10.0)
    assert degrees(drawing) == [1, 1, 1, 3]
    assert "gap-closed" in {finding.code for finding in findings}


def test_branches_too_short_to_bend_are_dropped(traced):
    curves = [ACROSS, line((CENTRE, CENTRE), (CENTRE, CENTRE + 30))]
    assert degrees(traced(curves, 8.0)[0]) == [1, 1, 1, 3]
    dropped, _ = traced(curves, 8.0, TracingConfig(shortest_segment="6 mm"))
    assert degrees(dropped) == [1, 1]
    assert "short segment" in {removal.what for removal in dropped.removed}
