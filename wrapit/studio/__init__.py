"""A page on this machine to work on a piece; see README.md."""
