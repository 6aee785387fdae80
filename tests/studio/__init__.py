"""The page on this machine: texts, gates, and the real command."""
