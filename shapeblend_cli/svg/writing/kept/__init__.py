"""Text that stayed text, as elements.

It may import what `svg.writing` may.
"""
