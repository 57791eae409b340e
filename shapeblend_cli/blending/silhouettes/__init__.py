"""Drawings of one colour as silhouettes, whose gaps close and open on the way.

It may import what `blending` may import, and `blending` itself.
"""
