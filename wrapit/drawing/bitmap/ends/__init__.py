"""How strokes end: caps, and small rings at a stem."""
