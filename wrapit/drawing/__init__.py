"""Drawings: read from bitmap, SVG or JSON into a planar graph of Bézier segments."""
