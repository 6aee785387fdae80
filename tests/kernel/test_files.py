"""Files read back: names, colours, volumes, units, and the same bytes again."""

from __future__ import annotations

import hashlib
import subprocess
import sys
import zipfile
from pathlib import Path

import numpy as np
import pytest

from tests.jig.metal import arcs, circle, line, wires_of
from tests.kernel.test_terraces import box
from wrapit.config import JigConfig
from wrapit.errors import WrapItError
from wrapit.jig.model import Jig
from wrapit.jig.printed.stage import build_jig
from wrapit.kernel.files import write_3mf, write_printable, write_step, write_stl
from wrapit.kernel.measures import volume_mm3
from wrapit.kernel.objects import FilePart
from wrapit.kernel.round_wires.sweeps import round_wire
from wrapit.kernel.terraces import terraced_solid

COPPER, GREY = "#b87333", "#c8ccd4"
CHAINS = [arcs((0, 0), 0, (9, 180), (12, 0)), circle(6, (20.0, 5.0)), line((-5, 3), (26, 4))]


@pytest.fixture(scope="module")
def jig() -> Jig:
    return build_jig(wires_of(CHAINS), JigConfig())[0].jigs[0]


def wire_parts() -> list[FilePart]:
    parts = []
    for wire, colour in zip(wires_of(CHAINS), (COPPER, "#3366cc", "#00aa55"), strict=True):
        made = round_wire(wire.centreline, wire.diameter_mm, wire.lifts, wire.name)
        solid, edge = made.solid, made.centreline
        parts.append(FilePart(wire.name, solid, colour, (edge,)))
    return parts


def test_step_has_names_colours_and_volumes(tmp_path: Path) -> None:
    parts = wire_parts()
    write_step(tmp_path / "wires.step", "knot wires", parts)
    seen = read_step(tmp_path / "wires.step")
    for part in parts:
        colour, shape = seen[part.name]
        channels = [int(part.colour[i : i + 2], 16) / 255 for i in (1, 3, 5)]
        assert colour == pytest.approx(channels, abs=2e-3)
        assert volume_mm3(shape) == pytest.approx(volume_mm3(part.solid), rel=1e-6)
        assert f"{part.name} centreline" in seen
    text = (tmp_path / "wires.step").read_text()
    assert "AUTOMOTIVE_DESIGN { 1 0 10303 214" in text
    assert "SI_UNIT(.MILLI.,.METRE.)" in text
    assert "PRODUCT('knot wires'" in text


@pytest.mark.parametrize("name", ["Blüte", "花", "𝒳 and ß", "O'Neill", "plain"])
def test_step_names_of_all_scripts_are_read_back(tmp_path: Path, name: str) -> None:
    part = wire_parts()[2]
    write_step(tmp_path / "named.step", f"{name} (all)", [FilePart(name, part.solid, part.colour)])
    assert (tmp_path / "named.step").read_bytes().isascii()
    assert product_names(tmp_path / "named.step") == {name, f"{name} (all)"}


def test_step_numbers_count_up_and_refer_backwards(tmp_path: Path, jig: Jig) -> None:
    import re

    write_step(tmp_path / "jig.step", "jig", [FilePart("jig #1; 'x'", jig.part.solid, GREY)])
    data = (tmp_path / "jig.step").read_text().split("DATA;\n")[1].splitlines()
    for number, body in enumerate(data[:-2], start=1):
        assert body.startswith(f"#{number}=")
        outside = re.sub(r"'(?:[^']|'')*'", "''", body.split("=", 1)[1])
        assert all(int(used) < number for used in re.findall(r"#(\d+)", outside))
    assert "jig #1; ''x''" in "".join(data)


def test_stl_is_binary_closed_and_near(tmp_path: Path, jig: Jig) -> None:
    write_stl(tmp_path / "jig.stl", [jig.part.solid], 0.005)
    data = (tmp_path / "jig.stl").read_bytes()
    count = int(np.frombuffer(data[80:84], "<u4")[0])
    assert len(data) == 84 + 50 * count
    facets = np.frombuffer(data[84:], dtype=[("v", "<f4", (4, 3)), ("a", "<u2")])["v"].astype(float)
    corners = [tuple(corner) for facet in facets[:, 1:] for corner in facet.tolist()]
    sides = [(corners[i + k], corners[i + (k + 1) % 3]) for i in range(0, len(corners), 3) for k in range(3)]
    assert len(set(sides)) == len(sides)
    assert set(sides) == {(b, a) for a, b in sides}
    a, b, c = (facets[:, k] for k in (1, 2, 3))
    assert (a * np.cross(b, c)).sum() / 6 == pytest.approx(jig.volume_mm3, rel=1e-3)


def test_3mf_is_read_by_lib3mf(tmp_path: Path, jig: Jig) -> None:
    from build123d import Mesher

    write_3mf(tmp_path / "jig.3mf", [FilePart("jig <1>", jig.part.solid, GREY)])
    reader = Mesher()
    (shape,) = reader.read(tmp_path / "jig.3mf")
    assert reader.model_unit.name == "MM"
    assert reader.get_mesh_properties()[0]["name"] == "jig <1>"
    assert shape.volume == pytest.approx(jig.volume_mm3, rel=5e-3)
    model = zipfile.ZipFile(tmp_path / "jig.3mf").read("3D/3dmodel.model").decode()
    assert 'displaycolor="#C8CCD4FF"' in model


def test_unwritable_place_is_an_error(tmp_path: Path, jig: Jig) -> None:
    with pytest.raises(WrapItError):
        write_step(tmp_path / "missing" / "jig.step", "jig", [FilePart("jig", jig.part.solid, GREY)])


def test_two_processes_write_the_same_bytes(tmp_path: Path) -> None:
    for run in ("1", "2"):
        (tmp_path / run).mkdir()
        environment = {"PYTHONHASHSEED": run, "PATH": "/usr/bin:/bin"}
        command = [sys.executable, "-c", "from tests.kernel.test_files import _write; _write()", run]
        root = Path(__file__).parents[2]
        environment["PYTHONPATH"] = str(root)
        subprocess.run(command, check=True, cwd=tmp_path, env=environment, timeout=120)
    for path in sorted((tmp_path / "1").iterdir()):
        other = tmp_path / "2" / path.name
        assert hashlib.sha256(path.read_bytes()).digest() == hashlib.sha256(other.read_bytes()).digest()


def _write() -> None:
    """Writes every kind of file into the folder named on the command line."""
    folder = Path(sys.argv[1])
    # Different allocations before: addresses must not matter.
    ballast = [bytearray(1000 * int(sys.argv[1])) for _ in range(500)]
    jig = build_jig(wires_of(CHAINS), JigConfig())[0].jigs[0]
    write_step(folder / "wires.step", "wires", wire_parts())
    write_step(folder / "jig.step", "jig", [FilePart("jig", jig.part.solid, GREY)])
    write_stl(folder / "jig.stl", [jig.part.solid], 0.01)
    write_3mf(folder / "jig.3mf", [FilePart("jig", jig.part.solid, GREY)])
    assert ballast


def read_step(path: Path) -> dict[str, tuple[list[float], object]]:
    """Colour (sRGB) and shape of each named part."""
    import cadquery

    tree = cadquery.Assembly.importStep(str(path))
    seen: dict[str, tuple[list[float], object]] = {}
    for child in tree.children:
        colour = list(child.color.toTuple()[:3]) if child.color else []
        shape = child.obj.val() if hasattr(child.obj, "val") else child.obj
        seen[child.name] = (colour, shape.wrapped)
    return seen


def product_names(path: Path) -> set[str]:
    """Names as OpenCascade's own reader has them, in any script."""
    from OCP.STEPCAFControl import STEPCAFControl_Reader
    from OCP.TCollection import TCollection_AsciiString, TCollection_ExtendedString
    from OCP.TDataStd import TDataStd_Name
    from OCP.TDF import TDF_LabelSequence
    from OCP.TDocStd import TDocStd_Document
    from OCP.XCAFDoc import XCAFDoc_DocumentTool

    document, reader = TDocStd_Document(TCollection_ExtendedString("read")), STEPCAFControl_Reader()
    reader.ReadFile(str(path))
    reader.Transfer(document)
    labels = TDF_LabelSequence()
    XCAFDoc_DocumentTool.ShapeTool_s(document.Main()).GetShapes(labels)
    names = set()
    for index in range(1, labels.Length() + 1):
        name = TDataStd_Name()
        labels.Value(index).FindAttribute(TDataStd_Name.GetID_s(), name)
        names.add(TCollection_AsciiString(name.Get()).ToCString())
    return names


def test_both_files_for_printers_are_those_that_each_would_be_alone(tmp_path: Path) -> None:
    made = terraced_solid(box(0, 0, 10, 10), 0.0, 2.0, [], [], "plate")
    part = FilePart("plate", made.solid, GREY)
    write_stl(tmp_path / "alone.stl", [part.solid], 0.01)
    write_3mf(tmp_path / "alone.3mf", [part], 0.01)
    write_printable(part, tmp_path / "a.stl", tmp_path / "a.3mf", 0.01)
    write_printable(part, None, tmp_path / "only.3mf", 0.01)
    write_printable(part, None, None, 0.01)
    assert (tmp_path / "a.stl").read_bytes() == (tmp_path / "alone.stl").read_bytes()
    assert (tmp_path / "a.3mf").read_bytes() == (tmp_path / "alone.3mf").read_bytes()
    assert (tmp_path / "only.3mf").read_bytes() == (tmp_path / "alone.3mf").read_bytes()
    assert len(list(tmp_path.iterdir())) == 5
