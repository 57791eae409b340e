"""Two drawings become one blend: placed, paired, matched, moved and clipped.

It may import brushes, pens, pairing, motion and all below them.
"""
