"""Run by FreeCAD's command-line program: imports a DXF and writes what it finds as JSON."""

import json
import os
from pathlib import Path

import FreeCAD as App
import importDXF
import Part


def area(loop):
    """By polygon: FreeCAD's own integral is wrong for faces whose edges are splines with corners."""
    points = [p for edge in loop.OrderedEdges for p in pieces(edge)]
    return Part.Face(Part.makePolygon([*points, points[0]])).Area


def pieces(edge):
    curves = edge.Curve.toBezier() if hasattr(edge.Curve, "toBezier") else []
    if curves:
        return [p for curve in curves for p in curve.toShape().discretize(20)[:-1]]
    points = edge.discretize(60)
    return points[::-1][:-1] if edge.Orientation == "Reversed" else points[:-1]


document = App.newDocument("plate")
importDXF.insert(os.environ["DXF_FILE"], "plate")
shapes = [thing.Shape for thing in document.Objects if hasattr(thing, "Shape") and not thing.Shape.isNull()]
edges = [edge for shape in shapes for edge in shape.Edges]
loops = [Part.Wire(group) for group in Part.sortEdges(edges)]
found = {
    "closed": [loop.isClosed() for loop in loops],
    "lengths": sorted(loop.Length for loop in loops),
    "areas": sorted(area(loop) for loop in loops if loop.isClosed()),
}
Path(os.environ["SEEN_JSON"]).write_text(json.dumps(found))
os._exit(0)
