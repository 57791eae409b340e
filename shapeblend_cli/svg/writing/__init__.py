"""SVG documents: frames, animations, figures.

It may import options, paint, model.
"""
