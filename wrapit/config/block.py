"""The base of every block of the config."""

from __future__ import annotations

from typing import Any

from pydantic import BaseModel, ConfigDict, model_validator

from wrapit.config.choices import choices, meant, spelled
from wrapit.config.ranges import Mark


def _complete(schema: dict[str, Any], block: type[BaseModel]) -> None:
    """Says the range of each quantity in its description (editors show that, not our own keywords), and
    writes its default as the config does; takes choices in all their spellings."""
    for key, value in schema.get("properties", {}).items():
        ranged = next((each for each in (value, *value.get("anyOf", ())) if "x-minimum" in each), None)
        if ranged is not None:
            between = f"Between {ranged['x-minimum']} and {ranged['x-maximum']}."
            value["description"] = "\n\n".join(filter(None, (value.get("description"), between)))
        for mark in block.model_fields[key].metadata:
            if isinstance(mark, Mark) and "default" in value:
                value["default"] = mark.write(value["default"])
        for chosen in (value, value.get("items", {})):
            if words := chosen.pop("enum", None):
                chosen.pop("type", None)
                texts = [word for word in words if isinstance(word, str)]
                chosen["anyOf"] = [{"enum": words}, spelled(texts)]  # editors offer the first


class Block(BaseModel):
    """Frozen; unknown keys are refused, so that a typing mistake never passes as a default.

    Choices are taken in any case, with spaces, dashes or underscores between their words.
    """

    model_config = ConfigDict(
        extra="forbid",
        frozen=True,
        validate_default=False,
        use_attribute_docstrings=True,
        json_schema_extra=_complete,
    )

    @model_validator(mode="before")
    @classmethod
    def _as_choices_are_spelled(cls, data: object) -> object:
        if not isinstance(data, dict):
            return data
        fields = cls.model_fields
        return {
            key: meant(value, list(choices(fields[key].annotation))) if key in fields else value
            for key, value in data.items()
        }
