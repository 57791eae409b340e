"""Frames of a blend: their times, shapes and views; fades and stagger.

It may import interpolate, options, geometry, paint, model.
"""
