"""Buttons for what findings and mistakes advise: their sentences are read, and what they say is offered.

So a remedy is written once, where the finding is made, and a new one has its button without a word here. What
is offered has been tried: the config takes it.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import Any, Final

from pydantic import ValidationError

from wrapit.config import Config
from wrapit.config.texts.reading import read_yaml
from wrapit.errors import ConfigError
from wrapit.studio.controls import field_at
from wrapit.studio.text.values import plain, value_at, with_value, without_value
from wrapit.units import awg_diameter_mm

SIZES_MM: Final = (*range(20, 60, 5), *range(60, 160, 10), *range(160, 320, 20), *range(350, 1001, 50))
"""Round sizes to offer; a step is the least that a person would try, some 10 %."""
GAUGES: Final = range(10, 32, 2)
"""Wires that shops sell everywhere."""
_OFFERED: Final = 2
"""Sizes that are offered at once: the next one, and one that surely helps more."""
# From springy to soft, as `use softer wire` goes.
_TEMPERS: Final = ("hard", "half hard", "dead soft")
# How remedies say what to do: settings as the config or a sentence writes them, and measures.
_VALUE: Final = r"\[[^\]]*\]|\d+(?:\.\d+)? ?(?:mm|AWG|deg|°)|[\w./-]*\w"
_SETTING: Final = re.compile(rf"\b([a-z_]+(?:\.[a-z_]+)*)(?:: | to )({_VALUE})(?: or ({_VALUE}))?")
_FOR_EXAMPLE: Final = re.compile(r"write for example (.+)")
_INSTEAD: Final = re.compile(r"did you mean '([^']+)'")
_BETWEEN: Final = re.compile(r"choose between (.+) and (.+)")
_TAKE_AWAY: Final = re.compile(r"\btake it away\b")
_LEAVE_OUT: Final = re.compile(r"\bleave (\w+) out of `(jigs|outputs)`")
_LARGER: Final = re.compile(r"\b(?:piece (?:\d+ mm )?|draw it |go )larger\b|\benlarge the piece\b")
_THINNER: Final = re.compile(r"\bthinner (?:or softer )?wire\b|\bthe wire thinner\b")
_SOFTER: Final = re.compile(r"\bsofter wire\b")
# The place of a mistake in a config: file, line, column, key; or the key alone.
_KEY_OF: Final = re.compile(r"^(?:.*:\d+:\d+ )?([a-z_]+(?:\.[a-z_]+)*)$", re.DOTALL)
# What pressing a button does, where "Set key: value" would be no word of a maker's.
_SAYING: Final = {
    "size": "Make it {}",
    "fit": "Make it fit: {}",
    "decomposition.choice": "Take alternative {}",
}
Fix = dict[str, Any]


def fixes(
    remedy: str,
    where: str,
    data: Mapping[str, Any],
    size_mm: float | None = None,
    wires: int = 0,
    *,
    helped: bool = False,
) -> list[Fix]:
    """What to offer as buttons: a label and the change that it makes; the config `data` takes each.

    `where` is the place of a mistake in a config, whose key the remedy is about; `size_mm` is the piece's
    size where the config doesn't say it, `wires` how many it has, as far as is known: one can't be parted.
    `helped` says that to make the drawing fit for wire was tried, and helps.

    >>> data = {"drawing": "bee.png", "size": "63 mm"}
    >>> for fix in fixes("make the piece larger, or set jig.split to per-wire", "wire-01", data):
    ...     print(fix["label"], fix["change"])
    Set jig.split: per-wire {'set': {'jig.split': 'per-wire'}}
    Make it 70 mm {'set': {'size': '70 mm'}}
    Make it 80 mm {'set': {'size': '80 mm'}}
    """
    now = _config(data)
    measures = _measures(remedy, now, size_mm) if now is not None else ()
    fitting = (_setting("fit", "gentle"),) if helped and now is not None and now.fit == "off" else ()
    offered: list[Fix] = []
    for fix in (*_settings(remedy), *_corrections(remedy, where, data), *measures, *fitting):
        then = _config(data, fix["change"])
        parted = wires == 1 and "jig.split" in fix["change"].get("set", ())
        if not parted and fix not in offered and then is not None and then != now:
            offered.append(fix)
    return offered


def _settings(remedy: str) -> Iterator[Fix]:
    """`set jig.split to per-wire`, `with size: 70 mm they would hold 40%`."""
    for key, *values in _SETTING.findall(remedy):
        if field_at(key) is None:
            continue
        for text in filter(None, values):
            yield _setting(key, text)


def _corrections(remedy: str, where: str, data: Mapping[str, Any]) -> Iterator[Fix]:
    """What to write at a place of the config instead: other values, or another key."""
    at = _KEY_OF.match(where)
    if at is None:
        return
    key, missing = at[1], object()
    if example := _FOR_EXAMPLE.search(remedy):
        for text in re.findall(r"'([^']+)'", example[1]):
            yield {"label": f"Set {key}: {text}", "change": {"set": {key: text}}}
    if (between := _BETWEEN.search(remedy)) and field_at(key) is not None:
        yield from (_setting(key, text.strip("'")) for text in between.groups())
    if _TAKE_AWAY.search(remedy) and value_at(data, key, missing) is not missing:
        yield {"label": f"Take {key} away", "change": {"unset": [key]}}
    if instead := _INSTEAD.search(remedy):
        word = instead[1]
        value = value_at(data, key, missing)
        if field_at(key) is not None:
            yield {"label": f"Set {key}: {word}", "change": {"set": {key: word}}}
        elif value is not missing:
            parent = key.rpartition(".")[0]
            right = f"{parent}.{word}" if parent else word
            yield {"label": f"Call it {word}", "change": {"unset": [key], "set": {right: value}}}


def _setting(key: str, text: str) -> Fix:
    return {
        "label": _SAYING.get(key, f"Set {key}: {{}}").format(text),
        "change": {"set": {key: _read(text)}},
    }


def _measures(remedy: str, config: Config, size_mm: float | None) -> Iterator[Fix]:
    """What a maker would try: a larger piece, thinner wire, softer wire, a jig less."""
    now_mm = config.size or size_mm
    if _LARGER.search(remedy) and now_mm:
        for mm in [size for size in SIZES_MM if size > now_mm * 1.02][:_OFFERED]:
            yield {"label": f"Make it {mm} mm", "change": {"set": {"size": f"{mm} mm"}}}
    if _THINNER.search(remedy):
        thinner = (number for number in GAUGES if awg_diameter_mm(number) < config.wire.gauge * 0.98)
        for number in [*thinner][:1]:
            change = {"set": {"wire.gauge": f"{number} AWG"}}
            yield {"label": f"Take {number} AWG wire", "change": change}
    if _SOFTER.search(remedy) and config.wire.temper in _TEMPERS:
        for temper in _TEMPERS[_TEMPERS.index(config.wire.temper) + 1 :][:1]:
            yield {"label": f"Take {temper} wire", "change": {"set": {"wire.temper": temper}}}
    for name, key in _LEAVE_OUT.findall(remedy):
        kept = [each for each in getattr(config, key) if each != name]
        yield {"label": f"Leave {name} out", "change": {"set": {key: kept}}}


def _config(data: Mapping[str, Any], change: Mapping[str, Any] | None = None) -> Config | None:
    """What data mean, after a change; None where no config would hold that."""
    changed = dict(data)
    try:
        for key in (change or {}).get("unset", ()):
            changed = without_value(changed, key)
        for key, value in (change or {}).get("set", {}).items():
            changed = with_value(changed, key, value)
        return Config.model_validate(changed)
    except (ConfigError, ValidationError):
        return None


def _read(text: str) -> Any:
    try:
        return plain(read_yaml(text, ""))
    except ConfigError:
        return text
