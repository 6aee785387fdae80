"""DXF for laser cutters: R2010, millimetres, one closed entity for each contour."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from wrapit.config.plate import CurveStyle, ProfileName
from wrapit.errors import ExportError
from wrapit.exports.contour_edges import as_bulges, as_chain
from wrapit.exports.laser_profiles import ORDER, PROFILES, Look
from wrapit.exports.short_spans import without_short_lines, without_short_spans
from wrapit.geometry import Arc, BezierChain, Edge, Line
from wrapit.geometry.outlines.biarcs import as_arcs, as_lines
from wrapit.geometry.outlines.closing import SHORT_MM
from wrapit.geometry.outlines.loops import is_circle
from wrapit.jig.contours import Contour

if TYPE_CHECKING:
    from ezdxf.layouts.layout import Modelspace

# Of a SPLINE's flags (closed 1, periodic 2, rational 4, planar 8) the one that ours has.
PLANAR = 8


def write_dxf(
    path: Path,
    contours: Iterable[Contour],
    profile: ProfileName = "lightburn",
    curves: CurveStyle = "spline",
    tolerance_mm: float = 0.01,
) -> None:
    """Write the contours as a laser cutter's DXF, in the order in which they are to be worked.

    Contours with curves become one SPLINE in Bézier form (each interior knot three times), or a polyline
    with arcs or short lines within the tolerance; contours of lines and arcs one polyline (with splines:
    where none of them is too short to be cut smoothly), circles a CIRCLE.
    The profile `plain` has LINE, ARC and CIRCLE only. `$EXTMIN` and
    `$EXTMAX` are what is drawn. Colours stand on entities and on layers,
    because some programs ignore one of the two. The same contours give the same bytes.
    Raises ExportError when the file can't be written or an audit of it finds a fault.
    """
    from ezdxf import units
    from ezdxf.filemanagement import new

    if profile == "plain" and curves == "spline":
        curves = "arc"
    with _fixed_metadata():
        document = new("R2010", units=units.MM)
        document.header["$MEASUREMENT"] = 1
        looks = PROFILES[profile]
        for layer, look in looks.items():
            if look.name not in document.layers:
                document.layers.add(look.name)
            document.layers.get(look.name).color = look.aci
            document.layers.get(look.name).rgb = look.rgb
            document.layers.get(look.name).dxf.plot = int(layer != "NOTE")
        space = document.modelspace()
        for contour in in_order(contours):
            drawn = Contour(contour.layer, simplified(contour.edges, curves, tolerance_mm))
            _add(space, drawn, looks[contour.layer], exploded=profile == "plain")
        _say_extents(space)
        _check(document, path)
        for name in sorted(document.entitydb.dxf_types_in_use()):  # the library adds some in random order
            document.classes.add_class(name)
        try:
            coding = {"encoding": document.output_encoding, "errors": "dxfreplace"}
            with path.open("w", **coding, newline="\n") as stream:
                document.write(stream)
        except OSError as error:
            raise ExportError(
                f"the DXF can't be written ({error.strerror})", str(path), "check folder and disk"
            ) from error


def simplified(edges: tuple[Edge, ...], curves: CurveStyle, tolerance_mm: float) -> tuple[Edge, ...]:
    """The edges as the file spells curves."""
    if is_circle(edges):
        return edges
    if curves == "spline":
        return _without_short_edges(edges)
    return as_arcs(edges, tolerance_mm) if curves == "arc" else as_lines(edges, tolerance_mm)


def _without_short_edges(edges: tuple[Edge, ...]) -> tuple[Edge, ...]:
    """The edges; lines and arcs of which some are too short to be cut smoothly become one curve."""
    mixed = {type(edge) for edge in edges} == {Line, Arc}
    ends = [math.dist(edge.start, edge.end) for edge in edges]
    if not mixed or min(ends) >= SHORT_MM:
        return edges
    closed = Contour("NOTE", edges).closed
    return (without_short_spans(as_chain(edges, closed=closed), closed=closed),)


def in_order(contours: Iterable[Contour]) -> list[Contour]:
    """Sorted by the work of their layer, otherwise as they come."""
    return sorted(contours, key=lambda contour: ORDER.index(contour.layer))


def _add(space: Modelspace, contour: Contour, look: Look, *, exploded: bool) -> None:
    if contour.is_cut and not contour.closed:
        raise ValueError("what is cut is closed")
    attributes: dict[str, Any] = {"layer": look.name, "color": look.aci, "true_color": _true_colour(look)}
    edges, closed = contour.edges, contour.closed
    if is_circle(edges) and isinstance(circle := edges[0], Arc):
        space.add_circle(circle.centre, circle.radius_mm, attributes)
    elif any(isinstance(edge, BezierChain) for edge in edges):
        _add_spline(space, edges, attributes, closed=closed)
    elif exploded:
        _add_exploded(space, edges, attributes, closed=closed)
    else:
        lines = [edge for edge in edges if isinstance(edge, Line)]
        kept = without_short_lines(lines, closed=closed) if len(lines) == len(edges) else edges
        space.add_lwpolyline(
            as_bulges(kept, closed=closed), format="xyb", close=closed, dxfattribs=attributes
        )


def _add_exploded(
    space: Modelspace, edges: Sequence[Edge], attributes: dict[str, Any], *, closed: bool
) -> None:
    """One LINE or ARC for each edge; lines end exactly where the next edge starts."""
    from ezdxf.math import bulge_to_arc

    vertices = as_bulges(edges, closed=closed)
    ends = vertices[1:] + (vertices[:1] if closed else [])
    for (x, y, bulge), (u, v, _) in zip(vertices, ends, strict=False):
        if bulge == 0:
            space.add_line((x, y), (u, v), attributes)
            continue
        centre, start_rad, end_rad, radius = bulge_to_arc((x, y), (u, v), bulge)
        space.add_arc(centre, radius, math.degrees(start_rad), math.degrees(end_rad), True, attributes)


def _add_spline(
    space: Modelspace, edges: Sequence[Edge], attributes: dict[str, Any], *, closed: bool
) -> None:
    chain = without_short_spans(as_chain(edges, closed=closed), closed=closed)
    poles = [chain.start, *(point for cubic in chain.points for point in cubic[1:])]
    spline = space.add_spline(dxfattribs={**attributes, "degree": 3})
    spline.control_points = [(float(x), float(y), 0.0) for x, y in poles]
    inner = [float(index) for index in range(1, len(chain)) for _ in range(3)]
    spline.knots = [0.0] * 4 + inner + [float(len(chain))] * 4
    # Planar, and never "closed", though poles and knots end exactly where they start: with that flag LibreCAD
    # takes them for a periodic spline's and draws another curve (see the README's table).
    spline.dxf.flags = PLANAR


def _say_extents(space: Modelspace) -> None:
    """Programs place and zoom a drawing by the extents that it says it has."""
    from ezdxf import bbox

    extents = bbox.extents(space)
    if extents.has_data:
        space.reset_extents(extents.extmin, extents.extmax)


def _true_colour(look: Look) -> int:
    red, green, blue = look.rgb
    return red << 16 | green << 8 | blue


def _check(document: Any, path: Path) -> None:
    audit = document.audit()
    if audit.errors or audit.fixes:
        faults = "; ".join(entry.message for entry in (*audit.errors, *audit.fixes))
        raise ExportError(f"the DXF has faults: {faults}", str(path), "please report this drawing")


@contextmanager
def _fixed_metadata() -> Iterator[None]:
    """Dates and identifiers that don't change from run to run, while one file is written."""
    from ezdxf import options  # type: ignore[attr-defined]  # public, but not in __all__

    before = options.write_fixed_meta_data_for_testing
    options.write_fixed_meta_data_for_testing = True
    try:
        yield
    finally:
        options.write_fixed_meta_data_for_testing = before
