"""Corners and tight bends along a stroke."""
