"""What the config's `keep` and `drop` say about segments of the drawing that was read."""

from __future__ import annotations

from wrapit.config import Config
from wrapit.errors import ConfigError
from wrapit.fit.sketch import Sketch

_HELP = "the grey numbers of drawing.svg are those of the drawing as it was read"


def without_dropped(sketch: Sketch, config: Config) -> Sketch:
    """The sketch without the segments that the config drops; lines that met only them go on through.

    Raises ConfigError where `keep` or `drop` names no segment, a segment is in both, or none would be left.
    """
    for key, numbers in (("keep", config.keep), ("drop", config.drop)):
        for index, number in enumerate(numbers):
            if number not in sketch.lines:
                raise ConfigError(
                    f"there is no segment {number}; the drawing has segments 0 to {len(sketch.lines) - 1}",
                    f"{key}.{index}",
                    _HELP,
                )
    both = sorted(set(config.keep) & set(config.drop))
    if both:
        raise ConfigError(f"segment {both[0]} is both kept and dropped", "drop", "take it out of one of them")
    dropped = sorted(set(config.drop))
    if len(dropped) == len(sketch.lines):
        raise ConfigError("nothing would be left of the drawing", "drop", "keep at least one segment")
    if not dropped:
        return sketch
    told = [sketch.lines[number].told("dropped", "as the config says") for number in dropped]
    return sketch.changed(dropped, told=told)
