"""What of an SVG file's lines is seen: not clipped, not covered, not erased, longer than a dot."""
