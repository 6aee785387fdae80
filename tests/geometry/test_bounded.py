"""Curves are made gentle near where they were; what is gentle already stays."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.geometry.shapes import (
    Motion,
    cubics_with_tips,
    mirrorings,
    motions,
    smooth_chains,
    tame_chains,
    tame_cubics,
)
from wrapit.geometry import Arc, BezierChain, FloatArray, joined, straight
from wrapit.geometry.bezier import derivative, evaluate, second_derivative
from wrapit.geometry.bounded import Bounded, Bounding, bounded
from wrapit.geometry.outlines.loops import as_chain
from wrapit.geometry.steering.tight import Tight, tight_places, tight_places_of
from wrapit.geometry.steering.windows import MOST, Windows

MANY = np.linspace(0, 1, 101)


@st.composite
def cornered_chains(draw: st.DrawFn) -> BezierChain:
    """Two to five cubics that meet at corners of 10° to 175° to either side, or smoothly."""
    cubics: list[FloatArray] = []
    heading = 0.0
    for cubic in draw(st.lists(tame_cubics(), min_size=2, max_size=5)):
        turn = draw(st.sampled_from([-1, 0, 1])) * math.radians(draw(st.floats(10, 175)))
        leaving = cubic[1] - cubic[0]
        rotation = Motion(heading + turn - math.atan2(leaving[1], leaving[0]), (0.0, 0.0))
        end = cubics[-1][3] if cubics else np.zeros(2)
        cubics.append(rotation.of(cubic - cubic[0]) + end)
        cubics[-1][0] = end
        arriving = cubics[-1][3] - cubics[-1][2]
        heading = math.atan2(arriving[1], arriving[0])
    return BezierChain(np.array(cubics))


@st.composite
def wiggles(draw: st.DrawFn) -> BezierChain:
    """A straight way that zigzags a little, as traced lines do."""
    count = draw(st.integers(3, 9))
    x = np.concatenate([[0.0], np.cumsum(draw(st.lists(st.floats(0.3, 3), min_size=count, max_size=count)))])
    y = draw(st.lists(st.floats(-0.4, 0.4), min_size=count + 1, max_size=count + 1))
    points = [(-6.0, 0.0), *zip(x, y, strict=True), (x[-1] + 6.0, 0.0)]
    return joined(straight(a, b) for a, b in itertools.pairwise(points))


@st.composite
def hairpins(draw: st.DrawFn) -> BezierChain:
    """There, across by less than a wire can turn in, and back."""
    wide, there, back = draw(st.floats(0.05, 1.5)), draw(st.floats(6, 15)), draw(st.floats(6, 15))
    points = [(0.0, 0.0), (there, 0.0), (there, wide), (there - back, wide + draw(st.floats(0, 3)))]
    return joined(straight(a, b) for a, b in itertools.pairwise(points))


@st.composite
def rings(draw: st.DrawFn) -> BezierChain:
    """A polygon of 3 to 8 corners about a centre, or a circle, closed exactly."""
    count, size = draw(st.integers(3, 8)), draw(st.floats(0.5, 20))
    if draw(st.booleans()):
        points = as_chain(Arc((0.0, 0.0), size / 2, 0.3, math.tau), math.pi / 4).points.copy()
        points[-1, 3] = points[0, 0]
        return BezierChain(points)
    angles = np.arange(count) / count * math.tau
    radii = size * np.array(draw(st.lists(st.floats(0.4, 1), min_size=count, max_size=count)))
    corners = np.column_stack([radii * np.cos(angles), radii * np.sin(angles)])
    return joined(straight(a, b) for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True))


chains = st.one_of(cornered_chains(), tame_chains(), wiggles(), hairpins(), smooth_chains())


def most_bent(curve: BezierChain) -> float:
    """The greatest curvature."""
    d, dd = derivative(curve.points, MANY), second_derivative(curve.points, MANY)
    speed = np.linalg.norm(d, axis=-1)
    cross = np.abs(d[..., 0] * dd[..., 1] - d[..., 1] * dd[..., 0])
    return float(np.divide(cross, speed**3, out=np.zeros_like(cross), where=speed > 1e-9).max())


def sharpest_corner(curve: BezierChain, closed: bool = False) -> float:
    """The greatest bend at a joint, in radians."""
    cubics = [BezierChain(cubic[None]) for cubic in curve.points]
    pairs = [*itertools.pairwise(cubics), *([(cubics[-1], cubics[0])] if closed else [])]
    cosines = [before.end_tangent @ after.start_tangent for before, after in pairs]
    sines = [np.cross([*a.end_tangent, 0], [*b.start_tangent, 0])[2] for a, b in pairs]
    return float(np.abs(np.arctan2(sines, cosines)).max(initial=0.0))


def apart(one: BezierChain, other: BezierChain) -> float:
    """Hausdorff's distance."""
    lines = [shapely.LineString(evaluate(curve.points, MANY).reshape(-1, 2)) for curve in (one, other)]
    return float(shapely.hausdorff_distance(*lines))


def check(curve: BezierChain, result: Bounded, radius: float, closed: bool = False) -> None:
    """What holds of every answer but its ends."""
    assert most_bent(result.curve) * radius <= 1.003
    assert sharpest_corner(result.curve, closed) < 1e-6
    assert apart(curve, result.curve) <= result.deviation + 0.02 * radius
    if shapely.LineString(curve.sampled(0.02 * radius)).is_simple:
        assert shapely.LineString(result.curve.sampled(0.02 * radius)).is_simple


@settings(max_examples=60)
@given(chains, st.floats(0.3, 2), st.sampled_from(["pinned", "placed", "free"]))
def test_no_bend_is_tighter_and_ends_stay(curve: BezierChain, radius: float, end: str) -> None:
    result = bounded(curve, radius, "pinned", end)  # type: ignore[arg-type]
    if result is None:
        return  # how often is asked below
    check(curve, result, radius)
    assert np.array_equal(result.curve.start, curve.start)
    assert np.abs(result.curve.start_tangent - curve.start_tangent).max() < 1e-9
    if end != "free":
        assert np.array_equal(result.curve.end, curve.end)
    if end == "pinned":
        assert np.abs(result.curve.end_tangent - curve.end_tangent).max() < 1e-9


@settings(max_examples=30)
@given(
    chains,
    st.floats(0.3, 2),
    st.permutations(list(itertools.product(["pinned", "placed", "free"], repeat=2))),
)
def test_one_way_after_another_is_each_by_itself(curve: BezierChain, radius: float, ways: list) -> None:
    bounding = Bounding(curve, radius)
    for way in ways[:4]:
        one, other = bounding.held(*way), bounded(curve, radius, *way)
        assert (one is None) == (other is None)
        if one is not None and other is not None:
            assert np.array_equal(one.curve.points, other.curve.points)
            assert (one.deviation, one.spans) == (other.deviation, other.spans)


@settings(max_examples=30)
@given(st.lists(st.one_of(chains, rings()), max_size=4), st.floats(0.3, 2), st.booleans())
def test_tight_places_are_the_same_one_by_one(curves: list, radius: float, closed: bool) -> None:
    assert tight_places_of(curves, radius, closed) == [tight_places(each, radius, closed) for each in curves]


@settings(max_examples=60)
@given(chains, st.floats(0.3, 2))
def test_what_is_gentle_already_stays_to_the_bit(curve: BezierChain, radius: float) -> None:
    result = bounded(curve, radius, "placed", "placed")
    if result is None:
        return
    new = {cubic.tobytes() for cubic in result.curve.points}
    reach = np.concatenate([[0.0], np.cumsum(curve.lengths)])
    for cubic, start, end in zip(curve.points, reach, reach[1:], strict=False):
        if all(end <= a or start >= b for a, b in result.spans):
            assert cubic.tobytes() in new
    again = bounded(result.curve, radius, "placed", "placed")
    assert again is not None
    assert again.curve is result.curve
    assert again.spans == ()


@settings(max_examples=40)
@given(rings(), st.floats(0.3, 2), st.sampled_from(["placed", "free"]))
def test_rings_are_smooth_all_round(curve: BezierChain, radius: float, start: str) -> None:
    result = bounded(curve, radius, start, closed=True)  # type: ignore[arg-type]
    if result is None:
        return
    check(curve, result, radius, closed=True)
    assert np.array_equal(result.curve.start, result.curve.end)
    if start == "placed":
        assert np.array_equal(result.curve.start, curve.start)


@settings(max_examples=40)
@given(chains, st.one_of(motions, mirrorings), st.floats(0.3, 2))
def test_moved_mirrored_or_turned_round_it_is_the_same(
    curve: BezierChain, motion: Motion, radius: float
) -> None:
    result = bounded(curve, radius, "pinned", "placed")
    moved = bounded(curve.mapped(motion.matrix, motion.shift), radius, "pinned", "placed")
    other_way = bounded(curve.reversed(), radius, "placed", "pinned")
    if result is None:
        assert moved is None
        assert other_way is None
        return
    assert moved is not None
    assert other_way is not None
    near = 1e-6 * curve.length
    assert apart(result.curve.mapped(motion.matrix, motion.shift), moved.curve) < near
    assert apart(result.curve, other_way.curve) < near


@settings(max_examples=40)
@given(cubics_with_tips(), st.floats(0.5, 2))
def test_a_cubic_that_turns_back_within_itself(cubic: FloatArray, radius: float) -> None:
    curve = BezierChain(cubic[None])
    result = bounded(curve, radius, "placed", "placed")
    if result is not None:
        check(curve, result, radius)
        assert result.deviation < 3 * radius


@pytest.mark.parametrize(
    ("between_deg", "most"), [(150, 0.1), (120, 0.15), (90, 0.3), (60, 0.6), (30, 0.75), (10, 1.0), (1, 1.05)]
)
@pytest.mark.parametrize("radius", [0.7, 3.0])
def test_a_corner_between_long_sides_keeps_near(between_deg: float, most: float, radius: float) -> None:
    side, angle = 12 * radius, math.radians(between_deg)
    curve = joined(
        (straight((side, 0), (0, 0)), straight((0, 0), (side * math.cos(angle), side * math.sin(angle))))
    )
    result = bounded(curve, radius)
    assert result is not None
    check(curve, result, radius)
    assert result.deviation < most * radius
    assert len(result.curve) <= 2 + 12


def test_nothing_is_found_where_nothing_is() -> None:
    """Two ends nearer to each other than a turn, which have to be left the way they are."""
    curve = joined((straight((0, 0), (0.5, 0)), straight((0.5, 0), (0.5, 0.1))))
    assert bounded(curve, 10.0) is None


def test_hardly_any_chain_is_given_up() -> None:
    random = np.random.default_rng(17)
    found = 0
    for _ in range(60):
        heading, points = 0.0, [np.zeros(2)]
        for _ in range(int(random.integers(2, 6))):
            points.append(
                points[-1] + random.uniform(4, 12) * np.array([math.cos(heading), math.sin(heading)])
            )
            heading += math.radians(random.uniform(-150, 150))
        found += (
            bounded(joined(straight(a, b) for a, b in itertools.pairwise(points)), 1.0, "placed", "placed")
            is not None
        )
    assert found >= 57


def test_a_closed_curve_has_no_gap() -> None:
    with pytest.raises(ValueError, match="ends where it starts"):
        bounded(straight((0, 0), (5, 0)), 1.0, closed=True)


def zigzag(count: int, pitch: float, rise: float) -> BezierChain:
    """A way of so many corners, up and down by turns."""
    x = np.arange(count + 2) * pitch
    y = np.arange(count + 2) % 2 * rise
    return joined(straight(a, b) for a, b in itertools.pairwise(zip(x.tolist(), y.tolist(), strict=True)))


@pytest.mark.parametrize("count", [30, 90])
@pytest.mark.parametrize(("pitch", "rise"), [(1.6, 0.8), (1.2, 0.3), (2.0, 1.2)])
def test_a_long_way_of_tight_places_is_followed_in_parts(count: int, pitch: float, rise: float) -> None:
    curve = zigzag(count, pitch, rise)
    result = bounded(curve, 1.0, "placed", "placed")
    assert result is not None
    check(curve, result, 1.0)
    assert max(end - start for start, end in result.spans) <= MOST
    assert result.deviation < rise


def test_a_window_over_the_start_of_a_ring_may_be_cut_beyond_it() -> None:
    length, at = 60.0, [*np.arange(2.0, 24), *np.arange(52.0, 60)]
    tight = [Tight(place, place, 0.5) for place in map(float, at)]
    windows = Windows(np.array([0.0, length]), 1.0, closed=True, held=False).around(tight, np.ones(30))
    assert len(windows) == 2
    assert [window.start < length < window.end for window in windows] == [False, True]
    assert 0 < windows[0].start == windows[1].end - length


@settings(max_examples=40)
@given(st.lists(st.tuples(st.floats(0.4, 4), st.floats(0.1, 3)), min_size=2, max_size=80), st.booleans())
def test_windows_are_short_and_hold_each_tight_place_once(
    places: list[tuple[float, float]], closed: bool
) -> None:
    starts = np.cumsum([gap for gap, _ in places])
    tight = [Tight(float(at), float(at), turn) for at, (_, turn) in zip(starts, places, strict=True)]
    length = float(starts[-1]) + 8.0  # so much stays gentle: a ring that is tight all round isn't cut
    division = Windows(np.array([0.0, length]), 1.0, closed, False)
    windows = division.around(tight, np.ones(len(tight)))
    assert sorted(n for window in windows for n in window.spans) == list(range(len(tight)))
    assert max(window.length for window in windows) <= MOST
    for before, after in itertools.pairwise(windows):
        assert before.end <= after.start
    assert all(0 <= window.start < length for window in windows)
    for window in windows:
        for n in window.spans:
            assert any(
                window.start <= tight[n].start + lap and tight[n].end + lap <= window.end
                for lap in (0.0, length)
            )
    # A cut that doesn't do is left out, and only that one.
    cuts = frozenset().union(*(window.cuts for window in windows))
    if cuts:
        pair = min(cuts, key=sorted)
        again = division.around(tight, np.ones(len(tight)), {pair})
        assert any(pair <= set(window.spans) for window in again)
