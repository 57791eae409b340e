"""Strokes beside outlines: expanded to outlines, drawn on and back, of several drawings, and of brushes.

It may import what `blending` may import, and `blending` itself.
"""
