"""Turns a line drawing into wire-wrapped jewellery: wires, a jig that bends them, and the guide.

For programs, each stage is one function, imported when it is first asked for:

>>> import wrapit
>>> wrapit.__all__
['build', 'build_jigs', 'check', 'decompose', 'draw_wires', 'load_config', 'make_fit', 'trace']

`wrapit.cad` hands jigs and wires to build123d and cadquery.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from wrapit.face import build, build_jigs, check, decompose, draw_wires, load_config, make_fit, trace

__version__ = "0.1.0"
__all__ = ["build", "build_jigs", "check", "decompose", "draw_wires", "load_config", "make_fit", "trace"]


def __getattr__(name: str) -> Any:
    if name not in __all__:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from wrapit import face

    return getattr(face, name)


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
