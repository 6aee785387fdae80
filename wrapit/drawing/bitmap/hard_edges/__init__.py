"""Pictures whose edges are stairs of pixels: what they tell, and how strokes run through them."""
