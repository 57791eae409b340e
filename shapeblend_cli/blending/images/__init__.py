"""Pictures of pixels between two drawings.

It may import what `blending` may import, and `blending` itself.
"""
