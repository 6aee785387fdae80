"""Two runs side by side along the same lines: which of them walls hold, and what lies between them."""
