"""Everything that knows SVG.

It may import see its packages.
"""
