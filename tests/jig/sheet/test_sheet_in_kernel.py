"""The DXF read back, put together in the kernel, holds the wires where the plan says."""

from __future__ import annotations

import math
from pathlib import Path

import ezdxf
import numpy as np
import pytest
from ezdxf.math import bulge_to_arc

from tests.jig.sheet.laser import PIECES, laser_of
from wrapit.config import JigConfig, PlateConfig
from wrapit.exports.flat_files import write_flat_files
from wrapit.exports.short_spans import MERGED_MM, SHORT_MM
from wrapit.geometry import Arc, BezierChain, FloatArray, Line, Loop, Region
from wrapit.geometry.bspline import BSpline, chain_of
from wrapit.geometry.outlines.loops import moved
from wrapit.geometry.outlines.polygons import loop_area_mm2, polygon_of
from wrapit.jig.sheet.drawings import sheet_drawings, sheet_name


def outer_cuts(path: Path) -> list[Loop]:
    """Exact outer contours of a DXF, from the entities alone."""
    loops = []
    for entity in ezdxf.readfile(path).modelspace().query("*[layer=='CUT_OUTER']"):
        if entity.dxftype() == "SPLINE":
            poles = np.array([tuple(point)[:2] for point in entity.control_points])
            loops.append(Loop((chain_of(BSpline(3, poles, np.array(entity.knots))),)))
        elif entity.dxftype() == "LWPOLYLINE":
            corners = entity.get_points("xyb")
            pairs = zip(corners, [*corners[1:], corners[0]], strict=True)
            loops.append(Loop(tuple(side(a[:2], b[:2], a[2]) for a, b in pairs)))
    return loops


def side(start: tuple[float, float], end: tuple[float, float], bulge: float) -> Line | Arc:
    """A side of a polyline: straight, or an arc of four times the bulge's arc tangent."""
    if not bulge:
        return Line(start, end)
    centre, _, _, radius = bulge_to_arc(start, end, bulge)
    start_rad = math.atan2(start[1] - centre.y, start[0] - centre.x)
    return Arc((centre.x, centre.y), radius, start_rad, 4 * math.atan(bulge))


def gap_mm(loop: Loop, wire: BezierChain) -> float:
    """Distance between an outline and a wire's centreline, by the kernel."""
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeEdge
    from OCP.BRepExtrema import BRepExtrema_DistShapeShape

    from wrapit.geometry import from_chain
    from wrapit.kernel.edges import region_face, spline_curve

    face = region_face(Region(loop))
    line = BRepBuilderAPI_MakeEdge(spline_curve(from_chain(wire))).Edge()
    return float(BRepExtrema_DistShapeShape(face, line).Value())


# Where a wall holds a wire it stands at the inside gap; with the clearance for that, at it all round.
@pytest.mark.parametrize(("kerf_mm", "inside_gap_mm"), [(0.1, 0.1), (0.4, 0.1), (0.4, 0.2)])
@pytest.mark.parametrize("name", ["eye", "hairpin"])
def test_walls_assembled_in_the_kernel_stand_at_radius_and_gap(
    tmp_path: Path, name: str, kerf_mm: float, inside_gap_mm: float
) -> None:
    wires, config = PIECES[name](), PlateConfig.model_construct(**{**PlateConfig().__dict__, "kerf": kerf_mm})
    laser, _ = laser_of(wires, config, JigConfig(inside_gap=f"{inside_gap_mm} mm"))
    for drawing in sheet_drawings(laser):
        write_flat_files(tmp_path, drawing, config, ("dxf",))
    chains = [chain_of(wire.centreline) for wire in wires]
    gaps = []
    for sheet in laser.sheets:
        cuts = outer_cuts(tmp_path / f"{sheet_name(sheet)}.dxf")
        for placed in sheet.placed:
            if placed.part.role != "wall":
                continue
            planned = next(contour for contour in placed.contours if contour.layer == "CUT_OUTER")
            read = min(cuts, key=lambda loop: apart(loop, Loop(planned.edges)))
            home = in_place(read, placed.quarters, placed.shift)
            # Spans too short for a laser are joined to their neighbours within MERGED_MM, some repeatedly;
            # where they can't be, their corner moves by half of SHORT_MM at most.
            wanted = polygon_of(Region(Loop(planned.edges)), 1e-3)
            assert abs(loop_area_mm2(home)) == pytest.approx(wanted.area, abs=2 * MERGED_MM * wanted.length)
            assert polygon_of(Region(read), 1e-3).hausdorff_distance(wanted) < SHORT_MM / 2 + MERGED_MM
            gaps += [gap_mm(home, chain) for chain in chains]
    face = wires[0].diameter_mm / 2 + inside_gap_mm
    assert min(gaps) == pytest.approx(face - kerf_mm / 2, abs=0.01)


def apart(one: Loop, other: Loop) -> float:
    return float(np.linalg.norm(centre(one) - centre(other)))


def centre(loop: Loop) -> FloatArray:
    return loop.sampled(0.01).mean(axis=0)


def in_place(loop: Loop, quarters: int, shift: tuple[float, float]) -> Loop:
    """The loop moved back from the sheet to where the part lies in the jig."""
    back = [moved(edge, 0, (-shift[0], -shift[1])) for edge in loop.edges]
    return Loop(tuple(moved(edge, -quarters, (0.0, 0.0)) for edge in back))
