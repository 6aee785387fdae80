"""Parts as build123d and cadquery see them."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.kernel.test_terraces import box, disc
from wrapit.kernel.measures import volume_mm3
from wrapit.kernel.objects import (
    FilePart,
    build123d_part,
    cadquery_assembly,
    cadquery_workplane,
    channels,
    moved,
)
from wrapit.kernel.terraces import terraced_solid


@pytest.fixture(scope="module")
def part() -> FilePart:
    made = terraced_solid(box(0, 0, 10, 8), 0.0, 2.0, [], [disc(5, 4, 1)], "plate")
    return FilePart("plate", made.solid, "#c8ccd4")


def test_both_libraries_see_the_same_solid(part: FilePart) -> None:
    expected = pytest.approx(volume_mm3(part.solid), rel=1e-12)
    assert build123d_part(part).volume == expected
    assert cadquery_workplane(part).val().Volume() == expected
    assert build123d_part(part).solids()[0].wrapped.IsSame(part.solid)


def test_a_raised_part_is_the_same_higher_up(part: FilePart) -> None:
    up = build123d_part(moved(part, (0.0, 0.0, 3.5)))
    assert float(up.bounding_box().min.Z) == pytest.approx(3.5, abs=1e-6)
    assert up.volume == pytest.approx(volume_mm3(part.solid), rel=1e-12)
    assert float(build123d_part(part).bounding_box().min.Z) == pytest.approx(0, abs=1e-6)


def test_a_part_called_like_the_whole_keeps_its_name(part: FilePart) -> None:
    tree = cadquery_assembly("plate", [part])
    assert tree.name == "plate (all)"
    assert [child.name for child in tree.children] == ["plate"]


def test_names_can_be_spelt_as_a_format_wants_them(part: FilePart) -> None:
    tree = cadquery_assembly("tree", [part], str.upper)
    assert [tree.name, *(child.name for child in tree.children)] == ["TREE", "PLATE"]


@given(st.tuples(*[st.integers(0, 255)] * 3))
def test_channels_are_shares_of_255(colour: tuple[int, int, int]) -> None:
    assert channels("#{:02X}{:02x}{:02x}".format(*colour)) == pytest.approx([c / 255 for c in colour])
