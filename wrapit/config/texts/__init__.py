"""Texts of YAML into plain values that know where they stand, and what is said of a mistake in them."""
