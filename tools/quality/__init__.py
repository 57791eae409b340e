"""What comes out of shapeblend, beside what other tools make of the same shapes: `make bench-quality`."""
