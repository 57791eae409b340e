"""Text that may stay text.

It may import what `svg.reading` may.
"""
