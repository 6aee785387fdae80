"""SVG drawings: the centre lines of their strokes, exactly, without a raster detour."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from wrapit.config import TracingConfig
from wrapit.drawing.assembly import assemble, placement
from wrapit.drawing.changes import Change
from wrapit.drawing.components import LONGEST_LINK, connect
from wrapit.drawing.json_file import LARGEST_SIZE_MM
from wrapit.drawing.model import Drawing
from wrapit.drawing.spots import Spot, spots_of_outlines
from wrapit.drawing.svg.cutting import cut_at_tips
from wrapit.drawing.svg.duplicates import without_coincident
from wrapit.drawing.svg.hand_doubles import without_hand_doubles
from wrapit.drawing.svg.planar import Curve, planar
from wrapit.drawing.svg.programs import SKETCHED
from wrapit.drawing.svg.remarks import of_fills
from wrapit.drawing.svg.seen.losses import dots_of
from wrapit.drawing.svg.seen.told import told
from wrapit.drawing.svg.strokes import Strokes, read_strokes
from wrapit.errors import DrawingError, Finding
from wrapit.geometry import FloatArray

# Ends within this many stroke widths of another stroke's centre touch its ink and belong to it: half a width
# of that ink and half a width of their own cap; the ink of an end .996 away has no gap to be seen. At 1.24,
# strokes of the tests that cross at an acute angle go wrong.
_REACH = 1.0
# Without any stroke width: this share of the drawing's size.
_REACH_SHARE = 2e-3
# However broad the strokes are, no end farther away than this share of the size is meant.
_MOST = 0.04
# Smaller drawings are mistakes of their unit: no piece of jewellery is a tenth of a mm large.
_SMALLEST_SIZE_MM = 0.1
# In sizes of the drawing: farther away, its coordinates lose what matters; broader, no line is seen.
_FARTHEST = 1e7
_BROADEST = 100.0
# Finer strokes (in sizes of the drawing) are hairlines: they have no width that a file could hold.
_FINEST = 1e-5


def trace_svg(
    path: Path, tracing: TracingConfig, size_mm: float | None
) -> tuple[Drawing, tuple[Finding, ...]]:
    """The drawing in an SVG file, in its own size unless `size_mm` is given.

    Raises DrawingError where the file can't be read, refers to others, or has no stroked lines.
    """
    strokes = read_strokes(path, tracing)
    points = np.concatenate([curve.cubics.reshape(-1, 2) for curve in strokes.curves])
    size = float(np.ptp(points, axis=0).max())
    if size <= 0:
        raise DrawingError("the lines have no length", str(path), "draw at least one line")
    _refuse_absurd(points, size, strokes, size_mm, path)
    reach = _REACH * strokes.width_px if strokes.width_px else _REACH_SHARE * size
    reach = min(reach, _MOST * size)
    sketched = strokes.page.program in SKETCHED
    by_hand = without_hand_doubles(strokes.curves, strokes.owners, reach / _REACH, size, sketched)
    cut = [
        Curve(cubics, closed)
        for curve in by_hand.curves
        for cubics, closed in cut_at_tips(curve.cubics, curve.closed, reach)
    ]
    curves, doubles = without_coincident(cut, reach / _REACH)
    # Where lines wobble, their ends miss each other by as much.
    graph = planar(curves, max(reach, by_hand.apart), tracing.corner_angle, str(path))
    if not graph.pieces:
        raise DrawingError("the drawing has no lines", str(path), "draw at least one line")
    changes = [Change("stub", _pair(at), length, "ends just behind a joint") for at, length in graph.stubs]
    changes += [Change("double", _pair(at), length, "drawn twice, taken once") for at, length in doubles]
    connected = connect(graph.places, graph.pieces, tracing.components, LONGEST_LINK * size)
    where = placement(
        [piece.curve for piece in connected.pieces], size_mm, flip=True, scale=strokes.mm_per_px
    )
    drawing = assemble(
        connected.places,
        connected.pieces,
        where,
        width=strokes.width_px if (strokes.width_px or 0) >= _FINEST * size else None,
        changes=[*changes, *connected.changes],
        pixel_frame=False,
        spots=[*connected.spots, *_left_out(strokes, tracing)],
    )
    findings = list(strokes.findings)
    for notice in connected.notices:
        x, y = where.points(np.array(notice.at_px))
        place = f"at ({notice.at_px[0]:.1f}, {notice.at_px[1]:.1f}) px, ({x:.1f}, {y:.1f}) mm"
        findings.append(Finding(notice.level, notice.code, place, notice.message, notice.remedy))
    if by_hand.pairs:
        findings.append(_by_hand(by_hand.pairs, where.scale))
    if doubles:
        length = where.scale * sum(length for _, length in doubles)
        findings.append(
            Finding(
                "note",
                "drawn-twice",
                "drawing",
                f"{len(doubles)} stretches ({length:.1f} mm) are drawn twice, as where two shapes share an "
                "edge; each is taken once",
            )
        )
    findings += told(strokes.losses, where.scale, strokes.page.program)
    findings += of_fills(strokes.filled, strokes.solid, tracing.filled, strokes.page.program)
    return drawing, tuple(findings)


def _left_out(strokes: Strokes, tracing: TracingConfig) -> list[Spot]:
    """Dots, and round shapes that are filled and not outlined."""
    filled = strokes.filled if tracing.filled != "outline" else []
    outlines = [shape.curves[0].cubics for shape in filled if len(shape.curves) == 1]
    return [*dots_of(strokes.losses), *spots_of_outlines(outlines)]


def _by_hand(pairs: list[tuple[FloatArray, float]], mm_per_px: float) -> Finding:
    longest, _ = max(pairs, key=lambda pair: pair[1])
    whole = mm_per_px * sum(length for _, length in pairs)
    lines = "1 line is" if len(pairs) == 1 else f"{len(pairs)} lines are"
    return Finding(
        "note",
        "drawn-twice-by-hand",
        f"at ({longest[0]:.1f}, {longest[1]:.1f}) px",
        f"{lines} drawn as two wobbly strokes ({whole:.1f} mm), as by hand; the mean of both is taken",
        "if both strokes are meant, move them farther apart than they are wide",
    )


def _refuse_absurd(
    points: FloatArray, size: float, strokes: Strokes, size_mm: float | None, path: Path
) -> None:
    """Refuses sizes that only a mistake of the unit or a slip of the pen gives."""
    drawn_mm = size * strokes.mm_per_px
    if size_mm is None and not _SMALLEST_SIZE_MM <= drawn_mm <= LARGEST_SIZE_MM:
        raise DrawingError(
            f"the drawing is {drawn_mm:.3g} mm large, which is no size for jewellery",
            str(path),
            "add `size: 40 mm` to the config",
        )
    if float(np.abs(points).max()) > _FARTHEST * size:
        raise DrawingError(
            f"the lines are {size:.2g} px large and lie {np.abs(points).max():.2g} px away from (0, 0)",
            str(path),
            "move them into the page",
        )
    if strokes.width_px is not None and strokes.width_px > _BROADEST * size:
        raise DrawingError(
            f"the strokes are {strokes.width_px:.2g} px wide, and the drawing is only {size:.2g} px large",
            str(path),
            "correct their stroke-width",
        )


def _pair(point: FloatArray) -> tuple[float, float]:
    return float(point[0]), float(point[1])
