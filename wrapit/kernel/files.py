"""STEP, STL and 3MF files of named, coloured parts; the same parts give the same bytes."""

from __future__ import annotations

import zipfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any
from xml.sax.saxutils import quoteattr

import numpy as np

from wrapit.errors import ExportError
from wrapit.kernel.guard import guarded
from wrapit.kernel.meshes import Mesh, mesh_of
from wrapit.kernel.objects import FilePart, cadquery_assembly
from wrapit.kernel.steptext import canonical_step, carried

__all__ = ["FilePart", "write_3mf", "write_printable", "write_step", "write_stl"]

# How coarse may facets be? At 0.005 mm, 0.2 makes 104 144 triangles of four jigs (0.14: 114 518, 0.5:
# 96 346), all of them closed; a build takes the distance from its config, which says the same unless told.
ANGLE_RAD = 0.2
TOLERANCE_MM = 0.005
# The first date that a ZIP can hold; same parts, same bytes.
_ZIP_DATE = (1980, 1, 1, 0, 0, 0)


def write_step(path: Path, name: str, parts: Sequence[FilePart]) -> None:
    """AP214 in mm: a tree `name`/{parts}, each with name and colour; edges beside their part.

    Raises ExportError if the file can't be written, KernelError if the kernel fails.
    """
    with guarded("writing STEP", path.name):
        if not _export(cadquery_assembly(name, parts, carried), path):
            raise ExportError("the STEP file can't be written", str(path))
    text = canonical_step(path.read_text(encoding="latin-1"), path.name)
    path.write_text(text, encoding="latin-1", newline="\n")


def write_stl(path: Path, solids: Sequence[Any], tolerance_mm: float) -> None:
    """Binary STL, watertight, no facet farther from the surface than the tolerance."""
    with guarded("writing STL", path.name):
        _write_stl(path, mesh_of(solids, tolerance_mm, ANGLE_RAD))


def write_3mf(path: Path, parts: Sequence[FilePart], tolerance_mm: float = TOLERANCE_MM) -> None:
    """3MF in mm (core specification 1.3): one named, coloured object for each part, in place."""
    with guarded("writing 3MF", path.name):
        _write_3mf(path, parts, [mesh_of([part.solid], tolerance_mm, ANGLE_RAD) for part in parts])


def write_printable(part: FilePart, stl: Path | None, three_mf: Path | None, tolerance_mm: float) -> None:
    """The part as STL, 3MF or both, of the same triangles."""
    paths = [path for path in (stl, three_mf) if path is not None]
    if not paths:
        return
    with guarded("dividing into triangles", paths[0].name):
        mesh = mesh_of([part.solid], tolerance_mm, ANGLE_RAD)
    if stl is not None:
        _write_stl(stl, mesh)
    if three_mf is not None:
        _write_3mf(three_mf, [part], [mesh])


def _write_stl(path: Path, mesh: Mesh) -> None:
    a, b, c = (mesh.corners[mesh.triangles[:, k]].astype("<f4") for k in range(3))
    normal = np.cross(b - a, c - a)
    length = np.linalg.norm(normal, axis=1, keepdims=True)
    facets = np.zeros(len(a), dtype=[("vectors", "<f4", (4, 3)), ("attribute", "<u2")])
    facets["vectors"] = np.stack([normal / np.where(length > 0, length, 1), a, b, c], axis=1)
    header = b"wrapit, mm".ljust(80)
    path.write_bytes(header + np.uint32(len(facets)).tobytes() + facets.tobytes())


def _write_3mf(path: Path, parts: Sequence[FilePart], meshes: Sequence[Mesh]) -> None:
    entries = {
        "[Content_Types].xml": _CONTENT_TYPES,
        "_rels/.rels": _RELATIONS,
        "3D/3dmodel.model": _model(parts, meshes),
    }
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=6) as archive:
        for name, text in entries.items():
            info = zipfile.ZipInfo(name, _ZIP_DATE)
            info.compress_type = zipfile.ZIP_DEFLATED
            info.create_system = 3
            archive.writestr(info, text)


def _export(tree: Any, path: Path) -> bool:
    from cadquery.occ_impl.exporters.assembly import exportAssembly
    from OCP.Interface import Interface_Static

    Interface_Static.SetCVal_s("write.step.schema", "AP214IS")
    Interface_Static.SetCVal_s("write.step.unit", "MM")
    return bool(exportAssembly(tree, str(path), write_pcurves=False))


def _model(parts: Sequence[FilePart], meshes: Sequence[Mesh]) -> str:
    lines = [
        '<?xml version="1.0" encoding="UTF-8"?>',
        '<model unit="millimeter" xml:lang="en-US"'
        ' xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02">',
        '<metadata name="Application">wrapit</metadata>',
        "<resources>",
        '<basematerials id="1">',
    ]
    lines += [
        f"<base name={quoteattr(p.name)} displaycolor={quoteattr(p.colour.upper() + 'FF')}/>" for p in parts
    ]
    lines.append("</basematerials>")
    for index, (part, mesh) in enumerate(zip(parts, meshes, strict=True)):
        lines.append(
            f'<object id="{index + 2}" type="model" name={quoteattr(part.name)} pid="1" pindex="{index}">'
        )
        lines += ["<mesh>", "<vertices>"]
        lines += [f'<vertex x="{x:.5f}" y="{y:.5f}" z="{z:.5f}"/>' for x, y, z in mesh.corners.tolist()]
        lines += ["</vertices>", "<triangles>"]
        lines += [f'<triangle v1="{a}" v2="{b}" v3="{c}"/>' for a, b, c in mesh.triangles.tolist()]
        lines += ["</triangles>", "</mesh>", "</object>"]
    lines += ["</resources>", "<build>"]
    lines += [f'<item objectid="{index + 2}"/>' for index in range(len(parts))]
    return "\n".join([*lines, "</build>", "</model>", ""])


# What kinds of parts the package has (Open Packaging Conventions).
_CONTENT_TYPES = """<?xml version="1.0" encoding="UTF-8"?>
<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">
<Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>
<Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/>
</Types>
"""

# Where the package's model is.
_RELATIONS = """<?xml version="1.0" encoding="UTF-8"?>
<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">
<Relationship Target="/3D/3dmodel.model" Id="rel0"
 Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>
</Relationships>
"""
