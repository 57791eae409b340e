"""The studio: a page on this machine in which blends are corrected by hand.

It may import rows, job and what is below them.
"""
