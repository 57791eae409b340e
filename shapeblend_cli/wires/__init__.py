"""The match of two contours: direction, common cuts, same segments, shared stretches, symmetry.

It may import matching, anatomy, options, geometry, model, errors.
"""
