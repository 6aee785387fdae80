"""How strokes end: caps, small rings at a stem, and joints at a small angle."""
