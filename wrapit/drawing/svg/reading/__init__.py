"""Reads an SVG file as browsers draw it: every thing that is painted, as curves in px."""
