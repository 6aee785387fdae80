"""Divides a drawing into few, smooth, well-connected wires."""
