"""Brush strokes: drawings such as handwriting as centre lines, each with an outline beside it.

It may import pens, pairing, motion, geometry, options, model.
"""
