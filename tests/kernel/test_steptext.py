"""One form for equal models, whatever order and numbers the kernel gives them."""

from __future__ import annotations

import random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from wrapit.kernel.steptext import canonical_step, carried

HEAD = "HEADER;FILE_NAME('a','2026-01-01',(''),(''),'','','');ENDSEC;DATA;\n"
TAIL = "ENDSEC;\nEND-ISO-10303-21;"


def test_canonical_step_forgets_the_order() -> None:
    head = "HEADER;FILE_NAME('a','2026-01-01',(''),(''),'','','');ENDSEC;DATA;\n"
    first = head + "#1=A('x');\n#2=B(#1,'#9');\n#3=C(#1);\nENDSEC;\nEND-ISO-10303-21;"
    second = head + "#7=C(#8);\n#8=A('x');\n#5=B(#8,'#9');\nENDSEC;\nEND-ISO-10303-21;"
    other = second.replace("B(#8", "B(#7")
    assert canonical_step(first, "a") == canonical_step(second, "a")
    assert canonical_step(first, "a") != canonical_step(other, "a")
    assert "'#9'" in canonical_step(first, "a")
    assert "2026" not in canonical_step(first, "a")


def test_shapes_are_spelled_once_and_vertices_stay_apart() -> None:
    points = "".join(f"#{n}=CARTESIAN_POINT('',(1.,2.,3.));\n" for n in (1, 2, 3))
    vertices = "#4=VERTEX_POINT('',#1);\n#5=VERTEX_POINT('',#2);\n#6=SHELL((#4,#5,#3));\n"
    text = canonical_step(HEAD + points + vertices + TAIL, "a")
    assert text.count("CARTESIAN_POINT") == 1
    assert text.count("VERTEX_POINT('',#1)") == 2


@given(st.data(), st.integers(1, 12), st.randoms())
def test_any_order_and_any_numbers_give_the_same_text(
    data: st.DataObject, count: int, chance: random.Random
) -> None:
    uses = [data.draw(st.lists(st.integers(0, n - 1), max_size=3)) if n else [] for n in range(count)]
    kinds = [data.draw(st.sampled_from("ABC")) for _ in range(count)]

    def written(order: list[int], numbers: list[int]) -> str:
        lines = [
            f"#{numbers[n]}={kinds[n]}('#1 {n % 2}',{','.join(f'#{numbers[used]}' for used in uses[n])});"
            for n in order
        ]
        return canonical_step(HEAD + "\n".join(lines) + "\n" + TAIL, "a")

    plain = list(range(count))
    order, numbers = list(plain), [n + 1 for n in chance.sample(range(100), count)]
    chance.shuffle(order)
    assert written(order, numbers) == written(plain, [n + 1 for n in plain])


@given(st.lists(st.sampled_from(["", " ", "\n", " \n  "]), min_size=14, max_size=14))
def test_any_line_breaks_give_the_same_text(blanks: list[str]) -> None:
    """The kernel's writer breaks lines by the width of its numbers, which grow from file to file."""
    signs = ["A(", "'a , ( b'", ",", "$", ",", "(", "1.", ",", "2.", ")", ",", "(", "#2", ")"]
    body = "".join(sign + blank for sign, blank in zip(signs, blanks, strict=True))
    text = canonical_step(HEAD + f"#1={body});\n#2=( B(*) C($) );\n" + TAIL, "a")
    assert "=A('a , ( b',$,(1.,2.),(#1));" in text
    assert "=(B(*)C($));" in text


@pytest.mark.parametrize(
    "uses",
    [
        # Two that use one thing twice or two things once each: who else uses them tells them apart.
        [[], [], [0, 1], [1], [1, 1], []],
        # Rings of two and of three users: all see the same around them, however far they look.
        [[], [], [], [], [], [0, 1], [1, 0], [2, 3], [3, 4], [4, 2]],
    ],
)
def test_roots_that_tie_are_told_apart_by_what_they_share(uses: list[list[int]]) -> None:
    chance = random.Random(1)
    texts = set()
    for _ in range(50):
        numbers = chance.sample(range(1, 99), len(uses))
        lines = [
            f"#{number}=A({','.join(f'#{numbers[n]}' for n in used)});"
            for number, used in zip(numbers, uses, strict=True)
        ]
        chance.shuffle(lines)
        texts.add(canonical_step(HEAD + "\n".join(lines) + "\n" + TAIL, "a"))
    assert len(texts) == 1


@given(st.text(st.characters(exclude_categories=("Cs", "Cc")), max_size=20))
def test_names_are_carried_in_ascii(name: str) -> None:
    assert carried(name).isascii()
    assert (carried(name) == name) == name.isascii()
