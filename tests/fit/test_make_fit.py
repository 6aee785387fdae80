"""What each drawing that was made fit is: asked of random ones, by a judge of its own."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
import shapely
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st
from scipy.spatial import cKDTree

from tests.bench.fit_judge import Fitness, fitness
from tests.fit.drawn import KINDS, apart_mm, config, drawn, looks_the_same, mapped, moved, places_of
from wrapit.drawing.model import Drawing
from wrapit.errors import ConfigError, Finding
from wrapit.fit.limits import limits_of
from wrapit.fit.measuring import fewest_wires
from wrapit.fit.model import Fitted, Limits
from wrapit.fit.sketch import Sketch
from wrapit.fit.stage import make_fit

FLIP = np.diag([-1.0, 1.0])
TURN = np.array([[0.0, 1.0], [-1.0, 0.0]])
# Blobs of a hundred segments take seconds each: the bench has their like.
QUICK = tuple(kind for kind in KINDS if kind != "blobs")
MODEST = settings(
    max_examples=12, deadline=None, derandomize=True, suppress_health_check=[HealthCheck.too_slow]
)
# Two lines may cross within this of the node where they meet, as chords do: no face that anyone sees.
NO_FACE_MM = 0.004

kinds, seeds = st.sampled_from(QUICK), st.integers(20, 60)
sizes, gauges = st.sampled_from([25.0, 35.0, 50.0, 80.0]), st.sampled_from([22, 20, 18, 16])
levels = st.sampled_from(["gentle", "bold"])


@cache
def fitted(
    kind: str, seed: int, size_mm: float, gauge: int, level: str
) -> tuple[Fitted, tuple[Finding, ...]]:
    return make_fit(drawn(kind, seed, size_mm), config(level, gauge))


def judged(drawing: Drawing, limits: Limits) -> Fitness:
    return fitness(drawing, limits.diameter_mm, limits.radius_mm)


def faults(drawing: Drawing, limits: Limits) -> list[str]:
    """What is left that this wire can't follow; as exactly as circles in faces are found."""
    seen = judged(drawing, limits)
    least_d = (limits.room_mm - 0.03) / limits.diameter_mm
    narrow = [d for d in seen.faces_d if NO_FACE_MM / limits.diameter_mm < d < least_d]
    return [
        *(["tight"] * seen.tight),
        *("narrow" for _ in narrow),
        *(["short"] * seen.short(limits.shortest_mm - 1e-6)),
    ]


def test_nearly_all_drawings_of_a_fixed_list_are_made_fit_and_the_others_say_where_not() -> None:
    left = 0
    for number in range(60):
        kind, size_mm = QUICK[number % len(QUICK)], (25.0, 35.0, 50.0, 80.0)[number % 4]
        gauge, level = (22, 20, 18, 16)[number // 4 % 4], ("gentle", "bold")[number // 2 % 2]
        result, findings = fitted(kind, number, size_mm, gauge, level)
        found = faults(result.drawing, limits_of(config(level, gauge), level))
        assert findings or not found, (kind, number, found)
        assert all(finding.code == "unfit" for finding in findings)
        left += bool(findings)
    assert left <= 3


@MODEST
@given(kinds, seeds, sizes, gauges, levels)
def test_what_comes_out_is_planar_in_one_piece_and_within_bounds(kind, seed, size_mm, gauge, level):
    result, findings = fitted(kind, seed, size_mm, gauge, level)
    limits = limits_of(config(level, gauge), level)
    before, after = judged(drawn(kind, seed, size_mm), limits), judged(result.drawing, limits)
    assert after.crossings <= before.crossings
    assert after.pieces == before.pieces == 1
    assert findings or not faults(result.drawing, limits)
    assert result.after.segments == len(result.drawing.segments)
    assert result.after.wires == fewest_wires(Sketch.of(result.drawing))
    known = {segment.id for segment in result.original.segments}
    assert all(origin and set(origin) <= known for origin in result.origins)


@MODEST
@given(kinds, seeds, sizes, gauges, levels)
def test_a_drawing_that_is_fit_comes_back_itself(kind, seed, size_mm, gauge, level):
    result, _ = fitted(kind, seed, size_mm, gauge, level)
    again, _ = make_fit(result.drawing, config(level, gauge))
    assert again.drawing is result.drawing
    assert again.origins == tuple((segment.id,) for segment in again.original.segments)


@MODEST
@given(kinds, seeds, sizes, gauges, levels)
def test_every_place_that_is_no_longer_there_is_told(kind, seed, size_mm, gauge, level):
    """Places farther than half a wire from all that is left lie near a place that is told.

    Near is within what is told to have changed; what met a place that moved by up to two rooms follows it
    over six times as much.
    """
    result, _ = fitted(kind, seed, size_mm, gauge, level)
    limits = limits_of(config(level, gauge), level)
    before = places_of(result.original, 0.1)
    far = before[cKDTree(places_of(result.drawing, 0.1)).query(before)[0] > limits.diameter_mm / 2]
    told = result.drawing.removed[len(result.original.removed) :]
    assert len(far) == 0 or told
    reach = np.array([removal.length_mm / 2 + 12 * limits.room_mm for removal in told])
    at = np.array([removal.at for removal in told]).reshape(-1, 2)
    for place in far:
        assert (np.hypot(*(at - place).T) <= reach).any(), place


@settings(MODEST, max_examples=8)
@given(kinds, seeds, sizes, gauges, levels, st.sampled_from([FLIP, TURN]))
def test_what_is_mirrored_or_turned_comes_out_so_to_the_last_bit(kind, seed, size_mm, gauge, level, matrix):
    """However its parts are numbered, and which way its lines run; what has a symmetry, within a micron."""
    result, _ = fitted(kind, seed, size_mm, gauge, level)
    image, _ = make_fit(mapped(result.original, matrix), config(level, gauge))
    wanted = mapped(result.drawing, matrix)
    if curves(image.drawing) != curves(wanted):
        assert looks_the_same(result.original)
        assert apart_mm(image.drawing, wanted) < 1e-3


def curves(drawing: Drawing) -> list[list[float]]:
    """Those of all segments, however they are numbered and whichever way they run."""
    every = [segment.curve.points for segment in drawing.segments]
    return sorted(min(each.ravel().tolist(), each[::-1, ::-1].ravel().tolist()) for each in every)


def test_a_ring_whose_window_over_the_start_is_cut_beyond_it_comes_back() -> None:
    """It can't be widened, and that is told; there is no curve to be taken beyond its end."""
    _, findings = make_fit(drawn("finger", 100, 25.0, twin=True), config("gentle", 16))
    assert {finding.code for finding in findings} == {"unfit"}


def test_mirrored_halves_come_out_as_mirrored_halves_but_for_what_faces_itself() -> None:
    """All but three of a fixed list: where twins run along one another, one is led into the other."""
    alike, asked = 0, 0
    for number, kind in enumerate(("net", "comb", "tips", "scribble", "tree") * 3):
        size_mm, gauge, level = ((25.0, 22, "gentle"), (50.0, 18, "bold"), (80.0, 20, "bold"))[number % 3]
        drawing = drawn(kind, 20 + number // 5, size_mm, twin=True)
        low, high = drawing.bounds_mm
        centred = moved(drawing, -(low + high) / 2)
        if apart_mm(centred, mapped(centred, FLIP)) > 0.02:
            continue  # the tracer read one half otherwise
        result, _ = make_fit(centred, config(level, gauge))
        asked += 1
        alike += apart_mm(result.drawing, mapped(result.drawing, FLIP)) < 0.05
    assert asked >= 14
    assert alike >= asked - 3


@MODEST
@given(kinds, seeds, sizes, gauges, levels, st.randoms(use_true_random=False))
def test_what_is_kept_stays_and_what_is_dropped_goes(kind, seed, size_mm, gauge, level, random):
    drawing = drawn(kind, seed, size_mm)
    numbers = [segment.id for segment in drawing.segments]
    assume(len(numbers) > 3)
    keep, drop = sorted(random.sample(numbers, 2)), []
    drop = [random.choice([n for n in numbers if n not in keep])]
    result, _ = make_fit(drawing, config(level, gauge, keep=keep, drop=drop))
    origins = {n for origin in result.origins for n in origin}
    assert set(keep) <= origins
    assert not set(drop) & origins
    limits = limits_of(config(level, gauge), level)
    told = [r for r in result.drawing.removed if r.what in ("faired", "merged")]
    near = shapely.union_all(
        [shapely.Point(r.at).buffer(r.length_mm / 2 + 12 * limits.room_mm) for r in told] or [shapely.Point()]
    )
    for n in keep:
        places = drawing.segments[n].curve.sampled(0.1)
        far = places[cKDTree(places_of(result.drawing, 0.1)).query(places)[0] > limits.diameter_mm / 2]
        assert shapely.contains_xy(near, far).all()


@pytest.mark.parametrize(
    ("wishes", "where"),
    [
        ({"keep": [99999]}, "keep.0"),
        ({"drop": [0, 99999]}, "drop.1"),
        ({"keep": [0], "drop": [0]}, "drop"),
    ],
)
@pytest.mark.parametrize("level", ["off", "gentle", "bold"])
def test_wishes_that_cannot_be_are_refused(wishes, where, level):
    with pytest.raises(ConfigError) as refused:
        make_fit(drawn("net", 3, 50.0), config(level, 18, **wishes))
    assert refused.value.where == where
    assert refused.value.remedy


def test_all_cannot_be_dropped():
    drawing = drawn("comb", 3, 50.0)
    with pytest.raises(ConfigError, match="nothing would be left"):
        make_fit(drawing, config("bold", 18, drop=[segment.id for segment in drawing.segments]))


@settings(MODEST, max_examples=6)
@given(kinds, seeds, sizes, gauges, levels)
def test_the_same_drawing_comes_out_the_same_to_the_last_bit(kind, seed, size_mm, gauge, level):
    one, _ = fitted(kind, seed, size_mm, gauge, level)
    other, _ = make_fit(drawn(kind, seed, size_mm), config(level, gauge))
    assert one.origins == other.origins
    assert one.drawing.removed == other.drawing.removed
    for mine, theirs in zip(one.drawing.segments, other.drawing.segments, strict=True):
        assert mine.curve.points.tobytes() == theirs.curve.points.tobytes()
