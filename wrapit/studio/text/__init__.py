"""The text of a config: read, judged, changed and written; see README.md."""
