"""What the rest of a drawing has to know of a part: options, and which of them others make needless."""

from __future__ import annotations

from itertools import product

import pytest
from hypothesis import given
from hypothesis import strategies as st

from wrapit.decomposition.exact.cactus.options import ENOUGH, Option, surcharges, useful
from wrapit.decomposition.exact.cactus.passages import passage, passages
from wrapit.decomposition.exact.junction_matching import matchings_of

KINDS = list(product((False, True), range(ENOUGH + 1)))
WEAK = st.sampled_from([0.0, 0.3, 0.9, 1.5])


@given(weak=WEAK)
def test_an_option_stands_for_itself_at_no_cost_and_for_no_other_at_a_gain(weak: float) -> None:
    for kept, wanted in product(KINDS, KINDS):
        surcharge = surcharges(kept, weak)[wanted]
        assert surcharge >= 0.0
        assert surcharge == 0.0 or kept != wanted
    assert surcharges((True, ENOUGH), weak)[False, ENOUGH] == 1.0  # the ring that it may close
    assert surcharges((False, 0), weak)[True, ENOUGH] == 0.0  # of two wires in place of one, none is weak


@given(weak=WEAK, costs=st.lists(st.floats(0, 3), min_size=6, max_size=6))
def test_what_is_left_out_is_no_better_than_what_is_kept(weak: float, costs: list[float]) -> None:
    options = [Option(cost, *kind) for cost, kind in zip(costs, KINDS, strict=True)]
    kept = useful(options, weak)
    assert kept == sorted(kept, key=lambda option: option[:3])
    assert min(options, key=lambda option: option.cost).cost == kept[0].cost
    for option in options:
        stands_in = min(
            other.cost + surcharges((other.through, other.contacts), weak)[option.through, option.contacts]
            for other in kept
        )
        assert stands_in <= option.cost


@pytest.mark.parametrize("doors", [0, 1, 2])
@pytest.mark.parametrize("sizes", [(1,), (2,), (1, 2), (2, 2), (1, 1, 1)])
def test_every_matching_is_a_passage_or_a_ring(doors: int, sizes: tuple[int, ...]) -> None:
    through = tuple(size == 2 for size in sizes)
    listed = [pairs for _, group in passages(doors, sizes, through) for pairs in group]
    everything = matchings_of(doors + sum(sizes))
    assert len(listed) == len(set(listed))
    assert set(everything) - set(listed) == {
        pairs for pairs in everything if passage(doors, sizes, through, pairs) is None
    }
    assert all(len(set(p.whole)) == len(p.whole) for p, _ in passages(doors, sizes, through))


def test_a_ring_between_the_doors_of_one_branch_is_none() -> None:
    assert passage(0, (2,), (True,), ((0, 1),)) is None
    opened = passage(0, (2,), (True,), ())
    assert opened is not None
    assert opened.whole == (0,)
    joined = passage(2, (2,), (True,), ((0, 2), (1, 3)))
    assert joined is not None
    assert (joined.through, joined.alone, joined.whole) == (True, True, (0,))
