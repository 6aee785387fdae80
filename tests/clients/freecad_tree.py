"""Run inside FreeCAD's GUI program: opens STEP files and writes what it sees as JSON."""

import json
import os
from pathlib import Path

import FreeCAD as App
import ImportGui

preferences = App.ParamGet("User parameter:BaseApp/Preferences/Mod/Import")
preferences.SetBool("ReadShapeCompoundMode", False)
preferences.SetInt("ImportMode", 0)
seen = {}
for path in os.environ["STEP_FILES"].split(os.pathsep):
    document = App.newDocument()
    ImportGui.insert(path, document.Name)
    seen[Path(path).name] = [
        {
            "label": thing.Label,
            "type": thing.TypeId,
            "volume": sum(solid.Volume for solid in thing.Shape.Solids),
            "solids": len(thing.Shape.Solids),
            "valid": thing.Shape.isValid(),
            "free_curves": sorted({e.Curve.TypeId for e in thing.Shape.Edges})
            if not thing.Shape.Solids
            else [],
            "length": sum(e.Length for e in thing.Shape.Edges) if not thing.Shape.Solids else 0.0,
            "colour": [round(c, 4) for c in thing.ViewObject.ShapeColor[:3]]
            if not thing.Shape.isNull()
            else [],
        }
        for thing in document.Objects
        if hasattr(thing, "Shape")
    ]
Path(os.environ["SEEN_JSON"]).write_text(json.dumps(seen))
os._exit(0)
