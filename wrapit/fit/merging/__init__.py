"""Two nodes become one: what that moves, and whether lines cross for it."""
