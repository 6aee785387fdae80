"""The taut wire: how a wire lies that is pulled tight round walls, and how far from the drawing."""
