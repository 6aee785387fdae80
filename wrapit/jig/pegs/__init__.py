"""A board with holes in rows and columns, and round pegs in some of them, to bend wire round by hand."""
