"""Disjoint sets against a search of the whole graph."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from wrapit.geometry.disjoint_sets import Sets

pairs = st.lists(st.tuples(st.integers(0, 14), st.integers(0, 14)), max_size=25)


def reached(start: int, edges: list[tuple[int, int]]) -> set[int]:
    """Everything joined to a number, by walking."""
    found, waiting = {start}, [start]
    while waiting:
        x = waiting.pop()
        for a, b in edges:
            for here, there in ((a, b), (b, a)):
                if here == x and there not in found:
                    found.add(there)
                    waiting.append(there)
    return found


@given(pairs)
def test_sets_are_what_walking_reaches(edges: list[tuple[int, int]]) -> None:
    sets = Sets()
    for index, (a, b) in enumerate(edges):
        apart = b not in reached(a, edges[:index])
        assert sets.merge(a, b) == apart
    for x in range(15):
        assert sets.find(x) == min(reached(x, edges))
    walked = {tuple(sorted(reached(x, edges))) for x in range(15)}
    assert sets.groups() == tuple(sorted(group for group in walked if len(group) > 1))


@given(pairs, st.randoms())
def test_order_does_not_matter(edges: list[tuple[int, int]], random) -> None:
    shuffled = [edge if random.random() < 0.5 else edge[::-1] for edge in edges]
    random.shuffle(shuffled)
    assert Sets(edges).groups() == Sets(shuffled).groups()


@given(st.lists(st.lists(st.integers(0, 9), min_size=1, max_size=5).map(tuple), max_size=6))
def test_mergers_count_how_many_sets_went(groups: list[tuple[int, ...]]) -> None:
    sets, taken = Sets(), 0
    for group in groups:
        taken += sets.merge_all(group)
    numbers = {x for group in groups for x in group}
    assert len({sets.find(x) for x in numbers}) == len(numbers) - taken
