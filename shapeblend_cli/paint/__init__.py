"""Styles, colours and gradients between two drawings, and the names of what is painted.

It may import model.
"""
