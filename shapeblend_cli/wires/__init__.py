"""How two contours correspond: direction, common cuts, same segments, shared stretches, symmetry.

It may import matching, anatomy, options, geometry, model, errors.
"""
