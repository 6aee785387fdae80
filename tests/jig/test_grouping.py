"""Which wires share a jig: as few jigs as hold each wire well, and why."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from tests.jig.metal import arcs, circle, config, line, wires_of
from wrapit.jig.parting.grouping import fewest_groups
from wrapit.jig.printed.stage import build_jig
from wrapit.jig.support import support_by_wire


def test_split_frees_a_packed_piece() -> None:
    # Rings 0.9 mm apart: only the first and the last leave room for a wall between them.
    rings = [circle(9 + 0.9 * i) for i in range(4)]
    single, _ = build_jig(wires_of(rings), config(split="single", least_support=0))
    weakest = min(support_by_wire(single.jigs[0].support).values())
    jigs, findings = build_jig(wires_of(rings), config(min_turn_support=weakest + 0.05))
    assert jigs.split == "per-wire"
    assert len(jigs.jigs) == 3
    assert sorted(name for jig in jigs.jigs for name in jig.wires) == [f"wire-0{i}" for i in range(1, 5)]
    better = {name: share for jig in jigs.jigs for name, share in support_by_wire(jig.support).items()}
    assert min(better.values()) > weakest + 0.05
    assert "split" in {finding.code for finding in findings}


def test_every_wire_alone_on_request() -> None:
    jigs, _ = build_jig(wires_of([circle(9), circle(8, (30, 0))]), config(split="per-wire"))
    assert [jig.name for jig in jigs.jigs] == ["jig-wire-01", "jig-wire-02"]


def test_wires_of_one_shape_share_a_form() -> None:
    hook = arcs((0, 0), 0.3, (12, 0), (5, 120), (8, 0))
    turned = hook.mapped([[0, -1], [1, 0]], (60, 0))
    flipped = hook.mapped([[-1, 0], [0, 1]], (-20, 0)).reversed()
    other = arcs((0, 40), 0.3, (12, 0), (5, 100), (8, 0))
    jigs, findings = build_jig(wires_of([hook, turned, flipped, other]), config(split="per-wire"))
    assert [jig.wires for jig in jigs.jigs] == [("wire-01",), ("wire-04",)]
    assert [(form.wire, form.like, form.mirrored) for form in jigs.forms] == [
        ("wire-02", "wire-01", False),
        ("wire-03", "wire-01", True),
    ]
    assert "make 3 on this form" in next(f.message for f in findings if f.code == "form")


def test_split_where_only_the_tail_of_another_wire_is_in_the_way() -> None:
    # A corner, and a wire that ends in it: its hole takes the ground that the corner's wall would stand on.
    corner = arcs((0, 0), 0, (15, 0), (1.3, 100), (15, 0))
    hook = arcs((15.8, 0.4), math.radians(-40), (12, 0), (6, 90), (6, 0)).reversed()
    single, _ = build_jig(wires_of([corner, hook]), config(split="single"))
    assert support_by_wire(single.jigs[0].support)["wire-01"] < 0.5
    jigs, findings = build_jig(wires_of([corner, hook]), config())
    assert [jig.name for jig in jigs.jigs] == ["jig-wire-01", "jig-wire-02"]
    assert support_by_wire(jigs.jigs[0].support)["wire-01"] > 0.95
    assert "split" in {finding.code for finding in findings}


def test_a_wire_with_nothing_to_hold_makes_way() -> None:
    corner = arcs((0, 0), 0, (15, 0), (1.3, 100), (15, 0))
    straight_wire = line((28, -10), (15.8, 0.4))
    jigs, findings = build_jig(wires_of([corner, straight_wire]), config())
    (jig,) = jigs.jigs
    assert (jig.name, jig.wires) == ("jig", ("wire-01",))
    assert support_by_wire(jig.support)["wire-01"] > 0.95
    assert {finding.code: finding.where for finding in findings} == {"no-jig": "wire-02"}
    (only_one,) = build_jig(wires_of([straight_wire]), config())[0].jigs
    assert only_one.wires == ("wire-01",)


def _partitions(members: list[int]) -> Iterator[list[list[int]]]:
    if not members:
        yield []
        return
    first, rest = members[0], members[1:]
    for groups in _partitions(rest):
        yield [[first], *groups]
        for index in range(len(groups)):
            yield [*groups[:index], [first, *groups[index]], *groups[index + 1 :]]


@given(st.integers(1, 6), st.integers(0, 1000))
def test_groups_are_the_fewest_of_all_partitions(count: int, seed: int) -> None:
    rng = np.random.default_rng(seed)
    losses = rng.uniform(0, 0.3, (count, count)) * (rng.uniform(size=(count, count)) < 0.6)
    np.fill_diagonal(losses, 0.0)
    spare = rng.uniform(0.02, 0.4, count)

    def holds(groups: list[list[int]]) -> bool:
        return all(sum(losses[i, j] for j in group) <= spare[i] for group in groups for i in group)

    found = fewest_groups(losses, spare)
    assert sorted(i for group in found for i in group) == list(range(count))
    assert holds(found)
    assert len(found) == min(len(groups) for groups in _partitions(list(range(count))) if holds(groups))
