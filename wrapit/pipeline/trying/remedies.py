"""What a piece that can't be made as asked would need: the nearest size, gauge and fit, found by trying."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from pathlib import Path

from wrapit.config import Config
from wrapit.errors import WrapItError
from wrapit.pipeline.trying.tried import bolder, read, tried, with_fit
from wrapit.units import awg_diameter_mm

# How does the search for a size go on? In steps of 1.4, up to what the config takes.
_GROWTH = 1.4
_LARGEST_MM = 1000
# The search for the smallest size ends within this share of it.
_NEAR = 0.03
_GAUGES = (*range(10, 32, 2),)


def what_would_do(config: Config, drawing_path: Path) -> str:
    """The remedy for a jig that holds too little: a size, a gauge and a fit, each planned and measured."""
    shares: dict[str, float] = {}

    def holds(setting: str, change: Config) -> bool:
        shares[setting] = held_share(change, drawing_path)
        return shares[setting] >= config.jig.least_support

    def holds_at(size_mm: int) -> bool:
        return holds(f"size: {size_mm} mm", config.model_copy(update={"size": float(size_mm)}))

    size_mm = smallest_size(holds_at, _size_mm(config, drawing_path))
    gauge = next((setting for setting, change in _thinner(config) if holds(setting, change)), None)
    fitted = ((f"fit: {level}", with_fit(config, level)) for level in bolder(config))
    fit = next((setting for setting, change in fitted if holds(setting, change)), None)
    choices = [f"size: {size_mm} mm" if size_mm else None, gauge, fit]
    found = [choice for choice in choices if choice is not None]
    if not found:
        return f"no size up to {_LARGEST_MM} mm and no wire would do: simplify the drawing"
    return " or ".join(f"with {choice} they would hold {shares[choice]:.0%}" for choice in found)


def smallest_size(does: Callable[[int], bool], size_mm: float) -> int | None:
    """The smallest whole size above `size_mm` for which `does` is true, to about 3 %; None if there is none.

    >>> smallest_size(lambda mm: mm >= 100, 25.0)
    101
    """
    low, high = math.floor(size_mm), math.ceil(size_mm * _GROWTH)
    while not does(min(high, _LARGEST_MM)):
        if high >= _LARGEST_MM:
            return None
        low, high = high, math.ceil(high * _GROWTH)
    high = min(high, _LARGEST_MM)
    while high - low > max(1, _NEAR * high):
        middle = (low + high) // 2
        low, high = (low, middle) if does(middle) else (middle, high)
    return high


def held_share(config: Config, drawing_path: Path) -> float:
    """The share of its turns that a piece's first kind of jig would hold; 0 where it can't be planned."""
    from wrapit.jig.kinds import JIGS
    from wrapit.jig.overbending import overbend_wires

    try:
        wires = tried(config, drawing_path).wires
        if config.jig.springback == "compensate":
            wires = tuple(bent.wire for bent in overbend_wires(wires, config)[0])
        return JIGS[config.jigs[0]].held(wires, config)
    except WrapItError:
        return 0.0  # what can't be planned is no remedy


def _size_mm(config: Config, drawing_path: Path) -> float:
    drawing, _ = read(config, drawing_path)
    low, high = drawing.bounds_mm
    return float(max(high - low))


def _thinner(config: Config) -> Iterator[tuple[str, Config]]:
    """The usual gauges thinner than the config's, the thickest first."""
    for number in _GAUGES:
        if awg_diameter_mm(number) < config.wire.gauge - 1e-9:
            wire = config.wire.model_copy(update={"gauge": awg_diameter_mm(number)})
            yield f"wire.gauge: {number} AWG", config.model_copy(update={"wire": wire})
