"""Recovery: the pen lines of filled shapes that are their outlines.

It may import what `pens` may import, and lines of `pens`.
"""
