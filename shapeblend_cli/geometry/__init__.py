"""Points, curves, polygons and boxes, whatever they belong to.

It may import model.
"""
