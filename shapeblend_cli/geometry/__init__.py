"""Curves, polygons and boxes: measured, flattened, placed."""
