"""Which contours become which, and what those without a partner do.

It may import wires and what is below it.
"""
