"""The match of two contours: direction, common cuts, same segments, shared stretches, symmetry."""
