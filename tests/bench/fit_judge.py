"""How fit a drawing is for wire, and what it cost, seen by other means than those of `wrapit.fit`.

It reads nothing but drawings: places and bends of their Béziers by scipy, faces and crossings by shapely.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray
from scipy.interpolate import BPoly
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from wrapit.drawing.model import Drawing, Segment

Floats = NDArray[np.float64]

# How finely lines become chains of points: an arc of 1 mm radius lies 3e-4 mm off its chords.
STEP_MM = 0.05
# Places inside each Bézier where its bend is looked at: with twice as many no drawing of the corpus has more.
PLACES = 64
# A bend is tight where it is this much tighter than allowed, as the wires' own check has it.
TIGHT = 1.01
# A joint, or a stretch that is too tight, that bends by less in all (rad) is what fitting leaves, and what a
# handle of no length gives, whose curvature has no bound: a wire of 1 mm radius rounds it within 3e-4 mm.
CORNER_RAD = 0.05
# How exactly the largest circle in a face is found.
CIRCLE_MM = 0.01
# Between two lines of one course chords enclose slivers of up to 1e-3 mm: no faces, but crossings.
SLIVER_MM = 2e-3
# Lines that meet may share chords this near to the junction where they do.
MEETING_MM = 0.05
# A place lies on the border of the drawing's area within rounding.
ON_MM = 1e-3


@dataclass(frozen=True)
class Fitness:
    """What is left in a drawing that wire can't follow.

    `spans` are stretches inside segments that bend too tightly, `corners` such joints: within segments and
    where two segments meet alone. `faces_d` are the diameters of the largest circles in the bounded faces,
    in wire diameters, the least first.
    """

    segments: int
    spans: int
    corners: int
    faces_d: tuple[float, ...]
    lengths_mm: tuple[float, ...]
    stubs_mm: tuple[float, ...]
    pieces: int
    crossings: int

    @property
    def tight(self) -> int:
        """All bends that the metal doesn't take."""
        return self.spans + self.corners

    def narrow(self, diameters: float) -> int:
        """How many faces have less room than so many wire diameters."""
        return sum(face < diameters for face in self.faces_d)

    def short(self, length_mm: float) -> int:
        """How many segments are shorter."""
        return sum(each < length_mm for each in self.lengths_mm)

    def short_stubs(self, length_mm: float) -> int:
        """How many segments that end freely are shorter."""
        return sum(each < length_mm for each in self.stubs_mm)


@dataclass(frozen=True)
class Price:
    """What was given up.

    `outline_kept` is the share of the original's outer outline that has a line within half a wire diameter;
    `left_out` the share of its length that has none within a whole one. `moved_mm` and `furthest_mm` are the
    mean and largest distance, both ways, of lines that are kept.
    """

    outline_kept: float
    left_out: float
    moved_mm: float
    furthest_mm: float


def fitness(drawing: Drawing, diameter_mm: float, radius_mm: float) -> Fitness:
    """How fit a drawing is for wire of a diameter that bends to a radius, no tighter."""
    lines = [_line(segment) for segment in drawing.segments]
    ends = np.bincount(
        [junction for segment in drawing.segments for junction in (segment.start, segment.end)],
        minlength=len(drawing.junctions),
    )
    lengths = [float(line.length) for line in lines]
    rooms = [_room_mm(face) for face in _faces(lines)]
    free = [bool((ends[[s.start, s.end]] == 1).any()) for s in drawing.segments]
    return Fitness(
        segments=len(drawing.segments),
        spans=sum(_tight_spans(segment, radius_mm) for segment in drawing.segments),
        corners=sum(angle > CORNER_RAD for angle in joint_angles(drawing)),
        faces_d=tuple(sorted(room / diameter_mm for room in rooms if room > SLIVER_MM)),
        lengths_mm=tuple(sorted(lengths)),
        stubs_mm=tuple(sorted(mm for mm, ends_freely in zip(lengths, free, strict=True) if ends_freely)),
        pieces=_pieces(drawing),
        crossings=sum(1 for _ in _crossings(drawing, lines)),
    )


def price(original: Drawing, fitted: Drawing, diameter_mm: float) -> Price:
    """What a fitted drawing gave up of the original, both in one frame."""
    before, after = _places(original), _places(fitted)
    far_mm = cKDTree(after).query(before)[0]
    outer = _is_outer(before, [_line(segment) for segment in original.segments])
    kept_mm, back_mm = far_mm[far_mm <= diameter_mm], cKDTree(before).query(after)[0]
    both = [kept_mm, back_mm] if len(kept_mm) else [back_mm]
    return Price(
        outline_kept=float((far_mm[outer] <= diameter_mm / 2).mean()),
        left_out=float((far_mm > diameter_mm).mean()),
        moved_mm=float(np.mean([each.mean() for each in both])),
        furthest_mm=float(max(each.max() for each in both)),
    )


def joint_angles(drawing: Drawing) -> Iterator[float]:
    """Bends (rad) at joints within segments, and at junctions where two ends meet and no more."""
    leaving: dict[int, list[Floats]] = {}
    for segment in drawing.segments:
        cubics = segment.curve.points
        for before, after in itertools.pairwise(cubics):
            yield _bend(-_heading(before[::-1]), _heading(after))
        leaving.setdefault(segment.start, []).append(_heading(cubics[0]))
        leaving.setdefault(segment.end, []).append(_heading(cubics[-1][::-1]))
    for arms in leaving.values():
        if len(arms) == 2:
            yield _bend(-arms[0], arms[1])


def _bend(arriving: Floats, leaving: Floats) -> float:
    cross = arriving[0] * leaving[1] - arriving[1] * leaving[0]
    return float(abs(np.arctan2(cross, arriving @ leaving)))


def _heading(cubic: Floats) -> Floats:
    """Where a cubic sets out to: its first control point that is another place."""
    away = cubic[1:] - cubic[0]
    reach = np.hypot(*away.T)
    first = int(np.argmax(reach > 1e-9))
    return np.asarray(away[first] / max(float(reach[first]), 1e-9))


def _curve(segment: Segment) -> BPoly:
    """The segment by a parameter that runs over 0 … n, one for each cubic."""
    points = segment.curve.points
    return BPoly(points.transpose(1, 0, 2), np.arange(len(points) + 1.0))


def _tight_spans(segment: Segment, radius_mm: float) -> int:
    """Stretches of a segment whose curvature is too large, for more than a hardly visible bend."""
    curve, count = _curve(segment), len(segment.curve.points)
    inside = (np.arange(PLACES * count) + 0.5) / PLACES
    velocity, force = curve.derivative()(inside), curve.derivative(2)(inside)
    speed = np.maximum(np.hypot(*velocity.T), 1e-9)
    curvature = (velocity[:, 0] * force[:, 1] - velocity[:, 1] * force[:, 0]) / speed**3
    tight = np.abs(curvature) > TIGHT / radius_mm
    turned_rad = np.r_[0.0, np.cumsum(curvature * speed / PLACES)]
    runs = np.flatnonzero(np.diff(np.r_[0, tight.astype(np.int8), 0])).reshape(-1, 2)
    return int((np.abs(np.diff(turned_rad[runs], axis=1)) > CORNER_RAD).sum())


def _line(segment: Segment) -> shapely.LineString:
    """A segment as chords, which end exactly on its junctions."""
    counts = np.maximum(np.ceil(segment.curve.lengths / STEP_MM).astype(int), 1)
    at = np.concatenate([n + np.arange(count) / count for n, count in enumerate(counts)])
    return shapely.LineString(np.concatenate([_curve(segment)(at), segment.curve.points[-1, 3:]]))


def _places(drawing: Drawing) -> Floats:
    """Places evenly along all lines, (n, 2)."""
    found = []
    for line in map(_line, drawing.segments):
        count = max(int(np.ceil(line.length / STEP_MM)), 1)
        at = (np.arange(count) + 0.5) / count
        found.append(shapely.get_coordinates(shapely.line_interpolate_point(line, at, normalized=True)))
    return np.concatenate(found)


def _faces(lines: list[shapely.LineString]) -> list[shapely.Polygon]:
    """What lines enclose; where lines cross unasked too."""
    return list(shapely.polygonize([shapely.unary_union(lines)]).geoms)


def _room_mm(face: shapely.Polygon) -> float:
    return 2 * float(shapely.maximum_inscribed_circle(face, tolerance=CIRCLE_MM).length)


def _is_outer(places: Floats, lines: list[shapely.LineString]) -> NDArray[np.bool_]:
    """Which places border on the unbounded region: those on the rim of all faces, and those outside of it."""
    area, points = shapely.unary_union(_faces(lines)), shapely.points(places)
    shapely.prepare(area)
    inside = shapely.contains_properly(area, points)
    return np.asarray(~inside | shapely.dwithin(points, shapely.boundary(area), ON_MM))


def _pieces(drawing: Drawing) -> int:
    starts = [segment.start for segment in drawing.segments]
    ends = [segment.end for segment in drawing.segments]
    count = len(drawing.junctions)
    joined = coo_array((np.ones(len(starts)), (starts, ends)), shape=(count, count))
    used = np.unique([*starts, *ends])
    return len(np.unique(connected_components(joined, directed=False)[1][used]))


def _crossings(drawing: Drawing, lines: list[shapely.LineString]) -> Iterator[tuple[int, int]]:
    """Pairs of segments that have a place in common away from junctions of both; a pair of one is a knot."""
    for number, line in enumerate(lines):
        if not line.is_simple:
            yield number, number
    first, second = shapely.STRtree(lines).query(lines, predicate="intersects")
    for one, other in zip(first.tolist(), second.tolist(), strict=True):
        if one >= other:
            continue
        a, b = drawing.segments[one], drawing.segments[other]
        meeting = [drawing.junctions[j].point for j in {a.start, a.end} & {b.start, b.end}]
        common = lines[one].intersection(lines[other])
        if meeting:
            common = common.difference(shapely.MultiPoint(meeting).buffer(MEETING_MM))
        if not common.is_empty:
            yield one, other
