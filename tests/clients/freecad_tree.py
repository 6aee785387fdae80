"""Run inside FreeCAD's GUI program: opens STEP files and writes what it sees as JSON."""

import json
import os
import traceback
from pathlib import Path

import FreeCAD as App
import ImportGui


def seen(thing):
    solids = thing.Shape.Solids
    return {
        "label": thing.Label,
        "volume": sum(solid.Volume for solid in solids),
        "solids": len(solids),
        "valid": thing.Shape.isValid(),
        "curves": [] if solids else sorted({edge.Curve.TypeId for edge in thing.Shape.Edges}),
        "length": 0.0 if solids else sum(edge.Length for edge in thing.Shape.Edges),
        "colour": list(thing.ViewObject.ShapeColor[:3]),
    }


def opened(path):
    document = App.newDocument()
    ImportGui.insert(path, document.Name)
    features = [seen(thing) for thing in document.Objects if thing.TypeId == "Part::Feature"]
    groups = [thing.Label for thing in document.Objects if thing.TypeId in ("App::LinkGroup", "App::Part")]
    App.closeDocument(document.Name)
    return {"features": features, "groups": groups}


def merged(path):
    """What FreeCAD shows with its preferences as they come: labels and numbers of solids."""
    document = App.newDocument()
    ImportGui.insert(path, document.Name)
    found = {thing.Label: len(thing.Shape.Solids) for thing in document.Objects if hasattr(thing, "Shape")}
    App.closeDocument(document.Name)
    return found


try:
    paths = os.environ["STEP_FILES"].split(os.pathsep)
    as_it_comes = {path: merged(path) for path in paths}
    # The preference "Enable STEP Compound merge", off: otherwise an assembly arrives as one object.
    App.ParamGet("User parameter:BaseApp/Preferences/Mod/Import/hSTEP").SetBool(
        "ReadShapeCompoundMode", False
    )
    answer = {path: {**opened(path), "as_it_comes": as_it_comes[path]} for path in paths}
    Path(os.environ["SEEN_JSON"]).write_text(json.dumps(answer))
except BaseException:  # noqa: BLE001  told to the test; a dialog would wait for ever
    Path(os.environ["SEEN_JSON"] + ".error").write_text(traceback.format_exc())
os._exit(0)
