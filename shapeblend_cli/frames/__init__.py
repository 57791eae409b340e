"""What is drawn of a blend at a time: frames and their times, views, fades, stagger.

It may import interpolate, options, geometry, paint, model.
"""
