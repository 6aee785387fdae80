"""What `import wrapit` offers to programs, and the objects that it hands to build123d and cadquery."""

from __future__ import annotations

import math
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import wrapit
from tests.jig.metal import arcs, circle, line, wires_of
from wrapit import cad
from wrapit.config import Config
from wrapit.errors import ConfigError, KernelError
from wrapit.geometry import BezierChain
from wrapit.jig.model import JigSet
from wrapit.wires.model import Wire

RING = '<path d="M 5 20 C 5 0 45 0 45 20 C 45 40 5 40 5 20 Z" fill="none" stroke="black"/>'
PICTURE = (
    f'<svg xmlns="http://www.w3.org/2000/svg" width="50mm" height="40mm" viewBox="0 0 50 40">{RING}</svg>'
)
CHAINS = [arcs((0, 0), 0, (9, 180), (12, 0)), circle(6, (20.0, 5.0)), line((-5, 3), (26, 4))]
# What takes more than a blink to import; none of it may come before it is asked for.
HEAVY = {
    "numpy",
    "scipy",
    "shapely",
    "skimage",
    "PIL",
    "pydantic",
    "ezdxf",
    "OCP",
    "build123d",
    "cadquery",
    "typer",
}


@pytest.fixture(scope="module")
def picture(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("face") / "ring.svg"
    path.write_text(PICTURE)
    path.with_suffix(".yaml").write_text("drawing: ring.svg\nsize: 45 mm\n")
    return path


@pytest.fixture(scope="module")
def wires() -> tuple[Wire, ...]:
    return wires_of(CHAINS)


@pytest.fixture(scope="module")
def jigs(wires: tuple[Wire, ...]) -> JigSet:
    return wrapit.build_jigs(wires)[0]


def run(code: str) -> str:
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout


def test_the_import_brings_nothing_heavy() -> None:
    loaded = run("import sys, wrapit; dir(wrapit); print(*{name.split('.')[0] for name in sys.modules})")
    assert HEAVY & set(loaded.split()) == set()


def test_the_import_takes_less_than_fifty_milliseconds() -> None:
    code = "import time; t = time.perf_counter(); import wrapit; print(time.perf_counter() - t)"
    assert min(float(run(code)) for _ in range(5)) < 0.05


def test_everything_that_is_offered_is_there_and_no_more() -> None:
    assert set(wrapit.__all__) <= set(dir(wrapit))
    assert all(callable(getattr(wrapit, name)) for name in wrapit.__all__)
    with pytest.raises(AttributeError, match="no attribute 'bild'"):
        wrapit.bild  # noqa: B018  to look it up is what is tested


@pytest.mark.parametrize("name", ["from_python", "handle"])
def test_examples_need_no_more_than_is_offered(name: str) -> None:
    text = (Path(__file__).parent.parent / "examples" / f"{name}.py").read_text()
    (offered,) = re.findall(r"^from wrapit import (.*)$", text, re.MULTILINE)
    assert set(offered.split(", ")) <= {*wrapit.__all__, "cad"}
    assert re.findall(r"\bwrapit\.\w+", text) == []


def test_the_stages_hand_on_what_the_next_one_takes(picture: Path) -> None:
    config = wrapit.load_config(str(picture.with_suffix(".yaml")), ["size=40 mm"])
    drawing, findings = wrapit.trace(str(picture), config)
    assert findings == ()
    assert np.max(np.ptp(np.array(drawing.bounds_mm), axis=0)) == pytest.approx(40, abs=1e-6)
    solution, _ = wrapit.decompose(drawing, config)
    (wire,), _ = wrapit.draw_wires(solution, config)
    assert wire.length_mm == pytest.approx(sum(each.curve.length for each in drawing.segments), rel=1e-6)
    assert wire.closed


def test_without_a_config_a_picture_has_its_own_size(picture: Path) -> None:
    drawing, _ = wrapit.trace(picture)
    assert np.ptp(np.array(drawing.bounds_mm), axis=0)[0] == pytest.approx(40, abs=1e-6)
    (wire,), _ = wrapit.draw_wires(wrapit.decompose(drawing)[0])
    assert wire.diameter_mm == Config(drawing="x.svg").wire.gauge


@given(size_mm=st.floats(3, 1000))
def test_the_size_in_the_call_counts(picture: Path, size_mm: float) -> None:
    config = wrapit.load_config(picture.with_suffix(".yaml"))
    low, high = wrapit.trace(picture, config, size_mm)[0].bounds_mm
    assert np.max(high - low) == pytest.approx(size_mm, rel=1e-9)


@given(size_mm=st.floats(max_value=2.9) | st.floats(min_value=1001) | st.just(float("nan")))
def test_a_size_that_the_config_would_refuse_is_refused(picture: Path, size_mm: float) -> None:
    with pytest.raises(ConfigError) as refused:
        wrapit.trace(picture, size_mm=size_mm)
    assert refused.value.where == "size_mm"
    assert "choose between 3 mm and 1000 mm" in refused.value.remedy


def test_builds_take_texts_for_paths(picture: Path, tmp_path: Path) -> None:
    built = wrapit.build(str(picture.with_suffix(".yaml")), str(tmp_path / "out"), until="wires")
    assert built.folder == tmp_path / "out"
    assert (tmp_path / "out" / "decomposition.svg").is_file()


def test_checks_write_nothing(picture: Path) -> None:
    before = sorted(picture.parent.iterdir())
    checked = wrapit.check(str(picture.with_suffix(".yaml")), ["outputs=[]"])
    assert checked.folder is None
    assert checked.report["jig"]["valid"]
    assert sorted(picture.parent.iterdir()) == before


def test_a_jig_is_overbent_where_the_config_asks_for_it(wires: tuple[Wire, ...], jigs: JigSet) -> None:
    config = Config.model_validate({"drawing": "x.svg", "jig": {"springback": "compensate"}})
    assert wrapit.build_jigs(wires[:1], config)[0].overbent
    assert not jigs.overbent


def test_build123d_gets_the_jig_as_it_is(jigs: JigSet) -> None:
    jig = jigs.jigs[0]
    part = cad.jig_part(jig)
    assert type(part).__name__ == "Part"
    assert part.label == jig.name
    assert part.volume == pytest.approx(jig.volume_mm3, rel=1e-9)
    assert tuple(part.bounding_box().size) == pytest.approx(jig.size_mm, abs=1e-3)
    assert pytest.approx(0, abs=1e-6) == part.bounding_box().min.Z
    assert part.is_valid


def test_a_handle_added_with_build123d_is_one_solid_with_the_jig(jigs: JigSet) -> None:
    from build123d import Align, Box, Pos

    part = cad.jig_part(jigs.jigs[0])
    thickness_mm = jigs.jigs[0].plan.plate.thickness_mm
    box = part.bounding_box()
    bar = Box(10, 22, thickness_mm, align=(Align.CENTER, Align.MAX, Align.MIN))
    placed = Pos(box.center().X, box.min.Y + 2, 0) * bar
    handled, shared = part + placed, part & placed
    assert len(handled.solids()) == 1
    assert 0 < shared.volume < bar.volume / 5
    assert handled.volume == pytest.approx(part.volume + bar.volume - shared.volume, rel=1e-6)


def test_wires_lie_on_the_plate_of_the_jig_that_is_named(wires: tuple[Wire, ...], jigs: JigSet) -> None:
    wire, jig = wires[0], jigs.jigs[0]
    flat, laid = cad.wire_part(wire).bounding_box(), cad.wire_part(wire, jig).bounding_box()
    assert pytest.approx(-wire.diameter_mm / 2, abs=1e-3) == flat.min.Z
    assert pytest.approx(jig.plan.plate.thickness_mm, abs=1e-3) == laid.min.Z
    assert pytest.approx((flat.min.X, flat.max.Y), abs=1e-6) == (laid.min.X, laid.max.Y)


def test_a_centreline_is_one_edge_of_the_wires_length(wires: tuple[Wire, ...]) -> None:
    for wire in wires:
        edge = cad.wire_edge(wire)
        assert edge.label == wire.name
        if not wire.lifts:
            assert edge.length == pytest.approx(wire.length_mm, rel=1e-6)


def test_both_libraries_show_the_same_colour(jigs: JigSet, wires: tuple[Wire, ...]) -> None:
    tree = cad.assembly("piece", wires, jigs)
    for part in (cad.jig_part(jigs.jigs[0]), *map(cad.wire_part, wires)):
        assert rgb(part.color) == pytest.approx(rgb(tree.objects[part.label].color), abs=1e-6)


def rgb(colour: Any) -> tuple[float, ...]:
    channels = colour.wrapped.GetRGB()
    return channels.Red(), channels.Green(), channels.Blue()


def test_cadquery_gets_workplanes_and_an_assembly_with_names(jigs: JigSet, wires: tuple[Wire, ...]) -> None:
    jig = jigs.jigs[0]
    assert cad.jig_workplane(jig).val().Volume() == pytest.approx(jig.volume_mm3, rel=1e-9)
    on_it = cad.wire_workplane(wires[1], jig).faces("<Z").vals()
    assert on_it[0].BoundingBox().zmin == pytest.approx(jig.plan.plate.thickness_mm, abs=1e-3)
    tree = cad.assembly("piece", wires, jigs)
    names = [jig.name, *(f"{wire.name}{what}" for wire in wires for what in ("", " centreline"))]
    assert [child.name for child in tree.children] == names


def test_a_jig_without_solid_is_refused(jigs: JigSet) -> None:
    import dataclasses

    jig = jigs.jigs[0]
    bare = dataclasses.replace(jig, part=dataclasses.replace(jig.part, solid=None))
    for handed in (cad.jig_part, cad.jig_workplane):
        with pytest.raises(KernelError, match="holds no solid; take it from build_jigs"):
            handed(bare)


def test_a_wire_without_sound_solid_still_has_its_centreline() -> None:
    hairpin = np.array([[(0, 0), (40, 40), (0, 40), (40, 0)]], dtype=float)  # comes to a stand inside
    (sharp,) = wires_of([BezierChain(hairpin)])
    with pytest.raises(KernelError, match="no sound solid"):
        cad.wire_part(sharp)
    tree = cad.assembly("piece", [sharp])
    assert [child.name for child in tree.children] == [f"{sharp.name} centreline"]


def test_a_folded_wire_is_a_part_of_both_its_arms() -> None:
    there_and_back = [line((0, 0), (10, 0)).points, line((10, 0), (0, 0)).points]
    (folded,) = wires_of([BezierChain(np.concatenate(there_and_back))])
    part = cad.wire_part(folded)
    assert len(part.solids()) == 2
    assert part.volume == pytest.approx(math.pi / 4 * folded.diameter_mm**2 * folded.length_mm, rel=0.05)
