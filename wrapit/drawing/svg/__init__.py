"""SVG: strokes as exact curves, cut where they meet."""
