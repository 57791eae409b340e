"""The studio: a page on this machine in which blends are corrected by hand.

It may import batch, job and what is below them.
"""
