"""The YAML config: frozen models, loading with exact places of mistakes, JSON schema."""

from wrapit.config.bail import BailConfig
from wrapit.config.decomposition import DecompositionConfig, WeightsConfig
from wrapit.config.jig import JigConfig, SeatConfig
from wrapit.config.loading import load_config
from wrapit.config.locking import lock_text, schema
from wrapit.config.naming import named_after, safe_name
from wrapit.config.pegs import PegsConfig
from wrapit.config.plate import PlateConfig
from wrapit.config.root import Config, GuideConfig, JigKind, Language, LengthUnit, Paper, WireConfig
from wrapit.config.tracing import TracingConfig

__all__ = [
    "BailConfig",
    "Config",
    "DecompositionConfig",
    "GuideConfig",
    "JigConfig",
    "JigKind",
    "Language",
    "LengthUnit",
    "Paper",
    "PegsConfig",
    "PlateConfig",
    "SeatConfig",
    "TracingConfig",
    "WeightsConfig",
    "WireConfig",
    "load_config",
    "lock_text",
    "named_after",
    "safe_name",
    "schema",
]
