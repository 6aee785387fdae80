"""What the metal costs, where a price is given."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Final

from wrapit.errors import ConfigError
from wrapit.materials import METALS
from wrapit.units import printable, shortened

# An amount with its currency before or behind it, for a kilogram whether that is said or not.
_PRICE: Final = re.compile(
    r"(?P<before>[^\d\s.,/-]{0,5})\s*(?P<amount>\d+(?:[.,]\d+)?)\s*(?P<behind>[^\d\s.,/-]{0,5})\s*(?:/\s*kg)?"
)


@dataclass(frozen=True)
class Prices:
    """For a kilogram of each metal that one is given for; `currency` is what the shop wrote."""

    per_kg: Mapping[str, float] = field(default_factory=dict)
    currency: str = ""

    def cost(self, metal: str, mass_g: float) -> float | None:
        """To the hundredth; None for a metal without a price."""
        price = self.per_kg.get(metal)
        return None if price is None else round(price * mass_g / 1000, 2)


def read_prices(options: Sequence[str]) -> Prices:
    """From `METAL=AMOUNT` a kilogram each.

    Raises ConfigError for an unknown metal, an amount that is none, and for two currencies.

    >>> prices = read_prices(["copper=12.50 EUR/kg", "sterling silver=1100 EUR"])
    >>> prices.cost("copper", 20), prices.cost("brass", 20), prices.currency
    (0.25, None, 'EUR')
    """
    per_kg, currencies = {}, []
    for option in options:
        metal, _, text = option.partition("=")
        metal = " ".join(metal.lower().split())
        where, match = f"--price {shortened(printable(option), 80)}", _PRICE.fullmatch(text.strip())
        if metal not in METALS:
            raise ConfigError("no such metal", where, f"known here: {', '.join(METALS)}")
        if match is None:
            raise ConfigError(
                "not a price for a kilogram", where, "write for example --price 'copper=12.50 EUR'"
            )
        per_kg[metal] = float(match["amount"].replace(",", "."))
        currencies.append(match["before"] or match["behind"])
        if currencies[-1] != currencies[0]:
            raise ConfigError("prices in two currencies can't be added up", where, "write all in one")
    return Prices(per_kg, currencies[0] if currencies else "")
