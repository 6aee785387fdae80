"""A plate with flat-topped terraces, pockets and through holes as ONE solid, without any boolean.

The outlines don't touch one another, so the solid's boundary is known: floors, ceilings and the upright
faces between them. They are made on shared edges and closed to a shell; nothing is intersected.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from wrapit.errors import KernelError
from wrapit.geometry import Loop, Region
from wrapit.geometry.outlines.polygons import loop_area_mm2, polygon_of, region_area_mm2
from wrapit.kernel.edges import (
    Followed,
    edges_of,
    followed,
    followed_loops,
    loop_edges,
    plane_face,
    turned,
    wire_of,
)
from wrapit.kernel.guard import REMEDY, guarded
from wrapit.kernel.measures import is_valid, volume_mm3
from wrapit.kernel.plain import Plain
from wrapit.kernel.runs import RUN_TOLERANCE_MM

# How finely are outlines sampled to tell what lies inside of what? They don't touch, so that roughly is
# enough: from 0.001 to 0.1 the jigs of butterfly, leaf and bee come out the same.
NESTING_TOLERANCE_MM = 0.01
# By how much may the volume differ from that of the outlines? A face that is missing or flipped, or terraces
# that overlap, show here; the jigs of butterfly, leaf and bee differ by 2e-15.
VOLUME_TOLERANCE = 1e-6


@dataclass(frozen=True, eq=False)
class Terrace:
    """A region whose surface lies at `z_mm` instead of the ground's: higher is a wall, lower a pocket.

    `upon` are terraces that stand on it, inside its outline without touching it. The sides are within
    `slack_mm` of the region's: more where nothing rests on them, for fewer faces.
    """

    region: Region
    z_mm: float
    upon: tuple[Terrace, ...] = ()
    slack_mm: float = RUN_TOLERANCE_MM


@dataclass(frozen=True, eq=False)
class _Raised:
    """A terrace whose outline, then its holes, are followed by few runs."""

    terrace: Terrace
    loops: list[Followed]
    upon: list[_Raised]

    @staticmethod
    def of(terrace: Terrace) -> _Raised:
        loops = followed_loops(terrace.region, terrace.slack_mm)
        return _Raised(terrace, loops, [_Raised.of(each) for each in terrace.upon])

    @property
    def area_mm2(self) -> float:
        """What its sides should enclose: the outline, or where they may leave it their curves' own area.

        Curves that enclose more or less than they may don't count: then the proof fails.
        """
        region, slack_mm = self.terrace.region, self.terrace.slack_mm
        outlined, followed = region_area_mm2(region), sum(loop.area_mm2 for loop in self.loops)
        if (
            slack_mm <= RUN_TOLERANCE_MM
            or abs(followed - outlined) > slack_mm * polygon_of(region, 0.01).length
        ):
            return outlined
        return followed


@dataclass(frozen=True, eq=False)
class Terraced:
    """The solid and its volume as the kernel measures it; places of outlines that had to become polygons."""

    solid: Any
    volume_mm3: float
    plain: tuple[str, ...] = ()


def terraced_solid(
    outline: Loop,
    bottom_mm: float,
    top_mm: float,
    terraces: Sequence[Terrace],
    through: Sequence[Loop],
    where: str,
    rim_slack_mm: float = RUN_TOLERANCE_MM,
) -> Terraced:
    """The solid between bottom and top inside the outline, with terraces and holes that don't touch.

    Its outer sides are within `rim_slack_mm` of the outline: more where nothing rests on it, for fewer faces.
    Where that fails, outlines that bound no sound face become polygons of short lines, and `plain` names
    their places. Raises KernelError naming `where` if even then the outcome is not one valid solid with the
    volume that the outlines have by calculation.
    """
    try:
        return _proven(_rim(outline, rim_slack_mm), bottom_mm, top_mm, terraces, through, where)
    except KernelError:
        plain = Plain()
        with guarded("building the solid", where):
            rim = _rim(plain.region(Region(outline), rim_slack_mm).outer, rim_slack_mm)
            holes = [plain.region(Region(hole)).outer for hole in through]
            raised = [_made_plain(terrace, plain) for terrace in terraces]
        if not plain.places:
            raise
        made = _proven(rim, bottom_mm, top_mm, raised, holes, where)
        return Terraced(made.solid, made.volume_mm3, tuple(plain.places))


def _rim(outline: Loop, slack_mm: float) -> Followed:
    return followed(turned(outline, counter_clockwise=True), slack_mm)


def _made_plain(terrace: Terrace, plain: Plain) -> Terrace:
    upon = tuple(_made_plain(each, plain) for each in terrace.upon)
    return Terrace(plain.region(terrace.region, terrace.slack_mm), terrace.z_mm, upon, terrace.slack_mm)


def _proven(
    outline: Followed,
    bottom_mm: float,
    top_mm: float,
    terraces: Sequence[Terrace],
    through: Sequence[Loop],
    where: str,
) -> Terraced:
    with guarded("building the solid", where):
        raised = [_Raised.of(terrace) for terrace in terraces]
        solid = _solid(outline, bottom_mm, top_mm, raised, through)
        expected = _expected_mm3(outline, bottom_mm, top_mm, raised, through)
        got = volume_mm3(solid)
        if got < 0:  # the shell came out facing inwards
            solid, got = solid.Reversed(), -got
        if not is_valid(solid):
            raise KernelError("the solid is not valid", where, REMEDY)
        if abs(got - expected) > VOLUME_TOLERANCE * expected:
            raise KernelError(f"the solid has {got:.2f} mm³ instead of {expected:.2f} mm³", where, REMEDY)
    return Terraced(solid, got)


def _expected_mm3(
    outline: Followed, bottom_mm: float, top_mm: float, raised: Sequence[_Raised], through: Sequence[Loop]
) -> float:
    """The volume by exact areas and heights."""
    area = abs(outline.area_mm2) - sum(abs(loop_area_mm2(hole)) for hole in through)
    return area * (top_mm - bottom_mm) + _raised_mm3(raised, top_mm)


def _raised_mm3(raised: Sequence[_Raised], ground_mm: float) -> float:
    return sum(
        each.area_mm2 * (each.terrace.z_mm - ground_mm) + _raised_mm3(each.upon, each.terrace.z_mm)
        for each in raised
    )


def _solid(
    outline: Followed, bottom: float, top: float, raised: Sequence[_Raised], through: Sequence[Loop]
) -> Any:
    floor_rim = wire_of(edges_of(outline, bottom))
    faces, top_rim = _upright(floor_rim, top - bottom)
    drains, voids = [], []
    for hole in through:
        floor_hole = wire_of(loop_edges(turned(hole, counter_clockwise=False), bottom))
        sides, top_hole = _upright(floor_hole, top - bottom)
        faces += sides
        drains.append(floor_hole)
        voids.append((hole, top_hole))
    faces.append(plane_face(floor_rim, drains, bottom).Reversed())
    faces += _tier((outline.loop, top_rim), voids, top, raised)
    return _closed(faces)


def _tier(
    shore: tuple[Loop, Any], voids: list[tuple[Loop, Any]], z: float, raised: Sequence[_Raised]
) -> list[Any]:
    """The faces from one level up: its ground between shore and voids, and everything that stands on it."""
    faces: list[Any] = []
    islands = [shore]
    for each in raised:
        outer, *inners = each.loops
        level = each.terrace.z_mm
        foot = wire_of(edges_of(outer, z))
        sides, head = _upright(foot, level - z)
        faces += sides
        voids.append((outer.loop, foot.Reversed()))
        wells = []
        for inner in inners:
            inner_foot = wire_of(edges_of(inner, z))
            sides, inner_head = _upright(inner_foot, level - z)
            faces += sides
            wells.append((inner.loop, inner_head))
            islands.append((inner.loop, inner_foot.Reversed()))
        faces += _tier((outer.loop, head), wells, level, each.upon)
    return faces + _ground(islands, voids, z)


def _upright(wire: Any, height: float) -> tuple[list[Any], Any]:
    """The faces swept by the wire, and the wire at the other end."""
    from OCP.BRepPrimAPI import BRepPrimAPI_MakePrism
    from OCP.gp import gp_Vec
    from OCP.TopAbs import TopAbs_FACE
    from OCP.TopExp import TopExp_Explorer
    from OCP.TopoDS import TopoDS

    prism = BRepPrimAPI_MakePrism(wire, gp_Vec(0, 0, height))
    faces = []
    explorer = TopExp_Explorer(prism.Shape(), TopAbs_FACE)
    while explorer.More():
        faces.append(TopoDS.Face_s(explorer.Current()))
        explorer.Next()
    return faces, TopoDS.Wire_s(prism.LastShape())


def _ground(islands: list[tuple[Loop, Any]], voids: list[tuple[Loop, Any]], z: float) -> list[Any]:
    """One level: a face inside its shore and in each ring of a terrace, less what stands there."""
    from OCP.TopoDS import TopoDS
    from shapely import Point, Polygon

    shores = [Polygon(loop.sampled(NESTING_TOLERANCE_MM)) for loop, _ in islands]
    inside: list[list[Any]] = [[] for _ in islands]
    for loop, wire in voids:
        point = Point(loop.sampled(NESTING_TOLERANCE_MM)[0])
        holders = [i for i, shore in enumerate(shores) if shore.contains(point)]
        if not holders:
            raise KernelError("a wall or hole lies outside the plate")
        inside[min(holders, key=lambda i: shores[i].area)].append(TopoDS.Wire_s(wire))
    return [
        plane_face(TopoDS.Wire_s(shore), holes, z) for (_, shore), holes in zip(islands, inside, strict=True)
    ]


def _closed(faces: list[Any]) -> Any:
    from OCP.BRep import BRep_Builder
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeSolid
    from OCP.ShapeFix import ShapeFix_Shell
    from OCP.TopoDS import TopoDS_Shell

    shell = TopoDS_Shell()
    builder = BRep_Builder()
    builder.MakeShell(shell)
    for face in faces:
        builder.Add(shell, face)
    fixer = ShapeFix_Shell(shell)
    fixer.FixFaceOrientation(shell)
    closed = fixer.Shell()
    closed.Closed(True)
    return BRepBuilderAPI_MakeSolid(closed).Solid()
