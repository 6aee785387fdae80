"""The effective config with every default written out, and its JSON schema."""

from __future__ import annotations

import io
from typing import Any

from wrapit.config.root import Config


def lock_text(config: Config) -> str:
    """YAML that builds the same piece again whatever the defaults become."""
    from ruamel.yaml import YAML

    stream = io.StringIO()
    yaml = YAML()
    yaml.default_flow_style = False
    yaml.dump(config.model_dump(mode="json", exclude_none=True), stream)
    return stream.getvalue()


def schema() -> dict[str, Any]:
    """JSON schema of the config, for editors and for `wrapit schema`."""
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "wrapit config",
        **{key: value for key, value in Config.model_json_schema().items() if key != "title"},
    }
