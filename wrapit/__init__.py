"""Turns a line drawing into wire-wrapped jewellery: wires, a jig that bends them, and the guide."""

__version__ = "0.1.0"
