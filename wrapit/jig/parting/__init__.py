"""Which wires share a jig, and which share a form as they have one shape."""
