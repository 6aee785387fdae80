"""What metal costs: amounts as shops write them, and nothing that could be misread."""

from __future__ import annotations

import pytest

from wrapit.batch.pricing import read_prices
from wrapit.errors import ConfigError


@pytest.mark.parametrize(
    ("option", "amount", "currency"),
    [
        ("copper=12", 12, ""),
        ("copper=12/kg", 12, ""),
        ("Copper = 12,50 EUR", 12.5, "EUR"),
        ("copper=$12.50", 12.5, "$"),
        ("copper=12.5€ / kg", 12.5, "€"),
        ("sterling silver=900 CHF/kg", 900, "CHF"),
    ],
)
def test_a_price_is_for_a_kilogram(option: str, amount: float, currency: str) -> None:
    prices = read_prices([option])
    assert list(prices.per_kg.values()) == [amount]
    assert prices.currency == currency


@pytest.mark.parametrize(
    "option",
    [
        "copper",
        "copper=",
        "copper=cheap",
        "copper=-3",
        "copper=1,000.00",
        "unobtainium=3",
        "=3",
        "copper=3/m",
    ],
)
def test_what_is_no_price_is_refused(option: str) -> None:
    with pytest.raises(ConfigError) as refused:
        read_prices([option])
    assert refused.value.remedy


def test_two_currencies_cannot_be_added_up() -> None:
    with pytest.raises(ConfigError, match="two currencies"):
        read_prices(["copper=3 EUR", "brass=3 USD"])


def test_a_metal_without_a_price_costs_nobody_knows_what() -> None:
    prices = read_prices(["copper=10 EUR"])
    assert prices.cost("copper", 250) == 2.5
    assert prices.cost("brass", 250) is None
