"""`make bench`: every benchmark, or those named: `python -m tests.bench drawing jig`.

Words behind a name that name no benchmark are its own: `python -m tests.bench icons FOLDER`.
"""

from __future__ import annotations

import importlib
import inspect
import pkgutil
import sys

import tests.bench


def main() -> None:
    areas = [
        info.name
        for info in pkgutil.iter_modules(tests.bench.__path__)
        if not info.name.startswith("_")
        and hasattr(importlib.import_module(f"tests.bench.{info.name}"), "main")
    ]
    # A benchmark that takes words has them behind its name.
    mains = {area: importlib.import_module(f"tests.bench.{area}").main for area in areas}
    takes = {area for area, run in mains.items() if inspect.signature(run).parameters}
    named: dict[str, list[str]] = {}
    for word in sys.argv[1:] or areas:
        if word in areas:
            named[word] = []
        elif named and [*named][-1] in takes:
            named[[*named][-1]].append(word)
        else:
            sys.exit(f"no benchmark named {word}; there are {', '.join(areas)}")
    for area, words in named.items():
        print(f"\n== {area} ==", flush=True)
        mains[area](words) if area in takes else mains[area]()


if __name__ == "__main__":
    main()
