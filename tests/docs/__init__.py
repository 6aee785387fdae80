"""Pages that are written from the code, and commands that pages tell people to run."""
