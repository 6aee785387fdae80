"""Drawings in several pieces: left out by name, or joined."""

from __future__ import annotations

import numpy as np
import scipy.spatial
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.sparse.csgraph import minimum_spanning_tree
from shapely import LineString, union_all

from tests.drawing.bitmap.figures import line
from tests.drawing.generated import degrees
from wrapit.config import Config, TracingConfig
from wrapit.drawing.assembly import Piece
from wrapit.drawing.components import connect
from wrapit.geometry import FloatArray, straight
from wrapit.geometry.disjoint_sets import Sets


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


def scattered(count: int, seed: int) -> tuple[dict[int, FloatArray], list[Piece]]:
    """Short strokes anywhere in a field of 1000 by 1000, and their places."""
    rng = np.random.default_rng(seed)
    places, pieces = {}, []
    for k in range(count):
        start = rng.uniform(0, 1000, 2)
        places[2 * k], places[2 * k + 1] = start, start + rng.normal(0, 15, 2)
        pieces.append(Piece(2 * k, 2 * k + 1, straight(places[2 * k], places[2 * k + 1])))
    return places, pieces


@settings(max_examples=20, deadline=None)
@given(st.integers(2, 25), st.integers(0, 2**32 - 1))
def test_links_make_one_drawing_and_are_no_longer_than_the_shortest_tree(count, seed):
    places, pieces = scattered(count, seed)
    strokes = [LineString([piece.curve.start, piece.curve.end]) for piece in pieces]
    apart = np.array([[one.distance(other) for other in strokes] for one in strokes])
    shortest = float(minimum_spanning_tree(apart).sum())
    joined = connect(places, pieces, "join", 2000.0)
    together = Sets()
    for piece in joined.pieces:
        together.merge(piece.start, piece.end)
    assert len({together.find(piece.start) for piece in joined.pieces}) == 1
    assert [change.what for change in joined.changes] == ["link"] * (count - 1)
    # Links may start from others, and a stroke is looked at in 33 places.
    spacing = max(stroke.length for stroke in strokes) / 32
    assert sum(change.length_px for change in joined.changes) <= shortest + count * spacing


def test_each_link_takes_one_tree_however_many_pieces_wait(monkeypatch):
    built = []
    tree = scipy.spatial.cKDTree
    monkeypatch.setattr(scipy.spatial, "cKDTree", lambda points: built.append(len(points)) or tree(points))
    connect(*scattered(60, 1), "join", 2000.0)
    assert len(built) == 59


@settings(max_examples=20, deadline=None)
@given(st.integers(0, 2**32 - 1), st.floats(20, 300))
def test_what_is_nearer_than_the_longest_link_is_joined_and_nothing_else(seed, longest):
    places, pieces = scattered(20, seed)
    joined = connect(places, pieces, "join", longest)
    links = [change for change in joined.changes if change.what == "link"]
    left = [change for change in joined.changes if change.what == "piece"]
    assert all(link.length_px <= longest for link in links)
    assert len(links) + len(left) == 19
    drawn = union_all([LineString([piece.curve.start, piece.curve.end]) for piece in joined.pieces])
    for change in left:
        (stroke,) = (
            LineString([piece.curve.start, piece.curve.end])
            for piece in pieces
            if np.allclose((piece.curve.start + piece.curve.end) / 2, change.at_px)
        )
        # Strokes are looked at in 33 places each.
        assert drawn.distance(stroke) > longest - max(piece.curve.length for piece in joined.pieces) / 32


def ring(middle: tuple[float, float], side: float, first: int) -> tuple[dict[int, FloatArray], list[Piece]]:
    """A square of four strokes about a place, numbered from `first`."""
    corners = np.array(middle) + side / 2 * np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)])
    places = {first + k: corner for k, corner in enumerate(corners)}
    ends = [(first + k, first + (k + 1) % 4) for k in range(4)]
    return places, [Piece(a, b, straight(places[a], places[b])) for a, b in ends]


@given(st.floats(-60, 60), st.floats(-60, 60), st.floats(1, 60))
def test_what_is_weighed_lies_within_the_largest_and_is_worth_its_link(x: float, y: float, side: float):
    (places, pieces), (more, others) = ring((0, 0), 100, 0), ring((x, y), side, 4)
    result = connect({**places, **more}, [*pieces, *others], "weigh", 100.0)
    reach = max(abs(x), abs(y)) + side / 2
    joined = len(result.pieces) > 4
    if abs(reach - 50) > 1e-6 and abs(4 * side - 2 * (50 - reach)) > 2:
        assert joined == (reach < 50 and 4 * side >= 2 * (50 - reach))
    assert [change.what for change in result.changes] == ["link" if joined else "piece"]


def test_pieces_are_weighed_where_a_drawing_is_made_fit() -> None:
    def how(**settings: object) -> str:
        return Config.model_validate({"drawing": "owl.png", **settings}).reading.components

    assert how() == how(fit="off") == how(fit="bold", beads="auto") == "largest"
    assert how(fit="gentle") == how(fit="bold") == "weigh"
    assert how(fit="bold", tracing={"components": "join"}) == "join"
