"""`make bench`: every benchmark, or those named: `python -m tests.bench drawing jig`."""

from __future__ import annotations

import importlib
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
    asked = [word for word in sys.argv[1:] if not word.isdigit()]  # numbers are for the benchmark
    for area in asked or areas:
        if area not in areas:
            sys.exit(f"no benchmark named {area}; there are {', '.join(areas)}")
        print(f"\n== {area} ==", flush=True)
        importlib.import_module(f"tests.bench.{area}").main()


if __name__ == "__main__":
    main()
