"""The outline of a plate that follows the piece: no narrow bays, no holes, one part, smooth all round."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from wrapit.geometry import BezierChain, FloatArray, Loop
from wrapit.geometry.polyline import lengths

# Half the width of the narrowest bay that stays: narrower ones have sides and no use. The plates of the seven
# configs have 55 to 73 % of their boxes' area so.
BAY_MM = 6.0
# A plate that is asked to have less margin gets this: two lines of a nozzle of 0.4 mm and some to spare, so
# that walls never end on its edge.
LEAST_MARGIN_MM = 1.0
# Over which length are arcs of different radii blended, as the deviation of a bell curve? Arcs alone have 80
# side faces and more; blended over 1 mm the butterfly's plate has 10, over 0.6 mm 12. Less where the margin
# is small, as the blend pulls round corners in by deviation² / (2 radius).
BLEND_MM = 1.0
BLEND_SHARE = 0.25
# Points for each deviation where the blend is reckoned, on arcs that have 32 chords a right angle: these lie
# within 0.003 mm of arcs of 10 mm.
SAMPLES_A_BLEND = 10
QUARTER_SEGMENTS = 32


def fitted_outline(covered: Any, margin_mm: float, corner_radius_mm: float) -> Loop:
    """A smooth outline, counter-clockwise, at the margin or more around everything covered (shapely).

    No corner is tighter than the corner radius, no bay narrower than twice BAY_MM; parts that lie apart are
    joined.
    """
    margin = max(margin_mm, corner_radius_mm, LEAST_MARGIN_MM)
    blend = min(BLEND_MM, BLEND_SHARE * margin)
    grown = covered.buffer(margin + blend**2 / (2 * margin), quad_segs=QUARTER_SEGMENTS)
    return _blended(_joined(grown, max(BAY_MM, corner_radius_mm), margin / 2), blend)


def _joined(grown: Any, bay_mm: float, neck_mm: float) -> FloatArray:
    """The ring (n, 2) around it all, closed until it is one part without a neck under twice `neck_mm`."""
    import shapely

    whole = _closed(grown, bay_mm)
    while shapely.get_num_geometries(whole.buffer(-neck_mm)) > 1 or whole.geom_type != "Polygon":
        bay_mm *= 2
        if bay_mm > math.dist(whole.bounds[:2], whole.bounds[2:]):
            whole = whole.convex_hull
        else:
            whole = _closed(grown, bay_mm)
    return shapely.get_coordinates(shapely.geometry.polygon.orient(whole).exterior)


def _closed(grown: Any, by_mm: float) -> Any:
    return grown.buffer(by_mm, quad_segs=QUARTER_SEGMENTS).buffer(-by_mm, quad_segs=QUARTER_SEGMENTS)


def _blended(ring: FloatArray, blend_mm: float) -> Loop:
    """The closed ring (n, 2), its curvature blended, as one smooth cubic a length of the blend."""
    from scipy.interpolate import CubicSpline
    from scipy.ndimage import gaussian_filter1d

    reach = lengths(ring)
    count = math.ceil(reach[-1] / blend_mm)
    even = np.arange(count * SAMPLES_A_BLEND) * (reach[-1] / (count * SAMPLES_A_BLEND))
    points = np.column_stack([np.interp(even, reach, axis) for axis in ring.T])
    smooth = gaussian_filter1d(points, blend_mm / even[1], axis=0, mode="wrap")[::SAMPLES_A_BLEND]
    knots = np.concatenate([smooth, smooth[:1]])
    at = lengths(knots)
    slopes = CubicSpline(at, knots, bc_type="periodic")(at, 1)
    thirds = np.diff(at)[:, None] / 3
    a, b = knots[:-1], knots[1:]
    return Loop((BezierChain(np.stack([a, a + slopes[:-1] * thirds, b - slopes[1:] * thirds, b], axis=1)),))
