"""Round wires: centrelines with heights, and their skins."""
