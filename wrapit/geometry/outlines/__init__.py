"""Closed outlines of exact curves: parallels, offsets, polygons made exact."""
