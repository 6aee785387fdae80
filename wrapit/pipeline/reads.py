"""What each step of a build depends on: other steps, and keys of the config. Here alone it is said.

A step that reads more than is said here would be answered with what was made for another config.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, Final

from wrapit.config import Config
from wrapit.pipeline.cache.fingerprint import key_of


@dataclass(frozen=True)
class Step:
    """`upon` are steps whose values it takes; `reads` keys of the config, or blocks with all their keys."""

    upon: tuple[str, ...] = ()
    reads: tuple[str, ...] = ()


# Of `jig`, wires are drawn by what makes a turn and what a post needs; jigs by all of it.
_OF_TURNS = tuple(
    f"jig.{key}"
    for key in (
        "clearance",
        "long_segment",
        "min_wall_width",
        "post_bends",
        "springback",
        "support",
        "turn_angle",
        "turn_curvature",
    )
)
# What makes a drawing fit: the wishes, and what wire and jig ask of lines (`fit/limits`).
_OF_FIT = (
    "fit",
    "keep",
    "drop",
    "beads",
    "wire",
    "jig.clearance",
    "jig.min_wall_width",
    "jig.post_bends",
    "jig.springback",
)
STEPS: Final[dict[str, Step]] = {
    "trace": Step(reads=("size", "tracing", "fit", "beads")),  # with `fit` pieces are joined
    "fit": Step(("trace",), _OF_FIT),
    "drawing": Step(("fit",), ("decomposition.bridges",)),
    "decomposition": Step(("fit",), ("decomposition",)),
    "sketch": Step(("wires",)),
    "alternatives": Step(("wires",)),
    "fewer wires": Step(("wires",)),
    "wires": Step(("decomposition",), ("wire", "guide.margin", "bail", *_OF_TURNS)),
    "laid": Step(("wires",), ("jig",)),
    "jig printed": Step(("laid",), ("name", "outputs", "pair")),
    "jig sheet": Step(("laid",), ("plate", "outputs", "pair")),
    "jig pegs": Step(("laid",), ("pegs", "plate", "outputs", "pair")),
    "mirrored jig": Step(("jig printed",), ("jigs",)),
    "wires.step": Step(("wires",), ("name", "jig.base_thickness")),
    "views": Step(("wires",)),
    "guide": Step(("mirrored jig",), ("jigs", "guide")),
    "offer": Step(("wires",), _OF_FIT),
}
"""Steps by name. `jig sheet` and so on are those of a kind."""

_SIDE_BY_SIDE: Final = ("wire", "jig.clearance", "jig.min_wall_width", "jig.post_bends", "jig.springback")
"""What says where two wires side by side have room, read where lines may be run along twice."""

_NO_FIT: Final = Step(("trace",), ("fit", "drop", "beads"))
"""Where `fit` isn't taken, what says so: a drawing that isn't fitted is that of any wire."""

# A jig kind that isn't named above: whatever it reads, it is made again when the config changes.
_WHOLE: Final = Step(("laid",), tuple(Config.model_fields))


class Keys:
    """Keys of the steps of one build: hashes of the drawing and of the parts of the config that it reads."""

    def __init__(self, config: Config, drawing_sha256: str, suffix: str) -> None:
        self._settings = config.model_dump(mode="json")
        self._drawing = (drawing_sha256, suffix)
        self._fit = takes_fit(config)
        self._twice = config.decomposition.second_runs

    def of(self, step: str, *also: Any, upon: Iterable[str] = ()) -> str:
        """The key of a step; `also` is JSON that it depends on too, `upon` more steps that it is upon."""
        read = {path for each in (step, *upon) for path in all_reads(each, fit=self._fit, twice=self._twice)}
        settings = {path: _part(self._settings, path) for path in read}
        return key_of(step, self._drawing, settings, *also)


def takes_fit(config: Config) -> bool:
    """Whether the drawing is changed before it is divided: made fit, parts dropped or made beads."""
    return config.fit != "off" or bool(config.drop) or config.beads != "never"


def all_reads(step: str, *, fit: bool = True, twice: bool = True) -> set[str]:
    """Keys of the config that a step depends on, itself and by way of others.

    `fit` as `takes_fit` says; `twice` says whether lines may be run along twice.
    """
    said = _NO_FIT if step == "fit" and not fit else STEPS.get(step, _WHOLE)
    more = _SIDE_BY_SIDE if step == "decomposition" and twice else ()
    return {*said.reads, *more}.union(*(all_reads(each, fit=fit, twice=twice) for each in said.upon))


def _part(settings: Any, path: str) -> Any:
    for name in path.split("."):
        settings = settings[name]
    return settings
