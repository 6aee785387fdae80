"""Beads on wires and beside them."""
