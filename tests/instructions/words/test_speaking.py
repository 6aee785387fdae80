"""Sentences in both languages and units: singular and plural, decimal commas, sixteenths of an inch."""

from __future__ import annotations

import itertools
import re
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from wrapit.instructions.words.quantities import half_millimetres, inches, sixteenths
from wrapit.instructions.words.speaking import UNIT, Speaker
from wrapit.pages.model import Duration, Length, Mass, Span, Text, Thickness, either, listed, text
from wrapit.units import awg_diameter_mm

AWG18_MM = awg_diameter_mm(18)
MM, IN, DE = Speaker("en", "mm"), Speaker("en", "in"), Speaker("de", "mm")


def said(speaker: Speaker, message: Text) -> str:
    return speaker.say(message).replace(UNIT, " ")


def of(speaker: Speaker, value: object) -> str:
    return said(speaker, Text("length", (("value", value),)))  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("value", "english", "imperial", "german"),
    [
        (Length(12.26), "12.5 mm", "1/2 in", "12,5 mm"),
        (Length(123.4), "123 mm", "4 7/8 in", "123 mm"),
        (Length(25.4), "25.5 mm", "1 in", "25,5 mm"),
        (Span(10.2, 20.3), "10.5 mm", "7/16 in", "10,5 mm"),
        (Thickness(0.95), "0.95 mm", "0.037 in", "0,95 mm"),
        (Thickness(AWG18_MM, wire=True), "18 AWG (1.02 mm)", "18 AWG (0.04 in)", "18 AWG (1,02 mm)"),
        (Thickness(1.219, wire=True), "18 SWG (1.22 mm)", "18 SWG (0.048 in)", "18 SWG (1,22 mm)"),
        (Mass(12.34), "12.3 g", "0.44 oz", "12,3 g"),
        (Duration(17), "15 min", "15 min", "15 min"),
        (Duration(121), "2 h", "2 h", "2 h"),
        (Duration(70), "1 h 15 min", "1 h 15 min", "1 h 15 min"),
        (listed(["1", "2", "3"]), "1, 2 and 3", "1, 2 and 3", "1, 2 und 3"),
        (either(["a", "b"]), "a or b", "a or b", "a oder b"),
        (listed(["a"]), "a", "a", "a"),
    ],
)  # fmt: skip
def test_quantities(value: object, english: str, imperial: str, german: str) -> None:
    assert (of(MM, value), of(IN, value), of(DE, value)) == (english, imperial, german)


@given(st.floats(0, 2000))
def test_inches_are_to_the_sixteenth(length_mm: float) -> None:
    words = of(IN, Length(length_mm))
    assert words.endswith(" in")
    parts = [Fraction(part) for part in words.removesuffix(" in").split()]
    assert all(16 % part.denominator == 0 for part in parts)
    assert abs(float(sum(parts)) * 25.4 - length_mm) <= 25.4 / 32 + 1e-6
    assert inches(sixteenths(length_mm)) == words


@given(st.floats(0, 2000))
def test_german_has_a_decimal_comma(length_mm: float) -> None:
    words = of(DE, Length(length_mm)).removesuffix(" mm")
    number = float(words.replace(".", "").replace(",", "."))
    assert number == half_millimetres(length_mm)
    assert re.fullmatch(r"[\d.]+(,5)?", words)


@given(st.lists(st.floats(0, 90), min_size=2, max_size=6).map(sorted))
def test_lengths_that_follow_one_another_add_up(places: list[float]) -> None:
    for speaker in (MM, IN):
        spans = [Span(a, b) for a, b in itertools.pairwise(places)]
        total = sum(read(of(speaker, span)) for span in spans)
        whole = read(of(speaker, Span(places[0], places[-1])))
        assert total == pytest.approx(whole)


def read(words: str) -> float:
    return float(sum(Fraction(part) for part in words.split()[:-1]))


OVER = text("note-over", under=listed([text("wire-number", wire=1), text("itself")]), places=Length(3.5))


@pytest.mark.parametrize(
    ("message", "english", "german"),
    [
        (text("heading-lift", count=1), "Lift it out", "Heb ihn heraus"),
        (text("heading-lift", count=2), "Lift them out", "Heb sie heraus"),
        (
            text("lead", wires=1, ties=0, pieces=1, x=Length(10), y=Length(20)),
            "One wire, no ties; finished size 10 mm × 20 mm.",
            "Ein Draht, keine Bindestellen; fertige Größe 10 mm × 20 mm.",
        ),
        (
            text("lead", wires=3, ties=1, pieces=2, x=Length(10), y=Length(20)),
            "A pair, each of 3 wires, one tie; finished size 10 mm × 20 mm.",
            "Ein Paar aus je 3 Drähten, eine Bindestelle; fertige Größe 10 mm × 20 mm.",
        ),
        (
            text("do-bend", side="left", angle=90),
            "Bend it to the left by about 90°, with round-nose pliers.",
            "Bieg ihn mit der Rundzange um etwa 90° nach links.",
        ),
        (
            OVER,
            "It passes over wire 1 and itself at 3.5 mm.",
            "Er läuft über Draht 1 und sich selbst bei 3,5 mm.",
        ),
    ],
)  # fmt: skip
def test_sentences(message: Text, english: str, german: str) -> None:
    assert (said(MM, message), said(DE, message)) == (english, german)


def test_numbers_keep_to_their_units() -> None:
    for speaker in (MM, IN, DE):
        for value in (Length(12), Span(0, 12), Thickness(1.0), Mass(3)):
            assert " " not in speaker.say(Text("length", (("value", value),))).replace("1 7/8", "")


def test_what_is_missing_is_an_error() -> None:
    with pytest.raises(ValueError, match="lead-on"):
        MM.say(text("lead-on"))
    with pytest.raises(LookupError):
        MM.say(text("no-such-key"))


def test_lists_of_any_length_are_said() -> None:
    many = listed(text("tie-at", letter=f"T{index}", at=Length(index)) for index in range(900))
    said = Speaker("en", "mm").of("note-ties", places=many, count=900)
    assert said.startswith("On the way are places to tie later: T0 (0")
    assert "T450 (450" in said
    assert said.endswith("and T899 (899\u00a0mm).")
