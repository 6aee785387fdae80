"""Turns trails into wires: exact centrelines, turns, lengths, connections."""
