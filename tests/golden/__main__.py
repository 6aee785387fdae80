"""`make golden`: writes the config's schema and our pieces' numbers anew, saying what changed."""

from __future__ import annotations

import json
import tempfile
from pathlib import Path

from tests.golden import differences, numbers, path, read
from wrapit.config import schema
from wrapit.pipeline.build import build

CONFIGS = Path(__file__).parent.parent.parent / "configs"


def main() -> None:
    (CONFIGS / "schema.json").write_text(
        json.dumps(schema(), indent=1, ensure_ascii=False) + "\n", encoding="utf-8"
    )
    for config in sorted(CONFIGS.glob("*.yaml")):
        with tempfile.TemporaryDirectory() as folder:
            fresh = numbers(build(config, Path(folder) / config.stem).report)
        changed = differences(read(config.stem), fresh) if path(config.stem).exists() else ["new"]
        for line in changed:
            print(f"{config.stem}: {line}")
        if changed:
            path(config.stem).write_text(json.dumps(fresh, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
