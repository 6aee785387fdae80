"""LibreCAD draws the laser's file as it is meant: it prints the planned cuts, whatever spells the curves."""

from __future__ import annotations

import os
import re
import subprocess
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from shapely import (
    LinearRing,
    LineString,
    MultiLineString,
    distance,
    get_coordinates,
    points,
    prepare,
    segmentize,
    shortest_line,
    transform,
)
from shapely.geometry.base import BaseGeometry

from tests.exports.test_plate_dxf import moon
from wrapit.config.plate import CurveStyle
from wrapit.exports.plate_dxf import write_dxf
from wrapit.geometry import Loop
from wrapit.jig.contours import Contour

pytestmark = pytest.mark.client

# LibreCAD prints on a grid: arcs and lines, which it can't take for others, are off by 0.015 mm. A spline
# that it takes for a periodic one was off by 0.06 to 0.5 mm, this one by 0.26.
PRINT_MM = 0.03


@pytest.mark.parametrize("curves", ["spline", "arc", "polyline"])
def test_librecad_prints_the_planned_cuts(
    program: Callable[[str], str], tmp_path: Path, curves: CurveStyle
) -> None:
    librecad, converter = program("librecad"), program("pdftocairo")
    # A print begins at 0, 0: what lies left of it or below is cut off.
    cut = Contour("CUT_OUTER", moon().outer.edges).moved(0, (12.0, 10.0))
    drawn, printed, picture = (tmp_path / f"moon.{ext}" for ext in ("dxf", "pdf", "svg"))
    write_dxf(drawn, [cut], "lightburn", curves, 0.002)
    command = [librecad, "dxf2pdf", "-p", "40x40", "-r", "4800", "-s", "1"]
    command += ["-o", str(printed), str(drawn)]
    environment = {**os.environ, "QT_QPA_PLATFORM": "offscreen", "HOME": str(tmp_path)}
    run = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=300, check=False)
    assert printed.is_file(), run.stdout + run.stderr
    subprocess.run([converter, "-svg", str(printed), str(picture)], check=True, timeout=60)
    planned = LinearRing(Loop(cut.edges).sampled(1e-5))
    seen = aligned(strokes(picture.read_text()), planned)
    assert apart(seen, planned) < PRINT_MM
    assert apart(planned, seen) < PRINT_MM


def strokes(svg: str) -> MultiLineString:
    """What is printed, in millimetres, y up."""
    found = []
    for data, scale in re.findall(r'<path[^>]* d="(M [^"]*)" transform="matrix\(([\d.]+),', svg):
        assert set(re.findall("[A-Za-z]", data)) <= {"M", "L", "Z"}
        for run in data.split("M")[1:]:
            ends = np.array(re.findall(r"-?[\d.]+", run), float).reshape(-1, 2)
            if np.ptp(ends, axis=0).any():
                found.append(LineString(ends * float(scale) * 25.4 / 72 * [1, -1]))
    return MultiLineString(found)


def aligned(seen: BaseGeometry, planned: BaseGeometry) -> BaseGeometry:
    """Moved, and scaled by what the print is off (below a thousandth), to lie on what was planned."""
    shift = np.array(planned.bounds[:2]) - seen.bounds[:2]
    moved = transform(seen, lambda xy: xy + shift)
    for _ in range(12):
        here = get_coordinates(segmentize(moved, 0.1))
        there = get_coordinates(shortest_line(points(here), planned))[1::2]
        middle, target = here.mean(axis=0), there.mean(axis=0)
        scale = ((here - middle) * (there - target)).sum() / ((here - middle) ** 2).sum()
        assert scale == pytest.approx(1, abs=0.02)
        moved = transform(moved, lambda xy, a=middle, b=target, k=scale: (xy - a) * k + b)
    return moved


def apart(one: BaseGeometry, other: BaseGeometry) -> float:
    """The farthest that a point of one lies from the other."""
    prepare(other)
    return float(distance(points(get_coordinates(segmentize(one, 0.02))), other).max())
