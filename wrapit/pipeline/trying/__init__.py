"""What would be with another config: tried up to wires or a jig's plan, without kernel and files."""
