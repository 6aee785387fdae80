"""The taut wire: the shape that a wire takes when it is pulled tight round walls, and how far that is from the drawing."""
