"""Bitmaps: from pixels to centre lines, and where these truly meet."""
