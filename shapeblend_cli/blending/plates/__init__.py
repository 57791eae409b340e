"""Solid plates with signs: cut out of them, inverted with them, or opening in them.

It may import what `blending` may import, and `blending` itself.
"""
