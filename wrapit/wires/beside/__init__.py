"""Two runs of wire along the same lines, laid side by side."""
