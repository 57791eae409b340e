"""Pictures of pixels: found, decoded within limits, and bent with the outlines around them."""
