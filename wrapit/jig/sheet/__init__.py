"""The jig cut from sheet by a laser."""
