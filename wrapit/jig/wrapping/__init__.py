"""Which walls a wire needs to be wrapped on, and how it lies round them."""
