"""Where the ink of two strokes lies on each other: which way each of them goes."""
