"""Reading the DXF back finds closed contours, the same lengths, and the colours of the profile."""

from __future__ import annotations

import itertools
import math
from pathlib import Path

import ezdxf
import ezdxf.bbox
import ezdxf.path
import numpy as np
import pytest
from shapely import LineString, Polygon

from tests.exports.pieces_for_tests import arc_chain, eye
from tests.exports.test_preview_png import PLATE, WALL
from wrapit.config.plate import CurveStyle, ProfileName
from wrapit.exports.laser_profiles import ORDER, PROFILES
from wrapit.exports.plate_dxf import PLANAR, write_dxf
from wrapit.geometry import Arc, BezierChain, Line, Loop, Region
from wrapit.jig.contours import Contour, Layer
from wrapit.jig.sheet.engraving import engraved_wires, wire_numbers
from wrapit.wires.model import Wire


def plate_contours(plate: Region, walls: list[Region], wires: tuple[Wire, ...]) -> tuple[Contour, ...]:
    """A plate with openings in the shape of walls, and what is engraved on it."""
    loops = [loop for wall in walls for loop in (wall.outer, *wall.holes)] + list(plate.holes)
    bare = Region(plate.outer, (*(wall.outer for wall in walls), *plate.holes))
    return (
        *engraved_wires(wires, bare),
        *wire_numbers(wires, bare)[0],
        *(Contour("CUT_INNER", loop.edges) for loop in loops),
        Contour("CUT_OUTER", plate.outer.edges),
    )


def moon() -> Region:
    """A wall between two arcs, one of them given as Béziers, with a line at its tip."""
    outer = arc_chain((0, 0), 8.0, 0.0, math.pi)
    inner = Arc((0, 0), 5.0, math.pi, -math.pi)
    return Region(Loop((outer, Line((-8, 0), (-5, 0)), inner, Line((5, 0), (8, 0)))))


def polygons(document: ezdxf.document.Drawing, layer: str) -> list[Polygon]:
    found = []
    for entity in document.modelspace().query(f'*[layer=="{layer}"]'):
        path = ezdxf.path.make_path(entity)
        assert path.start.isclose(path.end, abs_tol=1e-12), f"{entity} is open"
        found.append(Polygon([(point.x, point.y) for point in path.flattening(1e-4)]))
    return found


def test_contours_come_back_closed_with_their_lengths(tmp_path: Path) -> None:
    _, wires = eye()
    path = tmp_path / "plate.dxf"
    walls = [moon(), WALL]
    write_dxf(path, plate_contours(PLATE, walls, wires))
    document = ezdxf.readfile(path)
    assert document.dxfversion == "AC1024"
    assert (document.header["$INSUNITS"], document.header["$MEASUREMENT"]) == (4, 1)
    assert not document.audit().errors
    outer = polygons(document, "CUT_OUTER")
    inner = polygons(document, "CUT_INNER")
    assert [polygon.length for polygon in outer] == pytest.approx([200.0])
    lengths = sorted(polygon.length for polygon in inner)
    assert lengths == pytest.approx(sorted([13 * math.pi + 6, 24.0, 2 * math.pi]), abs=1e-3)
    assert max(polygon.area for polygon in inner) == pytest.approx(math.pi * (64 - 25) / 2, abs=1e-2)


def test_order_colours_and_layers_follow_the_profile(tmp_path: Path) -> None:
    _, wires = eye()
    contours = plate_contours(PLATE, [WALL], wires)
    for name, looks in PROFILES.items():
        path = tmp_path / f"{name}.dxf"
        write_dxf(path, reversed(contours), name)
        document = ezdxf.readfile(path)
        order = [entity.dxf.layer for entity in document.modelspace()]
        layers = [looks[layer].name for layer in ORDER]
        assert [layers.index(layer) for layer in order] == sorted(layers.index(layer) for layer in order)
        if name == "plain":
            kinds = {entity.dxftype() for entity in document.modelspace()}
            assert kinds <= {"LINE", "ARC", "CIRCLE"}
        for entity in document.modelspace():
            look = next(look for look in looks.values() if look.name == entity.dxf.layer)
            assert (entity.dxf.color, entity.rgb) == (look.aci, look.rgb)
            assert document.layers.get(look.name).rgb == look.rgb


def test_curves_are_splines_in_bezier_form(tmp_path: Path) -> None:
    write_dxf(tmp_path / "moon.dxf", [Contour("CUT_OUTER", moon().outer.edges)])
    (spline,) = ezdxf.readfile(tmp_path / "moon.dxf").modelspace()
    assert spline.dxftype() == "SPLINE"
    assert spline.dxf.flags == PLANAR
    knots = np.array(spline.knots)
    _, counts = np.unique(knots, return_counts=True)
    assert counts.tolist() == [4] + [3] * (len(counts) - 2) + [4]
    assert len(spline.control_points) == 3 * (len(counts) - 1) + 1
    assert np.array_equal(spline.control_points[0], spline.control_points[-1])


def test_engraving_keeps_clear_of_cuts_and_is_drawn_once() -> None:
    solution, wires = eye()
    contours = plate_contours(PLATE, [WALL], wires)
    engraved = [contour for contour in contours if contour.layer == "ENGRAVE"]
    paths = [edge for contour in engraved for edge in contour.edges if isinstance(edge, BezierChain)]
    wall = Polygon(WALL.outer.sampled(0.01))
    lines = [LineString(path.sampled(0.05)) for path in paths]
    assert all(line.distance(wall) > 0.24 for line in lines)
    for a, b in itertools.combinations(lines, 2):
        assert a.intersection(b.buffer(1e-3)).length < 0.1
    # The bar runs through the wall, the stem is run along twice but engraved once.
    drawn = sum(line.length for line in lines)
    whole = sum(segment.curve.length for segment in solution.decomposition.drawing.segments)
    assert drawn == pytest.approx(
        whole
        - wall.buffer(0.25)
        .intersection(LineString(solution.decomposition.drawing.segments[5].curve.sampled(0.05)))
        .length,
        abs=0.2,
    )


@pytest.mark.parametrize("curves", ["arc", "polyline"])
def test_curves_keep_to_the_tolerance(tmp_path: Path, curves: str) -> None:
    oval = arc_chain((0, 0), 8.0, 0.0, 2 * math.pi).points * np.array([1.0, 0.5])
    oval[-1, 3] = oval[0, 0]
    loop = Loop((BezierChain(oval),))
    contour = Contour("CUT_OUTER", loop.edges)
    counts = []
    exact = Polygon(loop.sampled(1e-5)).exterior
    for tolerance in (0.05, 0.005):
        path = tmp_path / f"{tolerance}.dxf"
        write_dxf(path, [contour], "lightburn", curves, tolerance)
        (polygon,) = polygons(ezdxf.readfile(path), "CUT_OUTER")
        assert polygon.exterior.hausdorff_distance(exact) <= tolerance + 2e-4
        (entity,) = ezdxf.readfile(path).modelspace()
        assert entity.dxftype() == "LWPOLYLINE"
        assert entity.closed
        counts.append(len(entity))
    assert counts[0] < counts[1]


def test_open_cuts_are_refused(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="closed"):
        write_dxf(tmp_path / "open.dxf", [Contour("CUT_OUTER", (Line((0, 0), (1, 0)),))])


def test_bytes_repeat(tmp_path: Path) -> None:
    contours = plate_contours(PLATE, [moon()], eye()[1])
    write_dxf(tmp_path / "a.dxf", contours)
    write_dxf(tmp_path / "b.dxf", contours)
    assert (tmp_path / "a.dxf").read_bytes() == (tmp_path / "b.dxf").read_bytes()


@pytest.mark.parametrize("curves", ["spline", "arc", "polyline"])
@pytest.mark.parametrize("profile", sorted(PROFILES))
def test_the_extents_are_those_of_what_is_drawn(
    tmp_path: Path, profile: ProfileName, curves: CurveStyle
) -> None:
    contours = [Contour("CUT_OUTER", moon().outer.edges), Contour("NOTE", (Line((-9, 1), (2, 10)),))]
    write_dxf(tmp_path / "moon.dxf", contours, profile, curves, 0.001)
    document = ezdxf.readfile(tmp_path / "moon.dxf")
    box = ezdxf.bbox.extents(document.modelspace())
    assert document.header["$EXTMIN"] == pytest.approx(tuple(box.extmin), abs=1e-9)
    assert document.header["$EXTMAX"] == pytest.approx(tuple(box.extmax), abs=1e-9)
    assert document.header["$EXTMIN"][:2] == pytest.approx((-9, 0), abs=2e-3)
    assert document.header["$EXTMAX"][:2] == pytest.approx((8, 10), abs=2e-3)


@pytest.mark.parametrize("profile", sorted(PROFILES))
def test_who_cuts_the_layers_of_cuts_cuts_nothing_else(tmp_path: Path, profile: ProfileName) -> None:
    line = (Line((0, 0), (1, 0)),)
    others: list[Layer] = [layer for layer in ORDER if not layer.startswith("CUT")]
    contours = [Contour(layer, line) for layer in others] + [Contour("CUT_OUTER", PLATE.outer.edges)]
    write_dxf(tmp_path / "plate.dxf", contours, profile)
    looks = PROFILES[profile]
    cut = {looks["CUT_INNER"].name, looks["CUT_OUTER"].name}
    assert not cut & {looks[layer].name for layer in others}
    assert not {looks["CUT_INNER"].rgb, looks["CUT_OUTER"].rgb} & {looks[layer].rgb for layer in others}
    document = ezdxf.readfile(tmp_path / "plate.dxf")
    for layer in others:
        (entity,) = document.modelspace().query(f'*[layer=="{looks[layer].name}"]')
        assert entity.dxftype() in ("LINE", "LWPOLYLINE")
        assert document.layers.get(looks[layer].name).dxf.plot == int(layer != "NOTE")
