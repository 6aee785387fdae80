"""Joints whose strokes, drawn again, don't have the ink's edges: moved, or told as misread."""
