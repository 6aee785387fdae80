"""A drawing made fit for wire: bends that the metal takes, room between lines, few wires."""
