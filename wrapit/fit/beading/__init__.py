"""Beads in place of small round loops and dots."""
