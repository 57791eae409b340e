"""Two drawings become one blend: placed, paired, matched, moved and clipped.

It may import pairing, motion and what is below them.
"""
